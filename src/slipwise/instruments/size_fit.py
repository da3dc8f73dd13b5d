"""Sizes of chosen faults and disturbances, with the constants of the rig, by weighed least squares."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.evidence.posterior import NormalSystem, make_normal_system
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
        system = _weigh(linear, places, left)
        solution = invert_regularised(system.regular) @ system.pull
        squares = s.squares + 2.0 * pulls @ solution + np.einsum("i,kij,j->k", solution, products, solution)
        left = np.maximum(squares, 0.0) / counts
    most = _WIDEST * Prior().large[-1]
    sizes = dict(zip(chosen, solution[s.base :].clip(-most, most).tolist(), strict=True))
    return SizeFit(linear, solution[: s.base], sizes, np.sqrt(left))


def compute_gain(alone: SizeFit, number: int) -> float:
    """Return about how much a column would explain beside the constants alone [nats]."""
    linear, s = alone.linear, alone.linear.statistics
    places = np.append(np.arange(s.base), s.base + number)
    system = _weigh(linear, places, alone.left**2)
    whole, pull = system.regular, system.pull
    free = invert_regularised(whole[:-1, :-1])
    own = whole[-1, -1] - whole[-1, :-1] @ free @ whole[:-1, -1]
    pulled = pull[-1] - whole[-1, :-1] @ free @ pull[:-1]
    return float(0.5 * pulled**2 / own) if own > 0.0 else 0.0


def _weigh(linear: LinearBalances, places: NDArray[np.int64], left: Array) -> NormalSystem:
    """Return the normal equations of some columns, every relation weighed by the mean square of what is left [floor^2].

    What no sample shows is not as large as it likes: sizes have the widest prior of what matters.
    """
    s = linear.statistics
    chosen = replace(s, products=s.products[:, places][:, :, places], pulls=s.pulls[:, places])
    room = np.full(len(places) - s.base, Prior().large[-1])
    return make_normal_system(chosen, linear.tolerances, np.maximum(left, Prior().floor), room)
