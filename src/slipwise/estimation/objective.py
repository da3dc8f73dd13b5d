"""One stacked fit: pads, girder, heave, pitch, roll, warps, motion and friction across with one set of numbers.

Residuals are (measured - predicted) / noise in measured units: a fault of a gauge is put on the prediction, or its
inverse on the measurement with the noise scaled alike. Else a gain below one would shrink the noise and look good.
"""

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from slipwise.model import Model
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.girder import BALANCES, available, buffers_along, motion_residual, predicted_balances
from slipwise.relations.inverse_filter import rewhitened
from slipwise.relations.kinematics import Kinematics, values_of
from slipwise.relations.measurement import acts_on_force, changed_by, faulted, on_force, shifts
from slipwise.relations.memo import Key, Recent
from slipwise.relations.noise import (
    driven_noise_in_pitch,
    heave_level,
    noise_across,
    pad_noise,
    reversal_noise,
    ringing_noise,
    shares_of_noise,
    weighed_balances,
    whitened,
    with_masked_noise,
)
from slipwise.relations.pad_law import PadLaw, as_logged, force_along, lost_velocity, stick_share
from slipwise.relations.parameters import PITCH_INERTIA, ZERO, Term, fitted_model
from slipwise.relations.run_data import FINER, FitRun
from slipwise.relations.table import Residuals
from slipwise.relations.transverse_friction import logged_across
from slipwise.rig import Specimen
from slipwise.signals.filters import LowPass
from slipwise.simulation.predict import PadForces, predictor

Array = NDArray[np.float64]
#: Numbers that change the recorded forces of the pads, not what their law predicts.
_RECORDING_KEYS = ("rig.stick_length", "rig.stick_damping", "rig.late_force", ZERO, "rig.logger")
#: Numbers that no balance knows of.
_PAD_KEYS = ("rig.pitch_slip", "rig.shear_strength", *_RECORDING_KEYS)
_PAD_PORTS = ("area", "shear", "stick", "train", "pad")
#: Where a model has its own memory of slip, or nothing is fitted yet [m].
_SHORT_STICK = 1e-6


