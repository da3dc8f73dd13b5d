"""Lags of seconds between loggers: which lag lets one channel be explained by others, and channels put back in step."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import correlate

from slipwise.campaign import Campaign
from slipwise.record import Record
from slipwise.signals.shift import shift

Array = NDArray[np.float64]
#: Lags that are looked for [s]; what is below the first is the fits' own business.
LEAST, MOST = 0.05, 6.0
#: Share of a channel's variance that must be explained at the lag, and by how much more than without one [1].
EXPLAINED, MORE = 0.7, 0.1
#: Runs agree on a lag within so many samples.
_AGREED = 2.0


@dataclass(frozen=True)
class LateChannels:
    """Channels of a logger that was started late.

    Attributes:
        channels: of the logger.
        delay: by which they are late [s].
    """

    channels: tuple[str, ...]
    delay: float


def agreed(lags: Sequence[float], dt: float) -> float | None:
    """Give the lag on which runs agree [s]; None where they do not, or it is too short to be looked for."""
    if not lags or abs(float(np.median(lags))) < LEAST or float(np.ptp(lags)) > _AGREED * dt:
        return None
    return float(np.median(lags))


def in_step(record: Record, channels: Sequence[str], delay: float) -> Record:
    """Bring channels forward by a delay [s]; `without_partner` tells where they then show nothing."""
    return record.replaced(**{n: shift(record[n], record.dt, -delay) for n in channels if n in record})


def in_step_campaign(campaign: Campaign, late: Iterable[LateChannels]) -> Campaign:
    """Give a campaign with its late channels brought forward."""
    for one in late:
        runs = (replace(r, record=in_step(r.record, one.channels, one.delay)) for r in campaign.runs)
        campaign = replace(campaign, runs=tuple(runs))
    return campaign


def without_partner(count: int, dt: float, delay: float) -> NDArray[np.bool_]:
    """Tell at which of a record's samples (n,) late channels have nothing to show once they are brought forward."""
    out = np.zeros(count, dtype=bool)
    whole = min(abs(round(delay / dt)) + 1, count)
    out[count - whole if delay > 0.0 else 0 : count if delay > 0.0 else whole] = True
    return out


def strongest(late: Array, state: Array, most: int) -> int:
    """Give the lag of the largest correlation [samples]."""
    along = np.abs(correlate(late - late.mean(), state - state.mean(), method="fft"))
    middle = len(state) - 1
    return int(np.argmax(along[middle - most : middle + most + 1])) - most


def explained(late: Array, states: Sequence[Array], lag: int) -> float:
    """Give the share of a late channel's variance that states explain, for a lag [samples]."""
    there, early = slice(max(lag, 0), len(late) + min(lag, 0)), slice(max(-lag, 0), len(late) - max(lag, 0))
    target = late[there]
    columns = np.column_stack([*(x[early] for x in states), np.ones(len(target))])
    left = target - columns @ np.linalg.lstsq(columns, target, rcond=None)[0]
    return 1.0 - float(np.var(left)) / max(float(np.var(target)), 1e-300)


def vertex(before: float, here: float, after: float) -> float:
    """Give where the parabola through three values at -1, 0 and 1 is highest, within half a sample."""
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
