"""What steady sliding tells of a gauge that never rests: force and load scatter about a smooth line.

An actuator that draws a slider at one speed shows the noise of its gauges together with that of the contact itself,
which no law of friction explains: asperities, debris, a controller that hunts. It is slower than white noise, so the
top of a spectrum misses it.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.record import Record

Array = NDArray[np.float64]
#: Samples of a stretch, the least stretches that tell something, and the share of them that are the calmest [1].
_LENGTH, _ENOUGH, _CALMEST = 128, 3, 0.25
#: A stretch is steady where the speed changes by less than this share of itself, and slip is that many times its noise.
_CHANGE, _MOVED = 0.1, 20.0


def steady_level(records: Sequence[Record], channel: str) -> float:
    """Give the scatter of one sample of a channel while a slider is drawn steadily; 0 where none ever is.

    Args:
        records: of the runs, with slip_x.
        channel: of friction or load.
    """
    levels = [
        _scatter(record[channel][part])
        for record in records
        if "slip_x" in record and channel in record
        for part in _steady(record["slip_x"])
    ]
    return float(np.quantile(levels, _CALMEST)) if len(levels) >= _ENOUGH else 0.0


def _steady(slip: Array) -> Iterator[slice]:
    for start in range(0, len(slip) - _LENGTH + 1, _LENGTH):
        part = slice(start, start + _LENGTH)
        place = np.linspace(-1.0, 1.0, _LENGTH)
        fit = np.polynomial.polynomial.polyfit(place, slip[part], 2)
        left = float(np.std(slip[part] - np.polynomial.polynomial.polyval(place, fit)))
        if abs(4.0 * fit[2]) < _CHANGE * abs(fit[1]) and abs(fit[1]) > _MOVED * left / np.sqrt(_LENGTH):
            yield part


def _scatter(values: Array) -> float:
    place = np.linspace(-1.0, 1.0, len(values))
    fit = np.polynomial.polynomial.polyfit(place, values, 2)
    return float(np.sqrt(np.sum((values - np.polynomial.polynomial.polyval(place, fit)) ** 2) / (len(values) - 3)))
