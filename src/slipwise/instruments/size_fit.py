"""Sizes of chosen faults and disturbances, with the constants of the rig, by weighed least squares."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.prior import Prior
from slipwise.instruments.balances_case import Point
from slipwise.instruments.linearised_balances import LinearBalances
from slipwise.regression.normal_equations import invert_regularised

#: Relations weigh by what is left in them, which is estimated so often.
_TIMES = 6
#: Standard deviations of the widest prior beyond which no size is taken out of records [1].
_WIDEST = 3.0


@dataclass(frozen=True)
class SizeFit:
    """A fit of constants and of some columns.

    Attributes:
        linear: the balances that were fitted.
        steps: (b,) of the constants.
        sizes: number of a column -> size [its unit].
        left: (r,) root of the mean square of what is left of each relation [floors].
    """

    linear: LinearBalances
    steps: Array
    sizes: dict[int, float]
    left: Array

    @property
    def point(self) -> Point:
        """Constants and sizes of faults [SI] as fitted."""
        constants = {n: v + float(d) for (n, v), d in zip(self.linear.point.constants.items(), self.steps, strict=True)}
        faults = [(self.linear.columns[i].suspect, b) for i, b in self.sizes.items()]
        kept = [(s, b * s.least) for s, b in faults if s is not None and not (s.one_sided and b <= 0.0)]
        return Point(constants, tuple(kept))


def fit_sizes(linear: LinearBalances, chosen: Sequence[int]) -> SizeFit:
    """Fit constants and the columns of some numbers; a relation weighs by what is left in it, as in the posterior."""
    s = linear.statistics
    places = np.concatenate([np.arange(s.base), s.base + np.array(chosen, dtype=np.int64)])
    products, pulls = s.products[:, places][:, :, places], s.pulls[:, places]
    counts = np.maximum(s.rows, 1.0)
    left, solution = s.squares / counts, np.zeros(len(places))
    for _ in range(_TIMES):
        whole, pull = _weigh(linear, products, pulls, left)
        solution = invert_regularised(whole) @ pull
        squares = s.squares + 2.0 * pulls @ solution + np.einsum("i,kij,j->k", solution, products, solution)
        left = np.maximum(squares, 0.0) / counts
    most = _WIDEST * Prior().large[-1]
    sizes = dict(zip(chosen, solution[s.base :].clip(-most, most).tolist(), strict=True))
    return SizeFit(linear, solution[: s.base], sizes, np.sqrt(left))


def compute_gain(alone: SizeFit, number: int) -> float:
    """Return about how much a column would explain beside the constants alone [nats]."""
    linear, s = alone.linear, alone.linear.statistics
    places = np.append(np.arange(s.base), s.base + number)
    whole, pull = _weigh(linear, s.products[:, places][:, :, places], s.pulls[:, places], alone.left**2)
    free = invert_regularised(whole[:-1, :-1])
    own = whole[-1, -1] - whole[-1, :-1] @ free @ whole[:-1, -1]
    pulled = pull[-1] - whole[-1, :-1] @ free @ pull[:-1]
    return float(0.5 * pulled**2 / own) if own > 0.0 else 0.0


def _weigh(linear: LinearBalances, products: Array, pulls: Array, left: Array) -> tuple[Array, Array]:
    """Return the normal equations, every relation weighed by the mean square of what is left in it [floor^2].

    Unlike in `make_normal_system` nothing holds the constants: in SI units they differ by ten orders of magnitude.
    """
    prior, s = Prior(), linear.statistics
    weights = 1.0 / (np.maximum(left, prior.floor) * prior.compute_coarsening(s.rows))
    whole, pull = np.tensordot(weights, products, 1), -weights @ pulls
    beside = np.arange(s.base, len(pull))
    whole[beside, beside] += prior.large[-1] ** -2.0  # what no sample shows is not as large as it likes
    for place, (off, deviation) in linear.tolerances.items():
        whole[place, place] += deviation**-2.0
        pull[place] += off * deviation**-2.0
    return whole, pull
