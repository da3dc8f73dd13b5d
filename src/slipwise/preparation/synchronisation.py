"""Lags of seconds between loggers: which lag lets one channel be explained by others, and channels put back in step.

Load and friction cells on a second logger that was started late: found by friction, which follows the slip.

    sum F(t + tau) = a s(t) + b x(t) + c girder_ax(t) + sum c_i storey_i_ax(t) + d,      s = tanh(v / v_0)

is fitted at every lag at which one of these resembles the sum of the pads' friction most; the lag that explains most
of all runs together counts where without it much less is explained and no run contradicts it. Shorter delays are the
fits' own business. Cells of load alone follow the inertia of the girder instead:

    sum N(t + tau) = a girder_az(t) + d,      sum x N(t + tau) = a girder_ax(t) + b x(t) + sum c_i storey_i_ax(t) + d

Accelerometers or slip gauges on a second logger that was started late: found by the motion that they share.

    d2(slip)/dt2 = girder_ax - table_ax

holds at one lag only. The girder's accelerometers may be late, the table's, or both together, which is one with slip
gauges that are early: friction, which follows the slip, tells which of the two is out of step with the cells.

One cell on a module of its own: found by the other cells of its kind, which a rigid girder loads and drags alike. One
lag counts for all runs: a single tone is explained as well by a half period as by a wrong sign, an earthquake is not.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import correlate

from slipwise.arrays import Array
from slipwise.campaign import Campaign, Run
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.frame import storey_channels
from slipwise.signals.filters import LowPass, lowpass
from slipwise.signals.second_derivative import second_derivative
from slipwise.signals.shift import shift

#: Lags that are looked for [s]; what is below the first is a small change of the records, which the fits tell.
LEAST, MOST = 0.012, 6.0
#: Share of a channel's variance that must be explained at the lag, and by how much more than without one [1].
EXPLAINED, MORE = 0.7, 0.1
#: Runs agree on a lag within so many samples.
_AGREED = 2.0
#: Slip rate at which friction has turned [m/s].
_TURNED = 0.02
#: Lags tried beside the one at which a single state resembles the channel most, of cells and of accelerometers: all
#: states together explain it best a little beside that [samples].
_BESIDE, _BESIDE_MOTION = 4, 3
#: What is compared is slower than this: rigid, and above the noise of a differentiated slip [Hz].
_SLOW = 8.0
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
class LateChannels:
    """Channels of a logger that was started late.

    Attributes:
        channels: of the logger.
        delay: by which they are late [s].
    """

    channels: tuple[str, ...]
    delay: float


def find_agreed_lag(lags: Sequence[float], dt: float) -> float | None:
    """Return the lag on which runs agree [s]; None where they do not, or it is too short to be looked for."""
    if not lags or abs(float(np.median(lags))) < LEAST or float(np.ptp(lags)) > _AGREED * dt:
        return None
    return float(np.median(lags))


def synchronise(record: Record, channels: Sequence[str], delay: float) -> Record:
    """Bring channels forward by a delay [s]; `without_partner` tells where they then show nothing."""
    return record.replaced(**{n: shift(record[n], record.dt, -delay) for n in channels if n in record})


def without_partner(count: int, dt: float, delay: float) -> NDArray[np.bool_]:
    """Tell at which of a record's samples (n,) late channels have nothing to show once they are brought forward."""
    out = np.zeros(count, dtype=bool)
    whole = min(abs(round(delay / dt)) + 1, count)
    out[count - whole if delay > 0.0 else 0 : count if delay > 0.0 else whole] = True
    return out


def find_strongest_lag(late: Array, state: Array, most: int) -> int:
    """Return the lag of the largest correlation [samples]."""
    along = np.abs(correlate(late - late.mean(), state - state.mean(), method="fft"))
    middle = len(state) - 1
    return int(np.argmax(along[middle - most : middle + most + 1])) - most


def compute_explained_share(late: Array, states: Sequence[Array], lag: int) -> float:
    """Return the share of a late channel's variance that states explain, for a lag [samples]."""
    there, early = slice(max(lag, 0), len(late) + min(lag, 0)), slice(max(-lag, 0), len(late) - max(lag, 0))
    target = late[there]
    columns = np.column_stack([*(x[early] for x in states), np.ones(len(target))])
    left = target - columns @ np.linalg.lstsq(columns, target, rcond=None)[0]
    return 1.0 - float(np.var(left)) / max(float(np.var(target)), 1e-300)


def locate_vertex(before: float, here: float, after: float) -> float:
    """Return where the parabola through three values at -1, 0 and 1 is highest, within half a sample."""
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0.0 else 0.0


