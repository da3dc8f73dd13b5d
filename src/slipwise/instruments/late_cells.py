"""Load and friction cells on a second logger that was started late: found by friction, which follows the slip.

    sum F(t + tau) = a s(t) + b x(t) + c girder_ax(t) + d,      s = tanh(v / v_0)

is fitted at every lag at which one of the three resembles the sum of the pads' friction most; the best lag counts
where all runs agree on it and without it much less is explained. Delays below `_LEAST` are the fits' own business.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import correlate

from slipwise.campaign import Campaign, Run
from slipwise.channels import PADS
from slipwise.record import Record
from slipwise.signals.shift import shift

Array = NDArray[np.float64]
#: Lags that are looked for [s].
_LEAST, _MOST = 0.05, 6.0
#: Share of the friction's variance that must be explained at the lag, and by how much more than without one [1].
_EXPLAINED, _MORE = 0.7, 0.1
#: Runs agree on a lag within so many samples.
_AGREED = 2.0
#: Slip rate at which friction has turned [m/s].
_TURNED = 0.02
#: Lags beside the one of largest correlation that are tried [samples].
_BESIDE = 4


@dataclass(frozen=True)
class LateCells:
    """Cells of the pads that come late together.

    Attributes:
        channels: of the cells.
        delay: by which they are late [s].
    """

    channels: tuple[str, ...]
    delay: float


def late_cells(campaign: Campaign) -> LateCells | None:
    """Tell whether the pads' cells are late as one, of a girder that slides by itself; None where they are not."""
    if not campaign.specimen.free:
        return None
    lags = [lag for run in campaign.runs if (lag := _lag(run)) is not None]
    dt = campaign.runs[0].record.dt
    if not lags or abs(float(np.median(lags))) < _LEAST or float(np.ptp(lags)) > _AGREED * dt:
        return None
    names = dict.fromkeys(n for run in campaign.runs for n in run.record.channels if n.startswith("pad_"))
    return LateCells(tuple(names), float(np.median(lags)))


def in_step(record: Record, channels: Sequence[str], delay: float) -> Record:
    """Bring channels forward by a delay [s]; `without_partner` tells where they then show nothing."""
    return record.replaced(**{n: shift(record[n], record.dt, -delay) for n in channels if n in record})


def in_step_campaign(campaign: Campaign, late: LateCells | None) -> Campaign:
    """Give a campaign with its late cells brought forward."""
    if late is None:
        return campaign
    runs = (replace(r, record=in_step(r.record, late.channels, late.delay)) for r in campaign.runs)
    return replace(campaign, runs=tuple(runs))


def without_partner(count: int, dt: float, delay: float) -> NDArray[np.bool_]:
    """Tell at which of a record's samples (n,) late channels have nothing to show once they are brought forward."""
    out = np.zeros(count, dtype=bool)
    whole = min(abs(round(delay / dt)) + 1, count)
    out[count - whole if delay > 0.0 else 0 : count if delay > 0.0 else whole] = True
    return out


def _lag(run: Run) -> float | None:
    """Give by how much the friction of a run comes late [s]; None where it says nothing."""
    record, dt = run.record, run.record.dt
    names = [f"pad_{p}_Fx" for p in PADS]
    if not record.has_all(*names, "slip_x", "girder_ax"):
        return None
    slip = record["slip_x"]
    force = np.sum([record[n] for n in names], axis=0)
    states = [np.tanh(np.gradient(slip, dt) / _TURNED), slip, record["girder_ax"]]
    if not all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (force, *states)):
        return None
    most = min(round(_MOST / dt), len(force) // 2)
    near = range(-_BESIDE, _BESIDE + 1)
    tried = {0, *(_strongest(force, x, most) + beside for x in states for beside in near)}
    shares = {lag: _explained(force, states, lag) for lag in sorted(tried)}
    best = max(shares, key=lambda lag: shares[lag])
    if shares[best] < _EXPLAINED:
        return None
    if shares[best] < shares[0] + _MORE:
        return 0.0
    return dt * (best + _vertex(*(_explained(force, states, best + beside) for beside in (-1, 0, 1))))


def _strongest(force: Array, state: Array, most: int) -> int:
    """Give the lag of the largest correlation [samples]."""
    along = np.abs(correlate(force - force.mean(), state - state.mean(), method="fft"))
    middle = len(state) - 1
    return int(np.argmax(along[middle - most : middle + most + 1])) - most


def _explained(force: Array, states: Sequence[Array], lag: int) -> float:
    """Give the share of the force's variance that the states explain, the force being late by a lag [samples]."""
    late, early = slice(max(lag, 0), len(force) + min(lag, 0)), slice(max(-lag, 0), len(force) - max(lag, 0))
    there = force[late]
    columns = np.column_stack([*(x[early] for x in states), np.ones(len(there))])
    left = there - columns @ np.linalg.lstsq(columns, there, rcond=None)[0]
    return 1.0 - float(np.var(left)) / max(float(np.var(there)), 1e-300)


def _vertex(before: float, here: float, after: float) -> float:
    """Give where the parabola through three values at -1, 0 and 1 is highest, within half a sample."""
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
