"""Accelerometers or slip gauges on a second logger that was started late: found by the motion that they share.

    d2(slip)/dt2 = girder_ax - table_ax

holds at one lag only. The girder's accelerometers may be late, the table's, or both together, which is one with slip
gauges that are early: friction, which follows the slip, tells which of the two is out of step with the cells.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign import Campaign, Run
from slipwise.instruments.lags import (
    EXPLAINED,
    MORE,
    MOST,
    LateChannels,
    agreed,
    explained,
    in_step,
    strongest,
    vertex,
)
from slipwise.record import Record
from slipwise.signals.filters import LowPass, lowpass
from slipwise.signals.second_derivative import second_derivative

Array = NDArray[np.float64]
#: What is compared is slower than this: rigid, and above the noise of a differentiated slip [Hz].
_SLOW = LowPass(8.0, 4, "aligned")
#: Lags beside the one of largest correlation that are tried [samples].
_BESIDE = 3
#: Ends that the filter spoils [s], and samples that are enough between them.
_END, _ENOUGH = 0.3, 200
#: A lag that explains less than none by more than this share is contradicted [1].
_WORSE = 0.05
#: Which gauges may be on a logger of their own, by the first letters of their channels.
_LOGGERS: dict[str, tuple[str, ...]] = {
    "girder": ("girder_a",),
    "table": ("table_a",),
    "accelerometers": ("girder_a", "table_a"),
    "slip": ("slip_", "yaw"),
}


@dataclass(frozen=True)
class _Asked:
    """What may be late in a run: its channel (n,), what explains it at the right lag, and what it then resembles."""

    late: Array
    states: tuple[Array, ...]
    expected: Array

    def explained(self, lag: int) -> float:
        return explained(self.late, self.states, lag)


def late_motion(campaign: Campaign) -> LateChannels | None:
    """Tell which gauges of the motion along x are late, of a girder that slides by itself; None where none are."""
    if not campaign.specimen.free:
        return None
    runs = [asked for run in campaign.runs if (asked := _asked(run.record))]
    dt = campaign.runs[0].record.dt
    found = [best for asked in runs if (best := _best(asked, min(round(MOST / dt), 2**20))) is not None]
    if not found or len({logger for logger, _ in found}) > 1:
        return None
    logger = found[0][0]
    delay = agreed([dt * lag for _, lag in found], dt)
    if delay is None or any(_contradicts(asked[logger], round(delay / dt)) for asked in runs):
        return None
    if logger == "accelerometers" and _slip_is_out_of_step(campaign.runs, campaign.specimen.pads, delay):
        logger, delay = "slip", -delay
    names = dict.fromkeys(n for run in campaign.runs for n in run.record.channels if n.startswith(_LOGGERS[logger]))
    return LateChannels(tuple(names), delay)


def _asked(record: Record) -> dict[str, _Asked]:
    """Give what may be late in a record; nothing where it lacks a channel or never moves."""
    dt = record.dt
    if not record.has_all("slip_x", "girder_ax", "table_ax") or 2.5 * _SLOW.frequency * dt > 1.0:
        return {}
    inside = slice(round(_END / dt), -round(_END / dt))
    girder, table = (lowpass(record[n], dt, _SLOW)[inside] for n in ("girder_ax", "table_ax"))
    relative = lowpass(second_derivative(record["slip_x"], dt)[0], dt, _SLOW)[inside]
    if len(girder) < _ENOUGH or not all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (girder, table, relative)):
        return {}
    return {
        "girder": _Asked(girder, (relative, table), relative + table),
        "table": _Asked(table, (relative, girder), girder - relative),
        "accelerometers": _Asked(girder - table, (relative,), relative),
    }


def _best(asked: Mapping[str, _Asked], most: int) -> tuple[str, float] | None:
    """Give the logger that is late in a run, and by how many samples; None where none is, or the run cannot tell."""
    shares: dict[tuple[str, int], float] = {}
    for logger, one in asked.items():
        middle = strongest(one.late, one.expected, min(most, len(one.late) // 2))
        for lag in {0, *range(middle - _BESIDE, middle + _BESIDE + 1)}:
            shares[logger, lag] = one.explained(lag)
    logger, lag = max(shares, key=lambda key: shares[key])
    in_step_now = max(shares[name, 0] for name in asked)
    if shares[logger, lag] < max(EXPLAINED, in_step_now + MORE):  # a single tone is explained at any lag
        return None
    return logger, lag + vertex(*(asked[logger].explained(lag + beside) for beside in (-1, 0, 1)))


def _contradicts(one: _Asked, lag: int) -> bool:
    """Tell whether a run shows a channel in step that is late in others."""
    return one.explained(lag) < one.explained(0) - _WORSE


def _slip_is_out_of_step(runs: Sequence[Run], pads: Sequence[str], delay: float) -> bool:
    """Tell whether friction fits the slip better where that is brought into step with the accelerometers [s]."""
    with_cells = [r.record for r in runs if r.record.has_all("slip_x", *(f"pad_{p}_Fx" for p in pads))]
    if not with_cells:
        return False
    as_recorded = sum(_follows(record, pads, record["slip_x"]) for record in with_cells)
    moved = sum(_follows(record, pads, in_step(record, ["slip_x"], -delay)["slip_x"]) for record in with_cells)
    return moved > as_recorded


def _follows(record: Record, pads: Sequence[str], slip: Array) -> float:
    """Give the share of the pads' friction that a slip explains."""
    force = np.sum([record[f"pad_{p}_Fx"] for p in pads], axis=0)
    rate = np.gradient(slip, record.dt)
    return explained(force, [np.tanh(rate / max(float(np.std(rate)), 1e-12)), slip], 0)
