"""What moved: the runs without their gauges' faults, the girder's yaw, and the states of every pad."""

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.relations.evaluation_times import Instants, instants
from slipwise.relations.girder import buffers_along, rigid_rotation_acceleration
from slipwise.relations.inverse_filter import Spectrum
from slipwise.relations.measurement import acts_on_force, noise_scale, raised_noise, without
from slipwise.relations.memo import Key, Recent
from slipwise.relations.parameters import PITCH_INERTIA, YAW_INERTIA, Term, fitted_model
from slipwise.relations.run_data import FitRun
from slipwise.relations.yaw import yaw_of
from slipwise.rig import Specimen, pad_frequencies
from slipwise.rig.frame import frame_push
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes
from slipwise.signals.ends import in_frequency
from slipwise.simulation.predict import predictor

Array = NDArray[np.float64]
#: Numbers of the rig on which yaw depends.
_YAW_KEYS = ("rig.mass", "rig.buffer_stiffness", YAW_INERTIA)
#: Above this frequency, over that at which the girder pitches on its pads, what is left of the pitch load is noise [1].
_PITCHING = 1.56


@dataclass
class Kinematics:
    """The measured motion of a campaign's runs, as the terms of a hypothesis understand it.

    Attributes:
        runs: as measured.
        specimen: rated values.
        terms: of the hypothesis.
        yaw: whether the girder's yaw is made from the measured forces even if no term asks for it.
        yaw_is_computable: whether all pads' forces were measured, and yaw was not.
        recent: results, shared with others that look at the same runs.
        lost: per run (f, p) velocity that the logger's filter took at reversals [m/s].
        bounds: per run (n, p) friction of the pads whichever way they slide [N]; what was measured until it is known.
        slip_delay: by which the slip gauge lags behind the accelerometers, as the fit was weighed [s].
        weighed_by: numbers with which the noise was weighed last.
        around: values from which slopes are taken, where faults move noise in time; see `measurement_model.without`.
    """

    runs: list[FitRun]
    specimen: Specimen
    terms: tuple[Term, ...]
    yaw: bool
    yaw_is_computable: bool
    recent: Recent
    lost: list[Array] = field(default_factory=list[Array])
    bounds: list[Array] = field(default_factory=list[Array])
    slip_delay: float = 0.0
    weighed_by: Mapping[str, float] = field(default_factory=dict[str, float])
    around: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        """Make ready what never changes."""
        self._pitching = [_pitch_rate(r) for r in self.runs]
        self._here = [self.specimen.pads.index(p) for p in self.runs[0].pads]
        self._sort()

    def of(self, terms: tuple[Term, ...], *, yaw: bool) -> "Kinematics":
        """Return the same motion as other terms understand it."""
        other = copy(self)
        other.terms, other.yaw = terms, yaw
        other._sort()
        return other

    def near(self, values: Mapping[str, float]) -> "Kinematics":
        """Return the same motion for slopes at these values."""
        other = copy(self)
        other.around, other.recent = values, self.recent.another()
        return other

    def refine(self, fine: int) -> list[FitRun]:
        """Let the laws be evaluated at so many instants per sample, if they are not yet; gives the runs then."""
        if self.runs[0].fine < fine:
            self.runs = [replace(r, fine=fine) for r in self.runs]
            self.lost = []
        return self.runs

    def _sort(self) -> None:
        self._faults = [t for t in self.terms if t.effect.port == "gauge" and not acts_on_force(t)]
        self._table_pitch_terms = [t for t in self.terms if t.effect.port == "table" and "balance" in t.effect.hooks]
        yaw_terms = [t for t in self.terms if t.effect.turns]
        self.makes_yaw = (self.yaw or bool(yaw_terms)) and self.yaw_is_computable
        # whose numbers the yaw depends on: how much the pads differ is in the forces that were measured
        yaw_terms_of_rig = [t for t in yaw_terms if "rig" in t.effect.hooks]
        self._buffers = [t for t in self.terms if t.effect.port == "buffer" or t in yaw_terms_of_rig]

    @property
    def inertias(self) -> tuple[str, ...]:
        """Keys of the inertias of the girder that these terms speak of."""
        return (YAW_INERTIA,) * self.makes_yaw + (PITCH_INERTIA,) * bool(self._table_pitch_terms)

    def fault_key(self, values: Mapping[str, float]) -> Key:
        """Return what the runs without their gauges' faults depend on."""
        height = (values.get("rig.centre_height", 0.0),) if self._table_pitch_terms else ()
        return (*values_of([*self._faults, *self._table_pitch_terms], values), *height)

    def key(self, values: Mapping[str, float]) -> Key:
        """Return what the states of the pads depend on."""
        return (*self.fault_key(values), values.get("rig.pitch_slip", 0.0), *self.yaw_key(values))

    def yaw_key(self, values: Mapping[str, float]) -> Key:
        """Return what the girder's yaw depends on but for faults; nothing where no yaw is made."""
        if not self.makes_yaw:
            return ()
        return ("yaw", *values_of(self._buffers, values), *(values.get(k, 0.0) for k in _YAW_KEYS))

    def corrected(self, values: Mapping[str, float], count: int | None = None) -> tuple[list[FitRun], dict[str, float]]:
        """Take the faults of all gauges but those of friction out of the runs; noise scales with it.

        Args:
            values: key -> value of everything.
            count: of runs from the first on; all, if not given.

        Returns:
            runs, and relation -> by how much the noise of its channels has grown, where it has.
        """
        if not self._faults and not self._table_pitch_terms and self.slip_delay == 0.0:
            return self.runs[:count], {}

        def make() -> tuple[list[FitRun], dict[str, float]]:
            runs = self._synchronised()[:count]
            for term in self._faults:
                runs = [without(term, values, r, self.around) for r in runs]
            if self._table_pitch_terms:
                model = fitted_model(self.specimen, self.terms, values)
                runs = [r.without_table_pitch(rigid_rotation_acceleration(model, r)) for r in runs]
            return runs, noise_scale(self._faults, values, self.runs[0])

        return self.recent.get("corrected", (len(self.runs[:count]), *self.fault_key(values)), make)

    def raised(self, values: Mapping[str, float]) -> dict[str, Spectrum]:
        """Return the channels whose noise is raised by taking their faults out, and by how much: see `raised_noise`."""
        if all("undo" in t.effect.hooks for t in self._faults):
            return {}
        key = self.fault_key(values)
        return self.recent.get("raised", key, lambda: raised_noise(self._faults, values, self.runs[0]))

    def _synchronised(self) -> list[FitRun]:
        """Return the runs with slip and accelerations synchronised."""
        if self.slip_delay == 0.0:
            return self.runs
        delay = self.slip_delay
        return self.recent.get("synchronised", (delay,), lambda: [r.slip_delay_corrected(delay) for r in self.runs])

    def yaw_of_runs(self, values: Mapping[str, float], count: int | None = None) -> list[tuple[Array, Array]]:
        """Return yaw [rad] and its rate [rad/s] of the runs, (n,) each: measured, made from the forces, or none."""
        runs, _ = self.corrected(values, count)
        if not self.makes_yaw:
            return [(r.states.yaw, r.states.yaw_rate) for r in runs]

        def make() -> list[tuple[Array, Array]]:
            model = fitted_model(self.specimen, self.terms, values)
            specimen, law = model.built_specimen(), predictor(model)
            found = []
            for i, run in enumerate(runs):
                law.rest(run.rest_before)
                still = np.zeros(len(run.time))
                buffers = buffers_along(law, run, still, still)
                force = _whole(run, specimen, buffers)
                bound = self.bounds[i] if self.bounds else np.abs(force)
                found.append(yaw_of(run, specimen, force, bound, buffers))
            return found

        return self.recent.get("yaw", (len(self.runs[:count]), *self.key(values)), make)

    def compliance(self, specimen: Specimen) -> Array:
        """Return the acceleration of pad i for a force along x on pad j, (p, p) [1/kg], with yaw where it is known.

        A pad that was not measured is taken to hold the girder as the measured ones do.
        """
        places = np.array(specimen.pad_places)[self._here, 1] - specimen.centre_y
        by_yaw = np.outer(places, places) / specimen.inertia[2]
        has_yaw = self.makes_yaw or self.runs[0].states.has_yaw
        every = len(specimen.pads) / len(self._here)
        return every / specimen.mass + (by_yaw if has_yaw else np.zeros_like(by_yaw))

    def states(self, values: Mapping[str, float], count: int | None = None) -> list[Instants]:
        """Return the states of every pad in the runs, as many of them as asked for."""
        key = (len(self.runs[:count]), *self.key(values))
        return self.recent.get("states", key, lambda: self.states_with_velocity_error(values, count=count))

    def states_with_velocity_error(
        self, values: Mapping[str, float], by: float = 0.0, count: int | None = None
    ) -> list[Instants]:
        """Return the states of every pad, their velocities raised by so many times their expected errors.

        Args:
            values: key -> value of everything.
            by: number of expected errors of the velocity that are added [1].
            count: of runs from the first on; all, if not given.
        """
        runs, _ = self.corrected(values, count)
        pads = np.array(self.specimen.pad_places)[self._here]
        round_about = np.stack([-pads[:, 1], pads[:, 0]], axis=1)[None]
        alike = not (self.makes_yaw or runs[0].states.has_yaw)
        here = slice(1 if alike else None)  # a girder without yaw moves over every pad alike
        out = []
        for place, run in enumerate(runs):
            velocity = run.states.pad_velocity[:, here].copy()
            velocity[:, :, 0] += values.get("rig.pitch_slip", 0.0) * self._pitching[place][:, None]
            velocity[:, :, 0] += by * run.states.pad_velocity_errors[:, here]
            slip = run.states.pad_slip[:, here]
            if self.makes_yaw:
                angle, rate = self.yaw_of_runs(values, count)[place]
                velocity = velocity + rate[:, None, None] * round_about
                slip = slip + angle[:, None, None] * round_about
            lost = self.lost[place][:, here] if self.lost else None
            out.append(instants(run, velocity, slip, lost))
        return out


