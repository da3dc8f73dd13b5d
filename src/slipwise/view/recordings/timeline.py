"""The time axis of a recording: which samples are shown, and when."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.record import Record

TIMELINE = "time"
#: Frames a second of a short record, and of one so long that it would have more than `_FRAMES` [1/s].
_FAST, _SLOW, _FRAMES = 100.0, 40.0, 5000


def frames(record: Record, rate: float | None = None) -> NDArray[np.intp]:
    """Return the samples to show, at most `rate` a second [1/s]; 40 to 100 by the record's length if not given."""
    if rate is None:
        rate = float(np.clip(_FRAMES / (len(record) * record.dt), _SLOW, _FAST))
    return np.arange(0, len(record), max(1, round(1.0 / (rate * record.dt))))


def time_column(time: NDArray[np.float64]) -> list[rr.TimeColumn]:
    """Return the column of times that every entity shares; whole nanoseconds, so that entities meet exactly."""
    return [rr.TimeColumn(TIMELINE, duration=np.round(time * 1e9).astype("timedelta64[ns]"))]
