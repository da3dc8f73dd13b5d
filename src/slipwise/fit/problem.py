"""One stacked fit: pads, girder, heave, pitch, roll, warp, motion and friction across with one set of numbers.

Residuals are (measured - predicted) / noise in measured units: a fault of a gauge is put on the prediction, or its
inverse on the measurement with the noise scaled alike. Else a gain below one would shrink the noise and look good.
"""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.fit.across import fast, logged_across
from slipwise.fit.balances import BALANCES, available, buffer_forces, motion_residual, no_slip, predicted
from slipwise.fit.data import FitRun, refined
from slipwise.fit.faults import acts_on_force, faulted, noise_scale, without
from slipwise.fit.pads import Instants, PadLaw, as_logged, force_along, instants, lost_velocity, stick_share
from slipwise.fit.terms import Term, fitted_model
from slipwise.fit.weights import balance_noise, heave_scale, noise_across, pad_noise, with_hidden
from slipwise.fit.yaw import yaw_of
from slipwise.model import Model
from slipwise.predict import PadForces, Predictor, predictor
from slipwise.rig import Specimen
from slipwise.signals import LowPass
from slipwise.signals.ends import in_frequency

Array = NDArray[np.float64]
RELATIONS: tuple[str, ...] = ("pads", *BALANCES, "across")
#: Numbers of the rig that change the pads' states.
_MOTION_KEYS = ("rig.pitch_slip",)
_LAW_KEYS = (*_MOTION_KEYS, "rig.shear_strength")
#: Numbers that change what is seen of the pads' forces, not what their law says.
_SEEN_KEYS = ("rig.stick_length", "rig.late_force", "rig.logger")
_PAD_KEYS = (*_LAW_KEYS, *_SEEN_KEYS)
#: Effects of the catalogue that turn the girder about the vertical.
_TURNERS = ("buffer_mismatch", "mass_eccentricity", "pad_spread")
_PAD_PORTS = ("area", "shear", "stick", "pad")
#: Results of this many recent sets of numbers are kept: a difference quotient comes back to its base.
_KEPT = 4
#: Where a model has its own memory of slip, or nothing is fitted yet [m].
_SHORT_STICK = 1e-6


@dataclass(frozen=True)
class Residuals:
    """Residuals of every relation, in units of the noise, per run.

    Attributes:
        parts: relation -> per run (n,), or (n, p) for pads; zero where masked.
        pad_forces: per run (n, p) predicted [N].
    """

    parts: dict[str, list[Array]]
    pad_forces: list[Array]

    def stacked(self, which: Sequence[int], relations: Sequence[str] = RELATIONS) -> Array:
        """Give all residuals of these runs in one vector."""
        return np.concatenate([self.parts[r][i].ravel() for r in relations if r in self.parts for i in which])


