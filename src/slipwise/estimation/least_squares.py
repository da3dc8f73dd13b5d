"""Bounded least squares on a problem: Levenberg-Marquardt with finite differences and kept-inside steps."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from slipwise.estimation.parameters import Free
from slipwise.estimation.problem import Problem
from slipwise.estimation.residuals import Residuals

Array = NDArray[np.float64]
#: A fit is over when a step promises less than this much of the squared residual [1].
_ENOUGH = 0.05
_STEP = 1e-3
#: A number whose bounds are this far apart changes at most by this factor in one step: slopes taken a decade away lie.
_DECADES, _LEAP = 100.0, 3.0
#: Slopes are used again while steps keep this share of what they promise [1].
_KEPT_SLOPES = 0.8


@dataclass(frozen=True)
class Solution:
    """What a fit found.

    Attributes:
        values: key -> value, fixed ones included.
        free: what was fitted.
        residuals: at the solution.
        jacobian: (m, k) of the stacked residuals of the fitted runs per unit of `scale` of each free number.
        cost: sum of squared residuals of the fitted runs.
        evaluations: of the problem.
    """

    values: dict[str, float]
    free: tuple[Free, ...]
    residuals: Residuals
    jacobian: Array
    cost: float
    evaluations: int

    @property
    def at_bounds(self) -> tuple[str, ...]:
        """Keys of the numbers that ended on a bound."""
        return tuple(
            f.key for f in self.free if min(self.values[f.key] - f.low, f.high - self.values[f.key]) < 1e-6 * f.scale
        )

    @cached_property
    def normal(self) -> Array:
        """Product of the Jacobian with itself (k, k)."""
        return self.jacobian.T @ self.jacobian

    @property
    def inside(self) -> Array:
        """Columns of the Jacobian of the numbers that ended inside their bounds: the others make up for nothing."""
        ends = set(self.at_bounds)
        return self.jacobian[:, [f.key not in ends for f in self.free]]


def slopes_of(solution: Solution) -> dict[str, Array]:
    """Give the columns of a solution's Jacobian by the keys of its free numbers."""
    return {f.key: solution.jacobian[:, j] for j, f in enumerate(solution.free)}


def jacobian(
    problem: Problem,
    values: Mapping[str, float],
    free: Sequence[Free],
    now: Residuals,
    known: Mapping[str, Array] | None = None,
) -> Array:
    """Give d(residual)/d(value / scale) of the fitted runs, (m, k), by one-sided differences into the bounds."""
    which = problem.fitted
    base = now.stacked(which, problem.relations)
    nearby = problem.near(values)
    out = np.empty((len(free), len(base))).T  # column by column
    for j, f in enumerate(free):
        if known is not None and f.key in known:
            out[:, j] = known[f.key]
            continue
        step = _STEP * f.scale
        if values[f.key] + step > f.high:
            step = -step
        there = nearby.residuals({**values, f.key: values[f.key] + step}, fitted_only=True)
        np.subtract(there.stacked(which, problem.relations), base, out=out[:, j])
        out[:, j] *= f.scale / step
    return out


def solve(
    problem: Problem,
    start: Mapping[str, float],
    free: Sequence[Free],
    *,
    most: int = 12,
    enough: float = _ENOUGH,
    rough: float = 0.0,
    known: Mapping[str, Array] | None = None,
    begin: Mapping[str, Array] | None = None,
) -> Solution:
    """Fit the free numbers to the runs that may be fitted.

    Args:
        problem: relations and noise.
        start: key -> value of everything.
        free: what may change.
        most: Jacobians at most.
        enough: drop of the squared residual below which a further step is not worth it.
        rough: that drop also as a share of what is left above the noise: a law that is wrong needs no fine fit [1].
        known: columns of the Jacobian that a fit nearby has found, by key; they are used as they are.
        begin: the same, but until a step does not keep what they promise.
    """
    which = problem.fitted
    values = dict(start)
    scale = np.array([f.scale for f in free])
    low, high = np.array([f.low for f in free]), np.array([f.high for f in free])
    wide = (low > 0.0) & (high > _DECADES * low)
    now = problem.residuals(values, fitted_only=True)
    left = now.stacked(which, problem.relations)
    cost = float(left @ left)
    damping, evaluations = 1e-6, 1
    normal = np.zeros((len(free), len(free)))
    slopes = np.zeros((len(left), len(free)))
    stale = True
    for _ in range(most):
        if stale:
            taken = begin or known
            slopes = jacobian(problem, values, free, now, taken)
            evaluations += len(free) - len(taken or ())
            normal = slopes.T @ slopes
            begin = None
        gradient = slopes.T @ left
        here = np.array([values[f.key] for f in free])
        better = False
        for _ in range(8):
            nearest, farthest = np.where(wide, here / _LEAP, low), np.where(wide, here * _LEAP, high)
            nearest, farthest = np.maximum(nearest, low), np.minimum(farthest, high)
            step = _bounded_step(normal, gradient, damping, here, nearest, farthest, scale)
            end = np.clip(here + step * scale, nearest, farthest)
            trial = {**values, **{f.key: float(v) for f, v in zip(free, end, strict=True)}}
            moved = problem.residuals(trial, fitted_only=True)
            evaluations += 1
            trial_left = moved.stacked(which, problem.relations)
            trial_cost = float(trial_left @ trial_left)
            if trial_cost < cost:
                better = True
                break
            damping = max(10.0 * damping, 1e-3)
        if not better:
            if stale:
                break
            stale = True
            continue
        gained = cost - trial_cost
        promised = -float(gradient @ step) - 0.5 * float(step @ normal @ step)
        stale = gained < _KEPT_SLOPES * 2.0 * promised
        values, now, left, cost = trial, moved, trial_left, trial_cost
        damping = max(damping / 10.0, 1e-6)
        if gained < enough + rough * max(cost - len(left), 0.0):
            break
    return Solution(values, tuple(free), problem.residuals(values), slopes, cost, evaluations)


def _bounded_step(
    normal: Array, gradient: Array, damping: float, here: Array, low: Array, high: Array, scale: Array
) -> Array:
    """Solve the damped normal equations; numbers that would leave their bounds are put on them and left out."""
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
