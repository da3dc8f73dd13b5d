"""What a missing force may depend on: states of the pads and of the girder at every instant of all runs.

Those that a law may know are the arguments that a hook may ask for, made by the very functions that make them in a
simulation. What is measured beside them tells a reader where the force is, and cannot be the argument of a law.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.rig_motion import rig_motion
from slipwise.effects import DERIVED, LAGGING, PAD_INPUTS, RIG_MOTION
from slipwise.estimation.objective import Objective
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.kinematics import CORRECTED, STATES
from slipwise.relations.pad_stages import LAW_FORCES, LOGGED_FORCES, compute_forces_along
from slipwise.relations.run_data import FitRun, interpolate_finely
from slipwise.short_repr import short_repr
from slipwise.simulation.kernel import derived_states
from slipwise.simulation.predict import PadForces

#: Time constants at which lags of the load are looked for, and those of heat [s], on the time scale of a girder.
_LAGS, _COOLING = (0.001, 0.003, 0.008, 0.02, 0.05, 0.15), (0.3, 1.0, 3.0, 10.0)
#: State that is measured and no argument of a law -> its SI unit.
MEASURED: dict[str, str] = {"velocity": "m/s", "vertical": "m/s^2", "temperature": "K"}
#: State -> its SI unit, for arguments of laws as the contract of the effects has it.
UNITS: dict[str, str] = MEASURED | {
    name: PAD_INPUTS[argument].rpartition("[")[2].removesuffix("]")
    for name, argument in {"slip": "slip_x", **{n: n for n in ("speed", "load", "time", *DERIVED, *RIG_MOTION)}}.items()
}
WORDS: dict[str, str] = {
    "speed": "the slip speed", "slip": "the slip", "load": "the normal load", "time": "the time",
    "speed_rate": "the rate of the speed", "lagged_load": "the load behind a lag", "load_rate": "the rate of the load",
    "time_since_reversal": "the time since the last reversal",
    "distance_since_reversal": "the distance since the last reversal",
    "last_peak_speed": "the peak speed of the last stroke", "last_stroke": "the length of the last stroke",
    "slid": "the distance slid", "heat": "the heat", "outward": "motion outward or inward",
    "path_curvature": "the curvature of the path", "rocking_rate": "the rocking rate of the girder",
    "table_velocity": "the velocity of the table", "table_acceleration": "the acceleration of the table",
    "velocity": "the slip velocity", "vertical": "the vertical acceleration of the girder",
    "temperature": "the temperature of the sliding face",
}  # fmt: skip
#: State of laws -> the motion or the run that would vary it.
VARIED_BY: dict[str, str] = {
    "speed": "a motion with other peak speeds", "slip": "a motion with a longer stroke",
    "load": "vertical motion of the table, or another mass", "time": "a longer run",
    "speed_rate": "a motion that reverses harder", "lagged_load": "vertical motion of the table",
    "load_rate": "vertical motion of the table", "time_since_reversal": "a motion with slower and faster reversals",
    "distance_since_reversal": "a motion with strokes of unlike length",
    "last_peak_speed": "a motion with strokes of unlike speed, as an earthquake has",
    "last_stroke": "a motion with strokes of unlike length, as an earthquake has", "slid": "a longer run",
    "heat": "a longer or faster run, or runs without a rest between them",
    "outward": "a motion that goes to both sides of the middle", "path_curvature": "a motion in two directions",
    "rocking_rate": "a motion that rocks the girder", "table_velocity": "a motion of the table",
    "table_acceleration": "a motion of the table",
}  # fmt: skip
#: A state that varies by less than this share of its size cannot be judged [1].
_VARIES = 1e-3


@short_repr
@dataclass(frozen=True)
class DrivingState:
    """One state over all runs.

    Attributes:
        name: of `UNITS`.
        time_constant: of its lag [s]; 0 for one without.
        values: per run (f, p) at the instants at which the laws are evaluated.
    """

    name: str
    time_constant: float
    values: tuple[Array, ...]

    @property
    def signed(self) -> bool:
        """Whether it takes both signs."""
        return self.name in ("slip", "speed_rate", "load_rate", "outward", "velocity", "vertical", *RIG_MOTION)

    @property
    def label(self) -> str:
        """Name with its lag."""
        return f"{self.name} ({1e3 * self.time_constant:.3g} ms)" if self.time_constant else self.name


@short_repr
@dataclass(frozen=True)
class PadInstants:
    """All runs at the instants, as a fit has them.

    Attributes:
        runs: in their order.
        states: of the pads.
        forces: of the law.
        along: per run (f, p) force along x with the sharp reversal of a stick smoothed [N].
        area: apparent, of a pad [m^2].
    """

    runs: tuple[FitRun, ...]
    states: tuple[Instants, ...]
    forces: tuple[PadForces, ...]
    along: tuple[Array, ...]
    area: float


def pad_instants(objective: Objective, values: Mapping[str, float]) -> PadInstants:
    """Return all runs at the instants, as a fit's numbers have them."""
    evaluation = objective.evaluation(values)
    states, forces = evaluation.of(STATES), evaluation.of(LAW_FORCES)
    along = compute_forces_along(evaluation.inputs(LOGGED_FORCES), states, forces)
    runs = evaluation.of(CORRECTED).runs
    return PadInstants(runs, tuple(states), tuple(forces), tuple(along), objective.specimen.pad_area)