@dataclass
class Problem:
    """A campaign's runs held against a base model with further terms.

    Attributes:
        runs: in the order in which they were made; memory goes on from one to the next.
        specimen: rated values.
        terms: effects of the base model, then those of the hypothesis.
        sigmas: relation -> per run noise, broadcastable to the residual; made by `weigh`.
        yaw: whether the girder's yaw is made from the measured forces even if no term turns it.
        yaws: whether it is made from them, for whatever reason.
        lost: per run (f,) velocity that the logger's filter took at reversals [m/s]; made by `weigh`.
    """

    runs: list[FitRun]
    specimen: Specimen
    terms: tuple[Term, ...]
    sigmas: dict[str, list[Array]] = field(default_factory=dict[str, list[Array]])
    lost: list[Array] = field(default_factory=list[Array])
    yaw: bool = False

    def __post_init__(self) -> None:
        """Make ready what never changes."""
        balances = (r for r in BALANCES if all(r in available(x, self.specimen) for x in self.runs))
        across = ("across",) if all(r.across.size for r in self.runs) else ()
        self.relations = ("pads", *balances, *across)
        self._memo: dict[str, dict[tuple[str | float, ...], Any]] = {}
        self._turning = [_pitch_rate(r) if len(r.pads) == 4 else np.zeros(len(r.time)) for r in self.runs]
        self._here = [self.specimen.pads.index(p) for p in self.runs[0].pads]
        self._sort()

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there, not only sliders."""
        return len(self.relations) > 1 + ("across" in self.relations)

    def _sort(self) -> None:
        """Sort the terms by what they touch."""
        self._gauges = [t for t in self.terms if t.effect.port == "gauge"]
        self._on_force = [t for t in self._gauges if acts_on_force(t)]
        self._on_state = [t for t in self._gauges if not acts_on_force(t)]
        self._rockers = [t for t in self.terms if t.effect.port == "table" and "balance" in t.effect.hooks]
        self._moving = [*self._on_state, *self._rockers]
        self._turners = [t for t in self.terms if t.effect.name in _TURNERS]
        measured = self.runs[0].states.has_yaw or not self.balanced
        self.yaws = (self.yaw or bool(self._turners)) and not measured
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
        """Give the same problem with more terms; the noise stays."""
        more = copy(self)  # the memory of results is shared: a candidate leaves most relations as they are
        more.terms = (*self.terms, *terms)
        more._sort()
        return more

    def weighed_anew(self, values: Mapping[str, float]) -> "Problem":
        """Give the same problem with the noise, and what the filter took at reversals, as these numbers say."""
        anew = copy(self)
        anew._memo = {}
        anew._sort()
        anew.weigh(values)
        return anew

    @property
    def has_stick(self) -> bool:
        """Whether an effect decides how a pad sticks."""
        return any("stick" in t.effect.hooks for t in self.terms)

    def model(self, values: Mapping[str, float]) -> Model:
        """Give the model that these numbers describe."""
        return fitted_model(self.specimen, self.terms, values)

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation.

        Args:
            values: key -> value, of every term's parameters and the rig's numbers.
            fitted_only: leave out the runs after the last one that may be fitted; their parts are missing then.
        """
        model = self.model(values)
        count = max(self.fitted) + 1 if fitted_only else len(self.runs)
        pad_key = (count, *self._pad_key(values))
        pads = self._remembered("pad parts", pad_key, lambda: self._pad_parts(model, values, count))
        if not self.balanced:
            return Residuals(pads[0], pads[1])
        key = (count, *self._balance_key(values), *(pad_key if self._on_force else ()))
        balances = self._remembered("balances", key, lambda: self._balance_parts(model, values, pads[2]))
        return Residuals({**pads[0], **balances}, pads[1])

    def _pad_parts(
        self, model: Model, values: Mapping[str, float], count: int
    ) -> tuple[dict[str, list[Array]], list[Array], list[Array]]:
        """Give residuals and predictions of the pads, and measured forces without their gauges' faults."""
        runs, _ = self._corrected(values)
        states = self._states(values, runs)
        key = (count, *self._pad_key(values, faults=False))
        said = self._remembered("law", key, lambda: self._law_of(model).at_instants(runs[:count], states[:count]))
        key = (*key, *(values.get(k, 0.0) for k in _SEEN_KEYS))
        forces = self._remembered("forces", key, lambda: self._logged(values, runs, states, said))
        parts, outputs, clean = [], [], []
        for i, (run, force) in enumerate(zip(runs, forces, strict=False)):
            seen, offset = self._faulty_force(values, run, force)
            outputs.append(force + offset)
            clean.append(seen)
            parts.append(self._over("pads", i, run.force - force - offset, run.sliding[:, None]))
        if "across" not in self.relations:
            return {"pads": parts}, outputs, clean
        sides = [r.across - logged_across(r, f, self._by(values)) for r, f in zip(runs, said, strict=False)]
        across = [self._over("across", i, side, fast(runs[i])) for i, side in enumerate(sides)]
        return {"pads": parts, "across": across}, outputs, clean

    def _balance_parts(self, model: Model, values: Mapping[str, float], forces: list[Array]) -> dict[str, list[Array]]:
        runs, scale = self._corrected(values)
        law = predictor(model)
        parts: dict[str, list[Array]] = {r: [] for r in self.relations if r in BALANCES}
        hidden = max(0.0, 1.0 - heave_scale(model, runs[0]) ** 2) if "heave" in parts else 0.0
        for i, (run, force) in enumerate(zip(runs, forces, strict=False)):
            law.rest(run.rest_before)
            said, seen = predicted(model, run, force, self._buffers(law, run, *self._yaw(run, values)), values)
            for name in parts:
                if name == "motion":
                    left = self._motion(i, run, values)
                else:
                    left = (seen[name] - said[name]) / scale.get(name, 1.0)
                parts[name].append(self._over(name, i, left, run.grounded))
                if name == "heave" and hidden > 0.0:
                    parts[name][-1] = with_hidden(parts[name][-1], hidden)
        return parts

    def weigh(self, values: Mapping[str, float]) -> None:
        """Set the noise of every relation, error of the velocity near reversals included, and what filters took."""
        self._memo.clear()
        model = self.model(values)
        law = PadLaw(model)
        runs, _ = self._corrected(values)
        if self.specimen.free:
            states = [self._instants(r, i, values) for i, r in enumerate(runs)]
            found = self._along(values, states, law.at_instants(runs, states))
            mass = model.specimen.mass
            pairs = zip(found, runs, strict=True)
            self.lost = [lost_velocity(f.sum(axis=1), r, mass, self._by(values)) for f, r in pairs]
        states = self._states(values, runs)
        still = {**values, "rig.late_force": 0.0}
        said = law.at_instants(runs, states)
        plain = self._logged(still, runs, states, said)
        faster = [self._instants(r, i, values, more=r.states.velocity_error[0]) for i, r in enumerate(runs)]
        shifted = self._logged(still, runs, faster, law.at_instants(runs, faster))
        for forces in (plain, shifted):  # a late gauge shows its reversals, and their noise, later too
            for i, run in enumerate(runs):
                forces[i] = forces[i] + self._faulty_force(values, run, forces[i])[1]
        self.sigmas = {r: [] for r in self.relations}
        for i, run in enumerate(runs):
            self.sigmas["pads"].append(pad_noise(run, plain[i], shifted[i]))
            for name, level in balance_noise(model.specimen, run).items():
                if name in self.relations:
                    self.sigmas[name].append(np.array(level))
            if "across" in self.relations:
                self.sigmas["across"].append(noise_across(run, states[i], said[i]))

    def _over(self, name: str, run: int, left: Array, kept: NDArray[np.bool_]) -> Array:
        if not self.sigmas:
            return np.where(kept, left, 0.0)
        return np.where(kept, left / self.sigmas[name][run], 0.0)

    def _remembered(self, what: str, key: tuple[str | float, ...], make: Callable[[], Any]) -> Any:
        """Give what was made for this key before, or make it; the last few are kept."""
        kept = self._memo.setdefault(what, {})
        if key not in kept:
            if len(kept) >= _KEPT:
                del kept[next(iter(kept))]
            kept[key] = make()
        else:
            kept[key] = kept.pop(key)
        return kept[key]

    def _pad_key(self, values: Mapping[str, float], *, faults: bool = True) -> tuple[str | float, ...]:
        """Give what the pads' residuals depend on; without the faults of friction gauges, what their law does."""
        own = [t for t in self.terms if t.effect.instant_hooks or "rig" in t.effect.hooks or t in self._moving]
        own += self._on_force if faults else []
        turned = ("yaw", values.get("rig.buffer_stiffness", 0.0)) if self.yaws else ()
        keys = _PAD_KEYS if faults else _LAW_KEYS
        return (*self._values_of(own, values), *turned, *(values.get(k, 0.0) for k in keys))

    def _balance_key(self, values: Mapping[str, float]) -> tuple[str | float, ...]:
        own = [t for t in self.terms if t.effect.port not in _PAD_PORTS or "balance" in t.effect.hooks]
        rig = [v for k, v in values.items() if k.startswith("rig.") and k not in _PAD_KEYS]
        return (*self._values_of(own, values), *rig)

    def _values_of(self, terms: Sequence[Term], values: Mapping[str, float]) -> tuple[str | float, ...]:
        return tuple(x for t in terms for n in t.effect.parameter_names for x in (t.label, values[f"{t.label}.{n}"]))

    def _corrected(self, values: Mapping[str, float]) -> tuple[list[FitRun], dict[str, float]]:
        """Take the faults of all gauges but those of friction out of the runs; noise scales with it."""
        if not self._moving:
            return self.runs, {}

        def make() -> tuple[list[FitRun], dict[str, float]]:
            runs = self.runs
            for term in self._on_state:
                runs = [without(term, values, r) for r in runs]
            if self._rockers:
                model = self.model(values)
                runs = [r.without_turning(no_slip(model, r)) for r in runs]
            return runs, noise_scale(self._on_state, values, self.runs[0])

        return self._remembered("corrected", self._moving_key(values), make)

    def _moving_key(self, values: Mapping[str, float]) -> tuple[str | float, ...]:
        """Give what the runs depend on without the faults of their gauges and what is no slip."""
        height = (values.get("rig.centre_height", 0.0),) if self._rockers else ()
        return (*self._values_of(self._moving, values), *height)

    def _states(self, values: Mapping[str, float], runs: list[FitRun]) -> list[Instants]:
        turned = self._values_of(self._turners, values)
        key = (*self._moving_key(values), *turned, *(values.get(k, 0.0) for k in _MOTION_KEYS))
        if self.yaws:
            key = (*key, "yaw", values["rig.buffer_stiffness"] if "rig.buffer_stiffness" in values else 0.0)

        def make() -> list[Instants]:
            return [self._instants(r, i, values) for i, r in enumerate(runs)]

        return self._remembered("states", key, make)

    def _by(self, values: Mapping[str, float]) -> LowPass | None:
        """Give the logger's filter as fitted, where the campaign does not know it."""
        return LowPass(values["rig.logger"]) if "rig.logger" in values else None

    def _instants(self, run: FitRun, place: int, values: Mapping[str, float], more: float = 0.0) -> Instants:
        """Give the states of every pad, with some velocity more."""
        velocity = run.states.pad_velocity[:, self._here].copy()
        velocity[:, :, 0] += (more + values.get("rig.pitch_slip", 0.0) * self._turning[place])[:, None]
        slip = run.states.pad_slip[:, self._here]
        if self.yaws:
            angle, rate = self._turning_of(run, values)
            across = np.array(self.specimen.pad_places)[self._here]
            velocity = velocity + rate[:, None, None] * np.stack([-across[:, 1], across[:, 0]], axis=1)[None]
            slip = slip + angle[:, None, None] * np.stack([-across[:, 1], across[:, 0]], axis=1)[None]
        lost = self.lost[place] if self.lost else None
        return instants(run, velocity, slip, lost)

    def _turning_of(self, run: FitRun, values: Mapping[str, float]) -> tuple[Array, Array]:
        model = self.model(values)
        still = np.zeros(len(run.time))
        return yaw_of(run, model.built_specimen(), run.force, self._buffers(predictor(model), run, still, still))

    def _yaw(self, run: FitRun, values: Mapping[str, float]) -> tuple[Array, Array]:
        """Give yaw [rad] and its rate [rad/s], (n,) each: measured, made from the forces, or none."""
        return self._turning_of(run, values) if self.yaws else (run.states.yaw, run.states.yaw_rate)

    def _law_of(self, model: Model) -> PadLaw:
        if self._law is None:
            self._law = PadLaw(model)
        self._law.set(model)
        return self._law

    def _along(self, values: Mapping[str, float], states: list[Instants], said: list[PadForces]) -> list[Array]:
        """Give the pads' forces along x at the instants, a list of (f, p) [N]."""
        length = values.get("rig.stick_length", _SHORT_STICK)
        sharp = not self.has_stick
        shares = [stick_share(s, length) if sharp else None for s in states]
        return [force_along(*each) for each in zip(said, states, shares, strict=False)]

    def _logged(
        self, values: Mapping[str, float], runs: list[FitRun], states: list[Instants], said: list[PadForces]
    ) -> list[Array]:
        """Give the pads' forces along x as measured, a list of (n, p) [N]."""
        by, late, averaged = self._by(values), values.get("rig.late_force", 0.0), not self.has_stick
        forces = self._along(values, states[: len(said)], said)
        return [as_logged(f, r, by, averaged=averaged, late=late) for f, r in zip(forces, runs, strict=False)]

    def _faulty_force(self, values: Mapping[str, float], run: FitRun, force: Array) -> tuple[Array, Array]:
        """Give the measured forces without their faults, and what the faults add to the predicted ones, (n, p) each."""
        if not self._on_force:
            return run.force, np.zeros_like(force)
        names = [f"pad_{p}_Fx" for p in run.pads]
        mended = run
        for term in self._on_force:
            mended = without(term, values, mended)
        # while a pad sticks the law does not say its force
        stuck = np.stack([mended.record[n] for n in names], axis=1)
        clean = np.where(run.sliding[:, None], force, stuck)
        record = run.record.replaced(**{n: clean[:, i] for i, n in enumerate(names)})
        record = record.replaced(**{f"pad_{p}_N": run.load[:, i] for i, p in enumerate(run.pads)})
        faulty = faulted(self._on_force, values, record)
        offset = np.stack([faulty[n] for n in names], axis=1) - clean
        return run.force - offset, offset

    def _buffers(self, law: Predictor, run: FitRun, yaw: Array, yaw_rate: Array) -> Array:
        if not self.specimen.buffer_stiffness:
            return np.zeros((len(run.time), 1))
        sides = np.array(self.specimen.buffer_places)[:, 1]
        slip = run.slip[:, None] - sides * yaw[:, None]
        if not any(t.effect.port == "buffer" for t in self.terms):
            return slip * np.array(law.model.specimen.buffer_stiffness)
        slip, velocity = refined(slip), refined(run.velocity[:, None] - sides * yaw_rate[:, None])
        time = np.linspace(run.time[0], run.time[-1], len(slip))
        fine = buffer_forces(law, time, slip, velocity)
        return as_logged(fine, run, None, averaged=False)

    def _motion(self, place: int, run: FitRun, values: Mapping[str, float]) -> Array:
        late = values["rig.late_slip"]
        key = (late, *self._moving_key(values))
        return self._remembered(f"motion{place}", key, lambda: motion_residual(run, late))


def _pitch_rate(run: FitRun) -> Array:
    """Give the rate of the pitch load (n,) [N/s], by which the sliding plane moves against the gauge."""
    pitch = run.load[:, 0] + run.load[:, 2] - run.load[:, 1] - run.load[:, 3]
    smooth = in_frequency(pitch, run.dt, lambda f: 1.0 / (1.0 + (f / 120.0) ** 8), 64)
    return np.gradient(smooth, run.dt)
