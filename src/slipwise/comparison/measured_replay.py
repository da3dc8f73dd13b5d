"""System level: the replay from the measured table motion, held against every measured channel.

Windows are restarted from measured slip and velocity, so that the phase of stick-slip does not swamp everything, and
what was simulated goes through the logger's filter before it is compared.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.rig_motion import rig_motion
from slipwise.campaign.states import States
from slipwise.errors import InputError
from slipwise.model import Model
from slipwise.motion.resample import resample
from slipwise.motion.table_motion import TableMotion
from slipwise.record import Record
from slipwise.rig import Specimen, largest_step
from slipwise.short_repr import short_repr
from slipwise.signals.filters import lowpass
from slipwise.simulation.kernel.layout import buffer_memories, pad_memories
from slipwise.simulation.predict import Predictor, predictor
from slipwise.simulation.simulator import DT, Memory
from slipwise.simulation.windows import Windows, simulate_windows

#: Length of a window [s].
WINDOW = 1.0
#: What of its start is not judged: the pads ring, and the filter has no past [s].
SETTLE = 0.15
#: At the end of a window the zero-phase filter has no future [s].
_END = 0.02


@short_repr
@dataclass(frozen=True)
class SystemRun:
    """One run at system level.

    Attributes:
        name: of the run.
        time: (n,) [s].
        measured: channel -> (n,), as recorded.
        simulated: channel -> (n,), filtered as the logger filters; NaN where nothing is judged.
        error: channel -> rms of simulated - measured, in the channel's unit.
    """

    name: str
    time: Array
    measured: Mapping[str, Array]
    simulated: Mapping[str, Array]
    error: Mapping[str, float]


def get_measured_motion(states: States) -> TableMotion:
    """Return the table's measured motion of a run.

    Raises:
        InputError: table_ax was not recorded.
    """
    if "table_ax" not in states.record:
        raise InputError("the system level needs table_ax, the measured motion of the table; it was not recorded")
    columns = np.nan_to_num(states.table_acceleration)
    return TableMotion(states.dt, columns, "measured table motion", ("table_ax", "table_ay", "table_az"))


def choose_simulation_step(sampling: float, specimen: Specimen) -> float:
    """Return the step of a simulation [s]: the usual one or what stiff pads allow, a whole part of a record's step.

    Args:
        sampling: step of the record [s].
        specimen: that is simulated, see `Model.built_specimen`.
    """
    most = min(DT, largest_step(specimen))
    # a step that was read from a file's times is off by rounding
    return sampling / float(np.ceil(sampling / most * (1.0 - 1e-9)))


def replay_runs(model: Model, runs: Sequence[tuple[str, States, float]], *, dt: float = DT) -> list[SystemRun]:
    """Replay the runs of a campaign in windows, the memory of pads and buffers carried along.

    Args:
        model: to be replayed.
        runs: (name, measured states, pause before it [s]) in the order in which they were made.
        dt: step of the simulation [s].

    Raises:
        InputError: a channel that the system level needs was not recorded.
    """
    law = predictor(model)
    out: list[SystemRun] = []
    for name, states, rest in runs:
        law.rest(rest)
        out.append(_replayed(law, name, states, dt))
    return out


def _replayed(law: Predictor, name: str, states: States, dt: float) -> SystemRun:
    step = states.dt
    every = int(np.ceil(step / dt * (1.0 - 1e-9)))  # no coarser than pads allow
    fine = resample(get_measured_motion(states), step / every).acceleration
    length = min(round((WINDOW + SETTLE + _END) / step), len(states.time))
    stride = max(1, length - round((SETTLE + _END) / step))
    starts = list(range(0, len(states.time) - length + 1, stride))
    acceleration = np.stack([fine[s * every : s * every + length * every - every + 1] for s in starts])
    instants = np.linspace(states.time[0], states.time[-1], len(fine))
    pushed = np.interp(instants, states.time, np.nan_to_num(states.girder_acceleration[:, 0]))
    girder = np.stack([pushed[s * every : s * every + acceleration.shape[1]] for s in starts])
    memories = _memories(law, states, starts)
    windows = Windows(acceleration, states.slip[starts], states.velocity[starts], memories, states.time[starts], girder)
    answers = simulate_windows(law.model, windows, dt=step / every, every=every)
    return _seen(law.model, name, states, starts, length, answers)


def _seen(
    model: Model, name: str, states: States, starts: Sequence[int], length: int, answers: list[dict[str, Array]]
) -> SystemRun:
    """Put the windows of one run together and hold them against what was measured."""
    names = [n for n in answers[0] if n in states.record and not n.startswith("table_")]
    simulated = {n: np.full(len(states.time), np.nan) for n in names}
    first, last = round(SETTLE / states.dt), round(_END / states.dt)
    for start, answer in zip(starts, answers, strict=True):
        seen = _as_logged(model, answer, states, states.time[start : start + length])
        for n in names:
            simulated[n][start + first : start + length - last] = seen[n][first : length - last]
    measured = {n: states.record[n] for n in names}
    judged = states.usable
    error = {}
    for n in names:
        here = judged & np.isfinite(simulated[n])
        error[n] = (
            float(np.sqrt(np.mean((simulated[n][here] - measured[n][here]) ** 2))) if here.any() else float("nan")
        )
    return SystemRun(name, states.time, measured, simulated, error)


def _as_logged(model: Model, answer: dict[str, Array], states: States, time: Array) -> dict[str, Array]:
    """Let gauges and logger act on what was simulated."""
    record = Record(time, answer)
    for entry in model.with_hook("gauge"):
        record = entry.effect.hooks["gauge"](record, entry.target, **entry.values)
    out = {}
    for name, values in record.channels.items():
        kept = states.lowpass.get(name)
        out[name] = lowpass(values, states.dt, kept) if kept is not None and np.isfinite(values).all() else values
    return out


def _memories(laws: Predictor, states: States, starts: Sequence[int]) -> tuple[Memory, ...]:
    """Drive the laws with the measured states and keep what they remember at the start of every window."""
    layout = laws.law.layout
    buffers = np.stack([states.slip] * max(1, len(laws.model.specimen.buffers)), axis=1)
    rates = np.stack([states.velocity] * buffers.shape[1], axis=1)
    bounds = [*starts, len(states.time)]
    motion = rig_motion(states) if laws.asks_for_motion else None
    kept = []
    for start, end in zip(bounds[:-1], bounds[1:], strict=True):
        kept.append(Memory(pad_memories(layout, laws.numbers).copy(), buffer_memories(layout, laws.numbers).copy()))
        if end - start > 1:
            till = slice(start, end + 1)  # pads' memory goes on between samples, that of buffers at each
            states_here = (states.load[till], states.pad_velocity[till], states.pad_slip[till])
            laws.pads(states.time[till], *states_here, states.pads, None if motion is None else motion[till])
            if laws.model.specimen.buffer_stiffness:
                here = slice(start, end)
                laws.buffers(states.time[here], buffers[here], rates[here])
    return tuple(kept)