def find_late_cells(campaign: Campaign) -> LateChannels | None:
    """Return whether the pads' cells are late as one, of a girder that slides by itself; None where they are not."""
    if not campaign.specimen.free:
        return None
    asked = [pair for run in campaign.runs if (pair := _friction_and_motion(run, campaign.specimen)) is not None]
    if not asked:
        asked = [pair for run in campaign.runs for pair in _loads_and_motion(run.record, campaign.specimen)]
    delay = _find_common_lag(asked, campaign.runs[0].record.dt)
    if delay is None:
        return None
    names = dict.fromkeys(n for run in campaign.runs for n in run.record.channels if n.startswith("pad_"))
    return LateChannels(tuple(names), delay)


def _friction_and_motion(run: Run, specimen: Specimen) -> tuple[Array, list[Array]] | None:
    """Return the sum of the pads' friction (n,) and what explains it in step; None where a run says nothing."""
    record, dt = run.record, run.record.dt
    names, floors = [f"pad_{p}_Fx" for p in specimen.pads], storey_channels(specimen.storeys)
    if not record.has_all(*names, *floors, "slip_x", "girder_ax"):
        return None
    slip = record["slip_x"]
    force = np.sum([record[n] for n in names], axis=0)
    states = [np.tanh(np.gradient(slip, dt) / _TURNED), slip, record["girder_ax"], *(record[n] for n in floors)]
    if not all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (force, *states)):
        return None
    return force, states


def _loads_and_motion(record: Record, specimen: Specimen) -> Iterator[tuple[Array, list[Array]]]:
    """Yield the sum of the pads' loads, and their moment across (n,), each with what explains it in step."""
    names = [f"pad_{pad}_N" for pad in specimen.pads]
    if not record.has_all(*names):
        return
    loads = np.stack([record[n] for n in names], axis=1)
    places = np.array(specimen.pad_places, dtype=float)[:, 0]
    along = ["girder_ax", "slip_x", *storey_channels(specimen.storeys)]
    vertical = next(
        (n for n in (["girder_az"], ["girder_az_1", "girder_az_2"], ["table_az"]) if record.has_all(*n)), []
    )
    for late, states in ((loads.sum(axis=1), vertical), (loads @ (places - places.mean()), along)):
        if states and record.has_all(*states):
            motion = [record[n] for n in states]
            if all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (late, *motion)):
                yield late, motion


def find_late_single_cells(campaign: Campaign) -> list[LateChannels]:
    """Return the pads' cells that are late by themselves, of a girder that slides by itself, each with its delay."""
    found: list[LateChannels] = []
    for kind in ("N", "Fx", "Fy") if campaign.specimen.free else ():
        names = [f"pad_{pad}_{kind}" for pad in campaign.specimen.pads]
        records = [run.record for run in campaign.runs if run.record.has_all(*names)]
        moving = [r for r in records if all(np.isfinite(r[n]).all() and np.ptp(r[n]) > 0.0 for n in names)]
        late: list[LateChannels] = []
        for name in names:
            asked = [(r[name], [r[other] for other in names if other != name]) for r in moving]
            delay = _find_common_lag(asked, campaign.runs[0].record.dt)
            late += [] if delay is None else [LateChannels((name,), delay)]
        found += late if len(late) == 1 else []  # of cells that contradict each other none is known to be late
    return found


