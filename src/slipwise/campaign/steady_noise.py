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
        (_, rate, bend), left = _about_a_curve(slip[part])
        if abs(4.0 * bend) < _CHANGE * abs(rate) and abs(rate) > _MOVED * float(np.std(left)) / np.sqrt(_LENGTH):
            yield part


def _scatter(values: Array) -> float:
    curve, left = _about_a_curve(values)
    return float(np.sqrt(left @ left / (len(values) - len(curve))))


def _about_a_curve(values: Array) -> tuple[Array, Array]:
    """Give the parabola through values (n,), its coefficients over -1 to 1, and what is left of them (n,)."""
    place = np.linspace(-1.0, 1.0, len(values))
    curve = np.asarray(np.polynomial.polynomial.polyfit(place, values, 2), dtype=np.float64)
    return curve, values - np.polynomial.polynomial.polyval(place, curve)