@dataclass
class Problem:
    """A campaign's runs held against a base model with further terms.

    Attributes:
        runs: in the order in which they were made; memory goes on from one to the next.
        specimen: rated values.
        terms: effects of the base model, then those of the hypothesis.
        sigmas: relation -> per run noise, broadcastable to the residual; made by `weigh`.
        ringing: relation -> per run spectrum (m,) of gauges' noise that rings in it [N^2]; made by `weigh`.
        watch: called before every evaluation, if given; what it raises ends a fit.
        kinematics: what moved, as the terms understand it.
    """

    runs: list[FitRun]
    specimen: Specimen
    terms: tuple[Term, ...]
    sigmas: dict[str, list[Array]] = field(default_factory=dict[str, list[Array]])
    ringing: dict[str, list[Array]] = field(default_factory=dict[str, list[Array]])
    watch: Callable[[], None] | None = None

    def __post_init__(self) -> None:
        """Make ready what never changes."""
        balances = (r for r in BALANCES if all(r in available(x, self.specimen) for x in self.runs))
        across = ("across",) if all(r.across.size for r in self.runs) else ()
        self.relations: tuple[str, ...] = ("pads", *balances, *across)
        yaw_is_computable = self.balanced and not self.runs[0].states.has_yaw
        recent = Recent(sum(len(r.time) for r in self.runs))
        self.kinematics = Kinematics(self.runs, self.specimen, self.terms, False, yaw_is_computable, recent)
        self._sort()

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there."""
        return len(self.relations) > 1 + ("across" in self.relations)

    def _sort(self) -> None:
        self._on_force = [t for t in self.terms if t.effect.port == "gauge" and acts_on_force(t)]
        self._on_girder = [t for t in self.terms if t.effect.port == "gauge" and "girder_ax" in t.targets]
        self._law: PadLaw | None = None

    @property
    def fitted(self) -> list[int]:
        """Places of the runs that may be fitted."""
        return [i for i, r in enumerate(self.runs) if r.role != "holdout"]

    @property
    def held_out(self) -> list[int]:
        """Places of the runs that are never fitted."""
        return [i for i, r in enumerate(self.runs) if r.role == "holdout"]

    def adding(self, *terms: Term) -> "Problem":
        """Return the same problem with more terms; the noise stays."""
        return self.having((*self.terms, *terms))

    def having(self, terms: tuple[Term, ...]) -> "Problem":
        """Return the same problem with other terms; the noise stays."""
        return self._with(terms, self.kinematics.yaw)

    def with_yaw(self) -> "Problem":
        """Return the same problem with the girder's yaw made from the measured forces, whatever the terms."""
        return self._with(self.terms, True)

    def _with(self, terms: tuple[Term, ...], yaw: bool) -> "Problem":
        other = copy(self)  # results are shared: a candidate leaves most relations as they are
        other.terms, other.kinematics = terms, self.kinematics.of(terms, yaw=yaw)
        other._sort()
        return other

    def near(self, values: Mapping[str, float]) -> "Problem":
        """Return the problem of which slopes at these values are to be taken."""
        if not shifts(self.terms):
            return self
        other = self.having(self.terms)
        other.kinematics = self.kinematics.near(values)
        return other

    def weighed_anew(self, values: Mapping[str, float], *, finer: bool = False) -> "Problem":
        """Return the same problem with the noise, and what the filter took at reversals, as these numbers say.

        Args:
            values: key -> value of everything.
            finer: evaluate the laws at twice the instants from now on.
        """
        anew = self.having(self.terms)
        anew.kinematics.recent = self.kinematics.recent.begun_anew()
        if finer:
            anew.runs = anew.kinematics.refine(FINER)
        anew.weigh(values)
        return anew

    @property
    def has_stick(self) -> bool:
        """Whether an effect says over which slip friction turns round."""
        return any(t.effect.reverses for t in self.terms)

    def model(self, values: Mapping[str, float]) -> Model:
        """Return the model that these numbers describe."""
        return fitted_model(self.specimen, self.terms, values)

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation.

        Args:
            values: key -> value, of every term's parameters and the rig's numbers.
            fitted_only: leave out the runs after the last one that may be fitted; their parts are missing then.
        """
        if self.watch is not None:
            self.watch()
        model, count = self.model(values), max(self.fitted) + 1 if fitted_only else len(self.runs)
        pad_key = (count, *self._pad_key(values))
        pads = self.kinematics.recent.get("pad parts", pad_key, lambda: self._pad_parts(model, values, count))
        if not self.balanced:
            return Residuals(pads[0], pads[1])
        key = (count, *self._balance_key(values), *(pad_key if self._on_force else ()))
        balances = self.kinematics.recent.get("balances", key, lambda: self._balance_parts(model, values, pads[2]))
        return Residuals({**pads[0], **balances}, pads[1])

    def _pad_parts(
        self, model: Model, values: Mapping[str, float], count: int
    ) -> tuple[dict[str, list[Array]], list[Array], list[Array]]:
        """Return residuals and predictions of the pads, and measured forces without their gauges' faults."""
        runs, _ = self.kinematics.corrected(values, count)
        states = self.kinematics.states(values, count)
        key = (count, *self._pad_key(values, faults=False))
        law_forces = self.kinematics.recent.get("law", key, lambda: self._law_of(model).at_instants(runs, states))
        more = (*key, *(values.get(k, 0.0) for k in _RECORDING_KEYS))
        forces = self.kinematics.recent.get("forces", more, lambda: self._logged(values, runs, states, law_forces))
        parts, outputs, clean = [], [], []
        for i, (run, force) in enumerate(zip(runs, forces, strict=True)):
            measured, offset = on_force(self._on_force, values, run, force, self.kinematics.around)
            outputs.append(force + offset)
            clean.append(measured)
            parts.append(self._over("pads", i, run.force - force - offset, run.judged["pads"]))
        if "across" not in self.relations:
            return {"pads": parts}, outputs, clean
        sides = [r.across - logged_across(r, f, self._by(values)) for r, f in zip(runs, law_forces, strict=True)]
        across = [self._over("across", i, side, runs[i].judged["across"]) for i, side in enumerate(sides)]
        return {"pads": parts, "across": across}, outputs, clean

    def _balance_parts(self, model: Model, values: Mapping[str, float], forces: list[Array]) -> dict[str, list[Array]]:
        runs, scale = self.kinematics.corrected(values, len(forces))
        yaw = self.kinematics.yaw_of_runs(values, len(forces))
        raised = self.kinematics.raised(values)
        shares = shares_of_noise(self.specimen, runs[0]) if raised else {}
        law = predictor(model)
        parts, masked = {r: list[Array]() for r in self.relations if r in BALANCES}, 0.0
        if "heave" in parts and self.sigmas:
            masked = 1.0 - (heave_level(model, runs[0], scale) / float(np.min(self.sigmas["heave"][0]))) ** 2
        driven: list[Array | None] = [None] * len(runs)
        if self.sigmas and PITCH_INERTIA in self.kinematics.inertias:
            driven = [*driven_noise_in_pitch(model, runs, values)]
        for i, (run, force) in enumerate(zip(runs, forces, strict=True)):
            law.rest(run.rest_before)
            predicted, measured = predicted_balances(model, run, force, buffers_along(law, run, *yaw[i]), values)
            for name in parts:
                if name == "motion":
                    left = self._motion(i, run, values, scale)
                elif name == "girder" and self._on_girder:  # put on what is predicted: a filter has no inverse
                    shown = run.record.replaced(girder_ax=predicted[name])
                    left = self.runs[i].channel("girder_ax") - faulted(self._on_girder, values, shown)["girder_ax"]
                else:
                    left = (measured[name] - predicted[name]) / scale.get(name, 1.0)
                    left = rewhitened(left, run, raised, shares.get(name, {}))
                if name in self.ringing:
                    left = np.where(run.ringing, 0.0, left)  # whitening looks both ways: not at what a lifted pad does
                    more = driven[i] if name == "pitch" else None
                    left = whitened(left, run, float(np.min(self.sigmas[name][i])), self.ringing[name][i], more)
                parts[name].append(self._over(name, i, left, run.judged[name]))
                if name == "heave":
                    parts[name][-1] = with_masked_noise(parts[name][-1], masked)
        return parts

    def weigh(self, values: Mapping[str, float]) -> None:
        """Set the noise of every relation, error of the velocity near reversals included, and what filters took."""
        self.kinematics.recent.forget()
        self.kinematics.slip_delay, self.kinematics.weighed_by = values.get("rig.late_slip", 0.0), values
        model = self.model(values)
        law = PadLaw(model)
        runs, _ = self.kinematics.corrected(values)
        if self.specimen.free:
            states = self.kinematics.states_with_velocity_error(values)
            law_forces = law.at_instants(runs, states)
            found = self.along(values, states, law_forces)
            soft = self.kinematics.compliance(model.built_specimen())
            pairs = zip(found, runs, strict=True)
            self.kinematics.lost = [lost_velocity(f, r, soft, self._by(values)) for f, r in pairs]
            self.kinematics.bounds = [f.bound[:: r.fine] for f, r in zip(law_forces, runs, strict=True)]
            self.kinematics.recent.forget()
        states = self.kinematics.states(values)
        law_forces = law.at_instants(runs, states)
        faster = self.kinematics.states_with_velocity_error(values, 1.0)
        without_delay = {**values, "rig.late_force": 0.0}
        plain = self._logged(without_delay, runs, states, law_forces)
        shifted = self._logged(without_delay, runs, faster, law.at_instants(runs, faster))
        for forces in (plain, shifted):  # a delayed gauge shows its reversals, and their noise, later too
            for i, run in enumerate(runs):
                forces[i] = forces[i] + on_force(self._on_force, values, run, forces[i])[1]
        reversal = [reversal_noise(*each) for each in zip(runs, plain, shifted, strict=True)]
        self.sigmas, self.ringing = {"pads": [pad_noise(*e) for e in zip(runs, plain, reversal, strict=True)]}, {}
        if self.balanced:
            changed = [changed_by(self._on_force, values, r) for r in runs] if self._on_force else []
            levels = weighed_balances(model, runs, values, reversal, changed)
            self.sigmas |= {name: levels[name] for name in self.relations if name in levels}
            ringing = ringing_noise(model, runs, values).items()
            self.ringing = {name: of for name, of in ringing if name in self.relations}
        if "across" in self.relations:
            self.sigmas["across"] = [noise_across(*each) for each in zip(runs, states, law_forces, strict=True)]

    def _over(self, name: str, run: int, left: Array, kept: NDArray[np.bool_]) -> Array:
        return np.where(kept, left / self.sigmas[name][run] if self.sigmas else left, 0.0)

    def _pad_key(self, values: Mapping[str, float], *, faults: bool = True) -> Key:
        """Return what the pads' residuals depend on; without faults of friction gauges, what the law's forces do."""
        own = [t for t in self.terms if t.effect.instant_hooks or "rig" in t.effect.hooks]
        key = (*values_of(own, values), *self.kinematics.key(values), values.get("rig.shear_strength", 0.0))
        if not faults:
            return key
        return (*key, *values_of(self._on_force, values), *(values.get(k, 0.0) for k in _RECORDING_KEYS))

    def _balance_key(self, values: Mapping[str, float]) -> Key:
        own = [t for t in self.terms if t.effect.port not in _PAD_PORTS or "balance" in t.effect.hooks]
        rig = [v for k, v in values.items() if k.startswith("rig.") and k not in _PAD_KEYS]
        return (*values_of(own, values), *self.kinematics.yaw_key(values), *rig)

    def _by(self, values: Mapping[str, float]) -> LowPass | None:  # the logger's filter where the campaign knows none
        return LowPass(values["rig.logger"]) if "rig.logger" in values else None

    def _law_of(self, model: Model) -> PadLaw:
        self._law = self._law or PadLaw(model)
        self._law.set(model)
        return self._law

    def along(self, values: Mapping[str, float], states: list[Instants], law_forces: list[PadForces]) -> list[Array]:
        """Return the pads' forces along x at the instants of the first runs, a list of (f, p) [N]."""
        length = values.get("rig.stick_length", self.runs[0].scales.length * _SHORT_STICK)
        sharp, damping = not self.has_stick, values.get("rig.stick_damping", 0.0)
        shares = [stick_share(s, length, damping) if sharp else None for s in states]
        return [force_along(*each) for each in zip(law_forces, states, shares, strict=False)]

    def _logged(
        self, values: Mapping[str, float], runs: list[FitRun], states: list[Instants], law_forces: list[PadForces]
    ) -> list[Array]:
        """Return the pads' forces along x as measured, a list of (n, p) [N]."""
        by, delay, averaged = self._by(values), values.get("rig.late_force", 0.0), not self.has_stick
        forces = self.along(values, states[: len(law_forces)], law_forces)
        zero = values.get(ZERO, 0.0)
        return [zero + as_logged(f, r, by, averaged=averaged, delay=delay) for f, r in zip(forces, runs, strict=False)]

    def _motion(self, place: int, run: FitRun, values: Mapping[str, float], scale: Mapping[str, float]) -> Array:
        delay = values["rig.late_slip"]
        key, raised = (delay, *self.kinematics.fault_key(values)), self.kinematics.raised(values)
        return self.kinematics.recent.get(f"motion{place}", key, lambda: motion_residual(run, delay, scale, raised))
