"""What moved: the runs without their gauges' faults, the girder's yaw, and the states of every pad."""

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.estimation.girder_balances import buffers_along, no_slip
from slipwise.estimation.instants import Instants, instants
from slipwise.estimation.inverse_filter import Spectrum
from slipwise.estimation.measurement_model import acts_on_force, noise_scale, raised_noise, without
from slipwise.estimation.parameters import PITCH_INERTIA, YAW_INERTIA, Term, fitted_model
from slipwise.estimation.recent_results import Key, Recent
from slipwise.estimation.run_data import FitRun
from slipwise.estimation.yaw import yaw_of
from slipwise.rig import Specimen
from slipwise.rig.load_modes import load_modes
from slipwise.signals.ends import in_frequency
from slipwise.simulation.predict import predictor

Array = NDArray[np.float64]
#: Numbers of the rig on which yaw depends.
_TURNING = ("rig.mass", "rig.buffer_stiffness", YAW_INERTIA)


@dataclass
class Kinematics:
    """The measured motion of a campaign's runs, as the terms of a hypothesis understand it.

    Attributes:
        runs: as measured.
        specimen: rated values.
        terms: of the hypothesis.
        yaw: whether the girder's yaw is made from the measured forces even if no term turns it.
        can_turn: whether the forces say how the girder turns, and no gauge does.
        recent: results, shared with others that look at the same runs.
        lost: per run (f, p) velocity that the logger's filter took at reversals [m/s].
        bounds: per run (n, p) friction of the pads whichever way they slide [N]; what was measured until it is known.
        late: by which the slip gauge lags behind the accelerometers, as the fit was weighed [s].
        around: values from which slopes are taken, where faults move noise in time; see `measurement_model.without`.
    """

    runs: list[FitRun]
    specimen: Specimen
    terms: tuple[Term, ...]
    yaw: bool
    can_turn: bool
    recent: Recent
    lost: list[Array] = field(default_factory=list[Array])
    bounds: list[Array] = field(default_factory=list[Array])
    late: float = 0.0
    around: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        """Make ready what never changes."""
        self._pitching = [_pitch_rate(r) for r in self.runs]
        self._here = [self.specimen.pads.index(p) for p in self.runs[0].pads]
        self._sort()

    def of(self, terms: tuple[Term, ...], *, yaw: bool) -> "Kinematics":
        """Give the same motion as other terms understand it."""
        other = copy(self)
        other.terms, other.yaw = terms, yaw
        other._sort()
        return other

    def near(self, values: Mapping[str, float]) -> "Kinematics":
        """Give the same motion for slopes at these values."""
        other = copy(self)
        other.around, other.recent = values, Recent()
        return other

    def refine(self, fine: int) -> None:
        """Let the laws be evaluated at so many instants per sample, if they are not yet."""
        if self.runs[0].fine < fine:
            self.runs = [replace(r, fine=fine) for r in self.runs]
            self.lost = []

    def _sort(self) -> None:
        self._faults = [t for t in self.terms if t.effect.port == "gauge" and not acts_on_force(t)]
        self._rockers = [t for t in self.terms if t.effect.port == "table" and "balance" in t.effect.hooks]
        turners = [t for t in self.terms if t.effect.turns]
        self.turns = (self.yaw or bool(turners)) and self.can_turn
        # whose numbers the yaw depends on: how unlike the pads are is in the forces that were measured
        unlike = [t for t in turners if "rig" in t.effect.hooks]
        self._buffers = [t for t in self.terms if t.effect.port == "buffer" or t in unlike]

    @property
    def inertias(self) -> tuple[str, ...]:
        """Keys of the inertias of the girder that these terms speak of."""
        return (YAW_INERTIA,) * self.turns + (PITCH_INERTIA,) * bool(self._rockers)

    def fault_key(self, values: Mapping[str, float]) -> Key:
        """Give what the runs without their gauges' faults depend on."""
        height = (values.get("rig.centre_height", 0.0),) if self._rockers else ()
        return (*values_of([*self._faults, *self._rockers], values), *height)

    def key(self, values: Mapping[str, float]) -> Key:
        """Give what the states of the pads depend on."""
        return (*self.fault_key(values), values.get("rig.pitch_slip", 0.0), *self.turning_key(values))

    def turning_key(self, values: Mapping[str, float]) -> Key:
        """Give what the girder's yaw depends on but for faults; nothing where no yaw is made."""
        if not self.turns:
            return ()
        return ("yaw", *values_of(self._buffers, values), *(values.get(k, 0.0) for k in _TURNING))

    def corrected(self, values: Mapping[str, float], count: int | None = None) -> tuple[list[FitRun], dict[str, float]]:
        """Take the faults of all gauges but those of friction out of the runs; noise scales with it.

        Args:
            values: key -> value of everything.
            count: of runs from the first on; all, if not given.

        Returns:
            runs, and relation -> by how much the noise of its channels has grown, where it has.
        """
        if not self._faults and not self._rockers and self.late == 0.0:
            return self.runs[:count], {}

        def make() -> tuple[list[FitRun], dict[str, float]]:
            runs = self._in_step()[:count]
            for term in self._faults:
                runs = [without(term, values, r, self.around) for r in runs]
            if self._rockers:
                model = fitted_model(self.specimen, self.terms, values)
                runs = [r.without_turning(no_slip(model, r)) for r in runs]
            return runs, noise_scale(self._faults, values, self.runs[0])

        return self.recent.get("corrected", (len(self.runs[:count]), *self.fault_key(values)), make)

    def raised(self, values: Mapping[str, float]) -> dict[str, Spectrum]:
        """Give the channels whose noise is raised by taking their faults out, and by how much: see `raised_noise`."""
        if all("undo" in t.effect.hooks for t in self._faults):
            return {}
        key = self.fault_key(values)
        return self.recent.get("raised", key, lambda: raised_noise(self._faults, values, self.runs[0]))

    def _in_step(self) -> list[FitRun]:
        """Give the runs with slip and accelerations in step."""
        if self.late == 0.0:
            return self.runs
        return self.recent.get("in step", (self.late,), lambda: [r.without_late_slip(self.late) for r in self.runs])

    def turning(self, values: Mapping[str, float], count: int | None = None) -> list[tuple[Array, Array]]:
        """Give yaw [rad] and its rate [rad/s] of the runs, (n,) each: measured, made from the forces, or none."""
        runs, _ = self.corrected(values, count)
        if not self.turns:
            return [(r.states.yaw, r.states.yaw_rate) for r in runs]

        def make() -> list[tuple[Array, Array]]:
            model = fitted_model(self.specimen, self.terms, values)
            specimen, law = model.built_specimen(), predictor(model)
            found = []
            for i, run in enumerate(runs):
                law.rest(run.rest_before)
                still = np.zeros(len(run.time))
                buffers = buffers_along(law, run, still, still)
                force = _whole(run, specimen.mass, buffers)
                bound = self.bounds[i] if self.bounds else np.abs(force)
                found.append(yaw_of(run, specimen, force, bound, buffers))
            return found

        return self.recent.get("yaw", (len(self.runs[:count]), *self.key(values)), make)

    def compliance(self, specimen: Specimen) -> Array:
        """Give the acceleration of pad i for a force along x on pad j, (p, p) [1/kg]; it turns where yaw is known.

        A pad that was not measured is taken to hold the girder as the measured ones do.
        """
        places = np.array(specimen.pad_places)[self._here, 1] - specimen.centre_y
        turning = np.outer(places, places) / specimen.inertia[2]
        knows = self.turns or self.runs[0].states.has_yaw
        every = len(specimen.pads) / len(self._here)
        return every / specimen.mass + (turning if knows else np.zeros_like(turning))

    def states(self, values: Mapping[str, float], count: int | None = None) -> list[Instants]:
        """Give the states of every pad in the runs, as many of them as asked for."""
        key = (len(self.runs[:count]), *self.key(values))
        return self.recent.get("states", key, lambda: self.faster(values, count=count))

    def faster(self, values: Mapping[str, float], by: float = 0.0, count: int | None = None) -> list[Instants]:
        """Give the states of every pad, their velocities raised by so many times their expected errors."""
        runs, _ = self.corrected(values, count)
        pads = np.array(self.specimen.pad_places)[self._here]
        round_about = np.stack([-pads[:, 1], pads[:, 0]], axis=1)[None]
        alike = not (self.turns or runs[0].states.has_yaw)
        here = slice(1 if alike else None)  # a girder that does not turn moves over every pad alike
        out = []
        for place, run in enumerate(runs):
            velocity = run.states.pad_velocity[:, here].copy()
            velocity[:, :, 0] += values.get("rig.pitch_slip", 0.0) * self._pitching[place][:, None]
            velocity[:, :, 0] += by * run.states.pad_velocity_error[here, 0]
            slip = run.states.pad_slip[:, here]
            if self.turns:
                angle, rate = self.turning(values, count)[place]
                velocity = velocity + rate[:, None, None] * round_about
                slip = slip + angle[:, None, None] * round_about
            lost = self.lost[place][:, here] if self.lost else None
            out.append(instants(run, velocity, slip, lost))
        return out


