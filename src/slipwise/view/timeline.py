"""The time axis of a recording: which samples are shown, and when."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.record import Record

TIMELINE = "time"
#: A display shows no more frames than this [1/s].
_FRAME_RATE = 100.0


def frames(record: Record, rate: float = _FRAME_RATE) -> NDArray[np.intp]:
    """Give the samples to show, at most `rate` a second [1/s]."""
    return np.arange(0, len(record), max(1, round(1.0 / (rate * record.dt))))


def time_column(time: NDArray[np.float64]) -> list[rr.TimeColumn]:
    """Give the column of times that every entity shares; whole nanoseconds, so that entities meet exactly."""
    return [rr.TimeColumn(TIMELINE, duration=np.round(time * 1e9).astype("timedelta64[ns]"))]
