"""Odd and even part of a residual in the direction of sliding: friction errs oddly, tilt, offset and drag evenly."""

from dataclasses import dataclass

import numpy as np

from slipwise.comparison.cells import Samples
from slipwise.comparison.mean_residual import compute_mean_residual
from slipwise.residual_map.splines import choose_equal_bins

#: Bins over speed and over the way since the last reversal.
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
    known = np.isfinite(samples.values["since reversal"]) & (direction != 0.0)
    if np.count_nonzero(known) < _SPEEDS * _WAYS:
        return None
    kinds = ["speed", "since reversal"]
    edges = [choose_equal_bins(samples.values[k][known], n) for k, n in zip(kinds, (_SPEEDS, _WAYS), strict=True)]
    plus, minus = (compute_mean_residual(samples, kinds, edges, way, _FEWEST) for way in (1.0, -1.0))
    both = np.isfinite(plus.mean + minus.mean)
    if not both.any():
        return None
    share = (plus.count + minus.count)[both]
    noise = (plus.error**2 + minus.error**2)[both] / 4.0
    means = 0.5 * (plus.mean - minus.mean), 0.5 * (plus.mean + minus.mean)
    odd, even = (float(np.sqrt(max(np.average(m[both] ** 2 - noise, weights=share), 0.0))) for m in means)
    rms = [float(np.sqrt(np.mean(samples.squared[known & (direction == s)]))) for s in (1.0, -1.0)]
    return Parity(samples.relation, odd, even, rms[0], rms[1])