def values_of(terms: Sequence[Term], values: Mapping[str, float]) -> Key:
    """Give the terms' labels and the values of their parameters."""
    return tuple(x for t in terms for n in t.effect.parameter_names for x in (t.label, values[f"{t.label}.{n}"]))


def _whole(run: FitRun, mass: float, buffers: Array) -> Array:
    """Give the pads' forces (n, p) [N]; where one gauge lies, what the girder's balance leaves it."""
    force = run.force
    bad = np.stack([run.invalid.get(f"pad_{p}_Fx", np.zeros(len(force), dtype=bool)) for p in run.pads], axis=1)
    alone = bad & (bad.sum(axis=1, keepdims=True) == 1)
    if not alone.any():
        return force
    others = np.where(bad, 0.0, force).sum(axis=1)
    rest = -mass * run.channel("girder_ax") - buffers.sum(axis=1) - others
    return np.where(alone, rest[:, None], force)


def _pitch_rate(run: FitRun) -> Array:
    """Give the rate of the pitch load (n,) [N/s], by which the sliding plane moves against the gauge; 0 if unknown."""
    loads = run.all_loads
    if loads is None:
        return np.zeros(len(run.time))
    smooth = in_frequency(load_modes(loads).pitch, run.dt, lambda f: 1.0 / (1.0 + (f / 120.0) ** 8), 64)
    return np.gradient(smooth, run.dt)
