"""Odd and even part of a residual in the direction of sliding: friction errs oddly, tilt, offset and drag evenly."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.comparison.cells import Samples

Array = NDArray[np.float64]
_SPEEDS, _WAYS = 6, 4
#: Fewer independent samples than this in either direction say nothing of a bin.
_FEWEST = 6.0


@dataclass(frozen=True)
class Parity:
    """What of a relation's mean residual turns its sign with the direction of sliding.

    Attributes:
        relation: which.
        odd: rms over bins of (mean sliding to +x - mean sliding to -x) / 2, what noise makes of it taken off [floors].
        even: the same of (mean + mean) / 2.
        plus: rms of the residual sliding to +x [floors].
        minus: sliding to -x.
    """

    relation: str
    odd: float
    even: float
    plus: float
    minus: float


def split_odd_and_even(samples: Samples) -> Parity | None:
    """Split a relation's residual, averaged in bins of speed and way since the last reversal; None without motion."""
    direction = samples.values["direction"] - 1.0
    speed, way = samples.values["speed"], samples.values["since reversal"]
    known = np.isfinite(way) & (direction != 0.0)
    if np.count_nonzero(known) < _SPEEDS * _WAYS:
        return None
    bins = _bin(speed, known, _SPEEDS) * _WAYS + _bin(way, known, _WAYS)
    squares: dict[str, float] = {"odd": 0.0, "even": 0.0}
    weight = 0.0
    for number in np.unique(bins[known]):
        here = known & (bins == number)
        sides = [samples.residual[here & (direction == s)] for s in (1.0, -1.0)]
        counts = [len(s) / samples.spread for s in sides]
        if min(counts) < _FEWEST:
            continue
        means = [float(s.mean()) for s in sides]
        noise = sum(float(s.var(ddof=1)) / c for s, c in zip(sides, counts, strict=True)) / 4.0
        share = float(np.count_nonzero(here))
        squares["odd"] += share * ((0.5 * (means[0] - means[1])) ** 2 - noise)
        squares["even"] += share * ((0.5 * (means[0] + means[1])) ** 2 - noise)
        weight += share
    if weight == 0.0:
        return None
    rms = [float(np.sqrt(np.mean(samples.squared[known & (direction == s)]))) for s in (1.0, -1.0)]
    odd, even = (float(np.sqrt(max(squares[k] / weight, 0.0))) for k in ("odd", "even"))
    return Parity(samples.relation, odd, even, rms[0], rms[1])


def _bin(values: Array, known: NDArray[np.bool_], count: int) -> NDArray[np.int64]:
    edges = np.unique(np.quantile(values[known], np.linspace(0.0, 1.0, count + 1)))
    return np.clip(np.searchsorted(edges, np.where(known, values, edges[0]), side="right") - 1, 0, count - 1)
