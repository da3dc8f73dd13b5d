"""The friction model of other programs that comes nearest to a law, over the pressures and speeds that matter.

    Coulomb           mu
    VelDependent      mu = fast - (fast - slow) exp(-rate V)
    VelPressureDep    the same with fast = fast_0 - drop tanh(per_pressure P)

Source: names and forms as in OpenSees' commands `frictionModel`; Constantinou, Mokha, Reinhorn (1990) for both laws.
SAP2000's friction isolator has the second form.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import nnls

from slipwise.arrays import Array
from slipwise.export.friction_states import FrictionStates

#: A plainer model is taken where it errs by no more than this share of friction more than the best [1].
_AS_GOOD = 1e-3
#: Rates that are tried first, times the largest speed [1], and scales of pressure, over the largest pressure [1].
_RATES, _PRESSURES = np.geomspace(0.3, 300.0, 41), np.geomspace(0.05, 5.0, 21)
#: Rounds in which the grid is drawn closer around the best, each by this factor.
_ROUNDS, _CLOSER = 6, 0.25


@dataclass(frozen=True)
class FrictionFit:
    """A friction model with its numbers.

    Attributes:
        kind: "Coulomb", "VelDependent" or "VelPressureDep".
        slow: coefficient at rest [1].
        fast: at high speed; of VelPressureDep without pressure [1].
        rate: how soon speed brings it from slow to fast [s/m]; 0 for Coulomb.
        drop: what pressure can take from `fast` [1].
        per_pressure: how soon it does [1/Pa].
        error: root mean square of its error over that of friction [1].
    """

    kind: str
    slow: float
    fast: float
    rate: float = 0.0
    drop: float = 0.0
    per_pressure: float = 0.0
    error: float = 0.0

    def coefficient(self, pressure: Array, speed: Array) -> Array:
        """Return the coefficient of friction [1] at pressures [Pa] and speeds [m/s]."""
        fast = self.fast - self.drop * np.tanh(self.per_pressure * pressure)
        return fast - (fast - self.slow) * np.exp(-self.rate * speed)

    def erring(self, states: Sequence[FrictionStates]) -> "FrictionFit":
        """Return the same with its error over these states."""
        left = sum(float(s.weight @ (self.coefficient(s.pressure, s.speed) - s.coefficient) ** 2) for s in states)
        whole = sum(float(s.weight @ s.coefficient**2) for s in states)
        return replace(self, error=float(np.sqrt(left / whole)) if whole > 0.0 else 0.0)


def fit_nearest(states: Sequence[FrictionStates]) -> FrictionFit:
    """Return the plainest of the three models that is as good as the best of them."""
    fits = [fit_coulomb(states), fit_rate(states), fit_rate_and_pressure(states)]
    best = min(fit.error for fit in fits)
    return next(fit for fit in fits if fit.error <= best + _AS_GOOD)


def fit_pads(states: Sequence[FrictionStates]) -> dict[str, FrictionFit]:
    """Return the nearest model of each pad: one for all where it is as good as one for each."""
    pads = list(dict.fromkeys(s.pad for s in states))
    of_pad = {pad: [s for s in states if s.pad == pad] for pad in pads}
    common = fit_nearest(states)
    own = {pad: fit_nearest(of) for pad, of in of_pad.items()}
    shared = {pad: common.erring(of) for pad, of in of_pad.items()}
    if max(shared[pad].error - own[pad].error for pad in pads) <= _AS_GOOD:
        return dict.fromkeys(pads, common)
    return own


def fit_coulomb(states: Sequence[FrictionStates]) -> FrictionFit:
    """Return the constant coefficient that errs least."""
    weight = sum(float(s.weight.sum()) for s in states)
    mean = sum(float(s.weight @ s.coefficient) for s in states) / weight if weight > 0.0 else 0.0
    return FrictionFit("Coulomb", mean, mean).erring(states)


def fit_rate(states: Sequence[FrictionStates]) -> FrictionFit:
    """Return the model of speed that errs least; coefficients are not negative."""
    joined = _Joined(states)

    def solved(rate: float, _: float) -> FrictionFit:
        rest = np.exp(-rate * joined.speed)
        slow, fast = joined.solve(rest, 1.0 - rest)
        return FrictionFit("VelDependent", slow, fast, rate)

    return _closest(joined, solved, _RATES / joined.largest_speed, np.ones(1)).erring(states)


def fit_rate_and_pressure(states: Sequence[FrictionStates]) -> FrictionFit:
    """Return the model of speed and pressure that errs least; no coefficient is negative at any pressure."""
    joined = _Joined(states)

    def solved(rate: float, per_pressure: float) -> FrictionFit:
        rest, taken = np.exp(-rate * joined.speed), np.tanh(per_pressure * joined.pressure)
        # fast = limit + drop (1 - tanh): with all three not negative none is negative at any pressure
        slow, limit, drop = joined.solve(rest, 1.0 - rest, (1.0 - rest) * (1.0 - taken))
        return FrictionFit("VelPressureDep", slow, limit + drop, rate, drop, per_pressure)

    rates, scales = _RATES / joined.largest_speed, _PRESSURES / joined.largest_pressure * np.pi
    return _closest(joined, solved, rates, scales).erring(states)


class _Joined:
    """The states of all pads in bins of speed and pressure: no more rows than a fit needs."""

    def __init__(self, states: Sequence[FrictionStates]) -> None:
        speed, pressure, coefficient, weight = (
            np.concatenate([getattr(s, name) for s in states])
            for name in ("speed", "pressure", "coefficient", "weight")
        )
        self.largest_speed = float(speed.max(initial=0.0)) or 1.0
        self.largest_pressure = float(pressure.max(initial=0.0)) or 1.0
        # square root: bins are finest at low speed, where the coefficient changes most
        place = np.stack(
            [np.sqrt(speed / self.largest_speed) * 60.0, pressure / self.largest_pressure * 30.0], axis=1
        ).astype(np.int64)
        _, number = np.unique(place, axis=0, return_inverse=True)
        number = number.ravel()
        summed = np.bincount(number, weights=weight)
        summed = np.where(summed > 0.0, summed, 1.0)

        def mean(values: Array) -> Array:
            return np.bincount(number, weights=weight * values) / summed

        self.speed, self.pressure, self.coefficient = mean(speed), mean(pressure), mean(coefficient)
        self.root = np.sqrt(summed / summed.max())

    def solve(self, *columns: Array) -> list[float]:
        """Return the factors, none negative, with which the columns come nearest to the coefficients."""
        matrix = np.stack([self.root * column for column in columns], axis=1)
        return [float(x) for x in nnls(matrix, self.root * self.coefficient)[0]]

    def left(self, fit: FrictionFit) -> float:
        """Return the squared error that a model leaves."""
        error = self.root * (fit.coefficient(self.pressure, self.speed) - self.coefficient)
        return float(error @ error)


def _closest(
    joined: _Joined, solved: Callable[[float, float], FrictionFit], rates: Array, scales: Array
) -> FrictionFit:
    """Return the model with the least error over a grid of two numbers that is drawn closer round by round."""
    best: FrictionFit | None = None
    for _ in range(_ROUNDS):
        tried = {(float(rate), float(scale)): solved(float(rate), float(scale)) for rate in rates for scale in scales}
        rate, scale = min(tried, key=lambda key: joined.left(tried[key]))
        if best is None or joined.left(tried[rate, scale]) < joined.left(best):
            best = tried[rate, scale]
        rates = _around(rates, rate)
        scales = _around(scales, scale)
    assert best is not None
    return best


def _around(grid: Array, at: float) -> Array:
    """Return a closer grid around one of its values."""
    if len(grid) == 1:
        return grid
    step = (grid[1] / grid[0]) ** _CLOSER
    return at * step ** np.arange(-4.0, 5.0)
