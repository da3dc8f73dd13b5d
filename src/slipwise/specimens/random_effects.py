"""Mean of a number over specimens, and its spread between them: the normal model of random effects.

    y_i = mean + spread * z_i + error_i * e_i,    z, e standard normal

The spread is that at which the weighted squares are as large as they should be (Paule, Mandel 1982, J. Res. NBS 87),
its interval from the same sum (Viechtbauer 2007, Statistics in Medicine 26), and that of the mean by Student's t and no
less than the errors say (Knapp, Hartung 2003, Statistics in Medicine 22).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
from scipy.optimize import brentq
from scipy.stats import chi2
from scipy.stats import t as student

from slipwise.arrays import Array
from slipwise.estimation.intervals import COVERAGE


@dataclass(frozen=True)
class RandomEffects:
    """A number over specimens.

    Attributes:
        mean: over specimens [unit].
        low: lower end of its 95 % interval.
        high: upper end.
        spread: standard deviation between specimens [unit].
        spread_low: lower end of its 95 % interval.
        spread_high: upper end.
        differ: probability of so large differences between specimens that are alike [1].
    """

    mean: float
    low: float
    high: float
    spread: float
    spread_low: float
    spread_high: float
    differ: float


def combine(values: Sequence[float] | Array, errors: Sequence[float] | Array) -> RandomEffects:
    """Combine a number of several specimens.

    Args:
        values: of two specimens at least [unit].
        errors: their standard errors, above zero [unit].
    """
    y, e = np.asarray(values, float), np.asarray(errors, float)
    unit = float(e.max())
    y, e = y / unit, e / unit
    free = len(y) - 1
    spread = _find_spread(y, e, float(free))
    tail = 0.5 * (1.0 - COVERAGE)
    ends = [_find_spread(y, e, float(chi2.ppf(p, free))) for p in (1.0 - tail, tail)]
    weights = 1.0 / (e**2 + spread**2)
    mean = float(weights @ y / weights.sum())
    over = max(1.0, _sum_squares(y, e, spread) / free)
    half = float(student.ppf(1.0 - tail, free)) * float(np.sqrt(over / weights.sum()))
    differ = float(chi2.sf(_sum_squares(y, e, 0.0), free))
    return RandomEffects(
        mean * unit, (mean - half) * unit, (mean + half) * unit, spread * unit, ends[0] * unit, ends[1] * unit, differ
    )


def _sum_squares(y: Array, e: Array, spread: float) -> float:
    weights = 1.0 / (e**2 + spread**2)
    return float(weights @ (y - weights @ y / weights.sum()) ** 2)


def _find_spread(y: Array, e: Array, wanted: float) -> float:
    """Return the spread at which the weighted squares have this sum; 0 where they are smaller without any."""
    if _sum_squares(y, e, 0.0) <= wanted:
        return 0.0
    most = float(np.ptp(y)) + float(e.max())
    while _sum_squares(y, e, most) > wanted:
        most *= 2.0
    root = brentq(lambda spread: _sum_squares(y, e, spread) - wanted, 0.0, most)
    return float(cast(float, root))