def values_of(terms: Sequence[Term], values: Mapping[str, float]) -> Key:
    """Return the terms' labels and the values of their parameters."""
    return tuple(x for t in terms for key in t.parameters for x in (key, values[key]))


def _whole(run: FitRun, specimen: Specimen, buffers: Array) -> Array:
    """Return the pads' forces (n, p) [N]; where one gauge is invalid, what the girder's balance leaves it."""
    force = run.force
    bad = np.stack([run.invalid.get(f"pad_{p}_Fx", np.zeros(len(force), dtype=bool)) for p in run.pads], axis=1)
    alone = bad & (bad.sum(axis=1, keepdims=True) == 1)
    if not alone.any():
        return force
    others = np.where(bad, 0.0, force).sum(axis=1)
    push = frame_push(run.record, specimen) - buffers.sum(axis=1)
    rest = push - specimen.mass * run.channel("girder_ax") - others
    return np.where(alone, rest[:, None], force)


def _pitch_rate(run: FitRun) -> Array:
    """Return rate of the pitch load (n,) [N/s], by which the sliding plane moves against the gauge; 0 if unknown."""
    loads, specimen = run.all_loads, run.states.specimen
    if loads is None or not specimen.free:
        return np.zeros(len(run.time))
    highest = _PITCHING * pad_frequencies(specimen)["pitch"]
    smooth = in_frequency(
        load_modes(loads, basis_of(specimen)).pitch, run.dt, lambda f: 1.0 / (1.0 + (f / highest) ** 8), 64
    )
    return np.gradient(smooth, run.dt)