def _find_common_lag(asked: Sequence[tuple[Array, Sequence[Array]]], dt: float) -> float | None:
    """Return the one lag at which states explain late channels in all runs together [s].

    None where they are in step, resemble each other at no lag, or where a run contradicts it.

    Args:
        asked: of each run the channel (n,) that may be late, and the states (n,) that explain it in step.
        dt: sampling step [s].
    """
    asked = [(late, states) for late, states in asked if len(late) >= _ENOUGH]
    if not asked:
        return None
    sizes = [float(np.var(late)) * len(late) for late, _ in asked]

    def share(lag: int) -> float:
        own = [size * compute_explained_share(*pair, lag) for size, pair in zip(sizes, asked, strict=True)]
        return sum(own) / sum(sizes)

    in_step = share(0)
    if in_step > 1.0 - MORE:
        return None
    most = min(round(MOST / dt), *(len(late) // 2 for late, _ in asked))
    middles = {find_strongest_lag(late, state, most) for late, states in asked for state in states}
    shares = {lag: share(lag) for middle in middles for lag in range(middle - _BESIDE, middle + _BESIDE + 1)}
    best = max(shares, key=lambda lag: shares[lag])
    if abs(best) * dt < LEAST or shares[best] < max(EXPLAINED, in_step + MORE):
        return None
    if any(compute_explained_share(*pair, best) < compute_explained_share(*pair, 0) - _WORSE for pair in asked):
        return None
    return dt * (best + locate_vertex(*(share(best + beside) for beside in (-1, 0, 1))))


@dataclass(frozen=True)
class _Asked:
    """What may be late in a run: its channel (n,), what explains it at the right lag, and what it then resembles."""

    late: Array
    states: tuple[Array, ...]
    expected: Array

    def explained(self, lag: int) -> float:
        return compute_explained_share(self.late, self.states, lag)


def find_late_motion(campaign: Campaign) -> LateChannels | None:
    """Tell which gauges of the motion along x are late, of a girder that slides by itself; None where none are."""
    if not campaign.specimen.free:
        return None
    runs = [asked for run in campaign.runs if (asked := _asked(run.record))]
    dt = campaign.runs[0].record.dt
    found = [best for asked in runs if (best := _best(asked, min(round(MOST / dt), 2**20))) is not None]
    if not found or len({logger for logger, _ in found}) > 1:
        return None
    logger = found[0][0]
    delay = find_agreed_lag([dt * lag for _, lag in found], dt)
    if delay is None or any(_contradicts(asked[logger], round(delay / dt)) for asked in runs):
        return None
    if logger == "accelerometers" and _slip_is_out_of_step(campaign.runs, campaign.specimen.pads, delay):
        logger, delay = "slip", -delay
    names = dict.fromkeys(n for run in campaign.runs for n in run.record.channels if n.startswith(_LOGGERS[logger]))
    return LateChannels(tuple(names), delay)


def _asked(record: Record) -> dict[str, _Asked]:
    """Return what may be late in a record; nothing where it lacks a channel or never moves."""
    dt = record.dt
    if not record.has_all("slip_x", "girder_ax", "table_ax") or 2.5 * _SLOW * dt > 1.0:
        return {}
    inside = slice(round(_END / dt), -round(_END / dt))
    slow = LowPass(_SLOW, 4, "aligned")
    girder, table = (lowpass(record[n], dt, slow)[inside] for n in ("girder_ax", "table_ax"))
    relative = lowpass(second_derivative(record["slip_x"], dt)[0], dt, slow)[inside]
    if len(girder) < _ENOUGH or not all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (girder, table, relative)):
        return {}
    return {
        "girder": _Asked(girder, (relative, table), relative + table),
        "table": _Asked(table, (relative, girder), girder - relative),
        "accelerometers": _Asked(girder - table, (relative,), relative),
    }


def _best(asked: Mapping[str, _Asked], most: int) -> tuple[str, float] | None:
    """Return the logger that is late in a run, and by how many samples; None where none is, or the run cannot tell."""
    shares: dict[tuple[str, int], float] = {}
    for logger, one in asked.items():
        middle = find_strongest_lag(one.late, one.expected, min(most, len(one.late) // 2))
        for lag in {0, *range(middle - _BESIDE_MOTION, middle + _BESIDE_MOTION + 1)}:
            shares[logger, lag] = one.explained(lag)
    logger, lag = max(shares, key=lambda key: shares[key])
    in_step_now = max(shares[name, 0] for name in asked)
    if shares[logger, lag] < max(EXPLAINED, in_step_now + MORE):  # a single tone is explained at any lag
        return None
    return logger, lag + locate_vertex(*(asked[logger].explained(lag + beside) for beside in (-1, 0, 1)))


def _contradicts(one: _Asked, lag: int) -> bool:
    """Return whether a run shows a channel in step that is late in others."""
    return one.explained(lag) < one.explained(0) - _WORSE


def _slip_is_out_of_step(runs: Sequence[Run], pads: Sequence[str], delay: float) -> bool:
    """Return whether friction fits the slip better where that is brought into step with the accelerometers [s]."""
    with_cells = [r.record for r in runs if r.record.has_all("slip_x", *(f"pad_{p}_Fx" for p in pads))]
    if not with_cells:
        return False
    as_recorded = sum(_follows(record, pads, record["slip_x"]) for record in with_cells)
    moved = sum(_follows(record, pads, synchronise(record, ["slip_x"], -delay)["slip_x"]) for record in with_cells)
    return moved > as_recorded


def _follows(record: Record, pads: Sequence[str], slip: Array) -> float:
    """Return the share of the pads' friction that a slip explains."""
    force = np.sum([record[f"pad_{p}_Fx"] for p in pads], axis=0)
    rate = np.gradient(slip, record.dt)
    return compute_explained_share(force, [np.tanh(rate / max(float(np.std(rate)), 1e-12)), slip], 0)
