"""Gauss-Newton for every fit: linearise where the fit stands, move, and stop when a move is not worth another.

What a fit is about is given by two callables: `linearise` gives slopes or normal equations at a point, `move` gives the
next point. How a step is kept safe is the rule that `move` follows:

    damped (`LevenbergMarquardt`)   trials one after the other, each more damped, until one lowers the cost; slopes that
                                    keep their promise are used again. For many numbers and cheap trials.
    undamped                        the full step, where weights change from step to step and costs do not compare.

Source: Nocedal, Wright (2006), Numerical Optimization, chapter 10.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from slipwise.arrays import Array

Point = TypeVar("Point")
Linear = TypeVar("Linear")
#: A number whose bounds are this far apart changes at most by this factor in one step: slopes taken a decade away lie.
_DECADES, _LEAP = 100.0, 3.0
#: Slopes are used again while steps keep this share of what they promise [1].
_KEPT_SLOPES = 0.8
_LEAST_DAMPING, _FIRST_DAMPING, _TRIALS = 1e-6, 1e-3, 8


@dataclass(frozen=True)
class Move(Generic[Point]):
    """One step.

    Attributes:
        point: where it ends; None where no step is an improvement.
        finished: whether a further step is not worth it.
        keep_slopes: whether the slopes are good enough for a further step.
    """

    point: Point | None
    finished: bool = False
    keep_slopes: bool = False


def step_by_gauss_newton(
    start: Point,
    linearise: Callable[[Point], Linear],
    move: Callable[[Point, Linear], Move[Point]],
    *,
    most: int,
    linearised_end: bool = False,
) -> tuple[Point, Linear]:
    """Go from a starting point to where the squared residual is least; give that point and the last linearisation.

    Args:
        start: where to begin.
        linearise: slopes or normal equations at a point.
        move: the next point, by what was linearised.
        most: moves at most, at least one.
        linearised_end: whether the linearisation must belong to the point that is given.
    """
    point, linear, fresh = start, linearise(start), True
    for number in range(1, most + 1):
        moved = move(point, linear)
        if moved.point is None and fresh:
            return point, linear
        if moved.point is not None:
            point = moved.point
        if moved.finished:
            return point, linear
        fresh = not moved.keep_slopes
        if fresh and (linearised_end or number < most):
            del linear  # a long campaign's slopes need not be held twice
            linear = linearise(point)
    return point, linear


@dataclass(frozen=True)
class Bounds:
    """Where numbers may be.

    Attributes:
        low: (k,) lower bounds [SI].
        high: (k,) upper bounds.
        scale: (k,) unit in which each number's steps and slopes are counted.
    """

    low: Array
    high: Array
    scale: Array

    def near(self, here: Array) -> tuple[Array, Array]:
        """Return the bounds (k,), (k,) of one step: a number that spans decades does not leap over them."""
        wide = (self.low > 0.0) & (self.high > _DECADES * self.low)
        nearest, farthest = np.where(wide, here / _LEAP, self.low), np.where(wide, here * _LEAP, self.high)
        return np.maximum(nearest, self.low), np.minimum(farthest, self.high)


@dataclass(frozen=True)
class Slopes:
    """A linearised residual.

    Attributes:
        jacobian: (m, k) of the residuals per unit of each number's scale.
        normal: (k, k) product of the Jacobian with itself.
    """

    jacobian: Array
    normal: Array


@dataclass
class LevenbergMarquardt:
    """Damped steps, which remember how much damping was needed.

    Attributes:
        bounds: of the numbers.
        damping: share of the diagonal that is added to the normal equations [1].
    """

    bounds: Bounds
    damping: float = _LEAST_DAMPING

    def step(
        self, here: Array, residual: Array, slopes: Slopes, evaluate: Callable[[Array], tuple[Point, Array]]
    ) -> tuple[Point, float, bool] | None:
        """Return the point of the first trial that lowers the cost, by how much, and whether the slopes stay good.

        Args:
            here: (k,) numbers.
            residual: (m,) at these numbers.
            slopes: at or near these numbers.
            evaluate: point and residual (m,) at other numbers.
        """
        cost = float(residual @ residual)
        gradient = slopes.jacobian.T @ residual
        nearest, farthest = self.bounds.near(here)
        for _ in range(_TRIALS):
            step = step_within_bounds(slopes.normal, gradient, self.damping, here, nearest, farthest, self.bounds.scale)
            point, left = evaluate(np.clip(here + step * self.bounds.scale, nearest, farthest))
            gained = cost - float(left @ left)
            if gained > 0.0:
                promised = -float(gradient @ step) - 0.5 * float(step @ slopes.normal @ step)
                self.damping = max(self.damping / 10.0, _LEAST_DAMPING)
                return point, gained, gained >= _KEPT_SLOPES * 2.0 * promised
            self.damping = max(10.0 * self.damping, _FIRST_DAMPING)
        return None


def step_within_bounds(
    normal: Array, gradient: Array, damping: float, here: Array, low: Array, high: Array, scale: Array
) -> Array:
    """Solve the damped normal equations (k,); numbers that would leave their bounds are put on them and left out."""
    free = np.ones(len(here), dtype=bool)
    step = np.zeros(len(here))
    weight = np.maximum(np.diag(normal), 1e-12 * max(np.diag(normal).max(), 1e-300))
    for _ in range(len(here)):
        if not free.any():
            break
        part = normal[np.ix_(free, free)] + damping * np.diag(weight[free])
        right = -gradient[free] - normal[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.lstsq(part, right, rcond=1e-12)[0]
        end = here + step * scale
        out = free & ((end < low) | (end > high))
        if not out.any():
            break
        step[out] = (np.clip(end, low, high) - here)[out] / scale[out]
        free &= ~out
    return step