def pad_states(every: PadInstants) -> list[DrivingState]:
    """Return the states of the pads over all runs; those that hardly vary are left out.

    What lags is there once for each of the usual time constants.
    """
    scale = every.runs[0].scales.time
    plain = {
        "speed": [np.hypot(*np.moveaxis(s.velocity, 2, 0)) for s in every.states],
        "slip": [s.slip[:, :, 0] for s in every.states],
        "load": [s.load for s in every.states],
        "time": [np.repeat((s.time - s.time[0])[:, None], s.load.shape[1], axis=1) for s in every.states],
    }
    out = [DrivingState(name, 0.0, tuple(values)) for name, values in plain.items()]
    for lags, wanted in ((_LAGS, ("lagged_load", "load_rate")), (_COOLING, ("heat",))):
        for lag in (scale * t for t in lags):
            found = derived(every, lag)
            out += [DrivingState(name, lag, tuple(found[name])) for name in wanted]
    out += [DrivingState(name, 0.0, tuple(found[name])) for name in DERIVED if name not in LAGGING]
    return [s for s in out if _varies(s)]


def measured_states(every: PadInstants) -> list[DrivingState]:
    """Return what is measured beside the states of laws, of `MEASURED`; what is not there or hardly varies is left out.

    The velocity along x has a sign, the temperature is that of each pad's face, the vertical acceleration the girder's.
    """
    found: dict[str, list[Array]] = {"velocity": [s.velocity[:, :, 0] for s in every.states]}
    found["vertical"] = [
        np.broadcast_to(interpolate_finely(run.states.girder_acceleration[:, 2:], run.fine), s.load.shape)
        for run, s in zip(every.runs, every.states, strict=True)
    ]
    gauges = [[f"pad_{p}_T" for p in run.pads] for run in every.runs]
    if all(run.record.has_all(*names) for run, names in zip(every.runs, gauges, strict=True)):
        found["temperature"] = [
            interpolate_finely(np.stack([run.record[name] for name in names], axis=1), run.fine)
            for run, names in zip(every.runs, gauges, strict=True)
        ]
    return [s for name, values in found.items() if _varies(s := DrivingState(name, 0.0, tuple(values)))]


def rig_states(every: PadInstants) -> list[DrivingState]:
    """Return the states of the rig over all runs, alike for every pad; those that hardly vary are left out."""
    out = []
    for place, name in enumerate(RIG_MOTION):
        of_runs = (interpolate_finely(rig_motion(run.states)[:, place : place + 1], run.fine) for run in every.runs)
        values = (np.broadcast_to(v, s.load.shape) for v, s in zip(of_runs, every.states, strict=True))
        out.append(DrivingState(name, 0.0, tuple(values)))
    return [s for s in out if _varies(s)]


def derived(every: PadInstants, time_constant: float) -> dict[str, list[Array]]:
    """Return the derived states of all runs, name -> per run (f, p), with this time constant [s]."""
    memory = np.zeros((every.states[0].load.shape[1], derived_states.SIZE))
    out: dict[str, list[Array]] = {name: [] for name in DERIVED}
    for run, state, force in zip(every.runs, every.states, every.forces, strict=True):
        for block in memory:
            derived_states.cool(block, run.rest_before, time_constant)
        found = np.zeros((*state.load.shape, len(DERIVED)))
        of = (state.time, state.load, np.ascontiguousarray(force.bound), state.velocity, state.slip)
        derived_states.observe_record(*of, every.area, time_constant, memory, found)
        for i, name in enumerate(DERIVED):
            out[name].append(found[:, :, i])
    return out


def _varies(state: DrivingState) -> bool:
    whole = np.concatenate([v.ravel() for v in state.values])
    return bool(np.isfinite(whole).all()) and float(np.std(whole)) > _VARIES * float(np.max(np.abs(whole)) or np.inf)
