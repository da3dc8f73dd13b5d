"""Bounded least squares on an objective: Levenberg-Marquardt with finite differences into the bounds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from slipwise.arrays import Array
from slipwise.jobs.parallel import on_every_core
from slipwise.regression.least_squares import Bounds, LevenbergMarquardt, Move, Slopes, step_by_gauss_newton
from slipwise.relations.parameters import Free
from slipwise.relations.table import Residuals
from slipwise.short_repr import short_repr

#: A fit is over when a step promises less than this much of the squared residual [1].
_ENOUGH = 0.05
#: Step of a difference quotient, as a share of what matters of a number [1].
STEP = 1e-3


class Fittable(Protocol):
    """What can be fitted: an `Objective`, or one with something added to its residuals."""

    @property
    def fitted(self) -> list[int]:
        """Places of the runs that may be fitted."""
        ...

    @property
    def relations(self) -> tuple[str, ...]:
        """Names of the relations, in the order in which their residuals are stacked."""
        ...

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there."""
        ...

    def near(self, values: Mapping[str, float]) -> "Fittable":
        """Return what slopes at these values are taken of."""
        ...

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation."""
        ...


@short_repr
@dataclass(frozen=True)
class Solution:
    """What a fit found.

    Attributes:
        values: key -> value, fixed ones included.
        free: what was fitted.
        residuals: at the solution.
        jacobian: (m, k) of the stacked residuals of the fitted runs per unit of `scale` of each free number.
        cost: sum of squared residuals of the fitted runs.
        evaluations: of the objective.
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
    def fit_memory(self) -> int:
        """Bytes that a fit like this one takes: its slopes, those of another point or a part of them, and residuals."""
        return 3 * self.jacobian.nbytes

    @property
    def inside(self) -> Array:
        """Columns of the Jacobian of the numbers that ended inside their bounds: the others make up for nothing."""
        ends = set(self.at_bounds)  # without any, no copy: slopes of a long campaign are large
        return self.jacobian[:, [f.key not in ends for f in self.free]] if ends else self.jacobian


@dataclass(frozen=True)
class _Point:
    values: Mapping[str, float]
    residuals: Residuals
    stacked: Array

    @cached_property
    def cost(self) -> float:
        return float(self.stacked @ self.stacked)


def with_slopes(objective: Fittable, solution: Solution) -> Solution:
    """Return a solution with slopes taken at its own numbers."""
    slopes = compute_jacobian(objective, solution.values, solution.free, solution.residuals)
    return replace(solution, jacobian=slopes)


def get_slopes(solution: Solution) -> dict[str, Array]:
    """Return the columns of a solution's Jacobian by the keys of its free numbers; none where it was not kept."""
    return {f.key: solution.jacobian[:, j] for j, f in enumerate(solution.free) if len(solution.jacobian)}


def compute_jacobian(
    objective: Fittable,
    values: Mapping[str, float],
    free: Sequence[Free],
    now: Residuals,
    known: Mapping[str, Array] | None = None,
) -> Array:
    """Return d(residual)/d(value / scale) of the fitted runs, (m, k), by one-sided differences into the bounds."""
    which = objective.fitted
    base = now.stacked(which)
    nearby = objective.near(values)
    out = np.empty((len(free), len(base))).T  # column by column
    taken = known or {}
    missing = [j for j, f in enumerate(free) if f.key not in taken]

    def column(j: int) -> Array:
        step = STEP * free[j].scale
        if values[free[j].key] + step > free[j].high:
            step = -step
        there = nearby.residuals({**values, free[j].key: values[free[j].key] + step}, fitted_only=True)
        return (there.stacked(which) - base) * (free[j].scale / step)

    if objective.balanced:  # one slider's laws are so quick that to share them out takes longer
        columns = on_every_core(lambda k: column(missing[k]), len(missing))
    else:
        columns = map(column, missing)
    for j, f in enumerate(free):
        out[:, j] = taken[f.key] if f.key in taken else next(columns)
    return out


def solve(
    objective: Fittable,
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
        objective: relations and noise.
        start: key -> value of everything.
        free: what may change.
        most: Jacobians at most.
        enough: drop of the squared residual below which a further step is not worth it.
        rough: that drop also as a share of what is left above the noise: a law that is wrong needs no fine fit [1].
        known: columns of the Jacobian that a fit nearby has found, by key; they are used as they are.
        begin: the same, but until a step does not keep what they promise.
    """
    which = objective.fitted
    bounds = Bounds(*(np.array([getattr(f, end) for f in free]) for end in ("low", "high", "scale")))
    rule = LevenbergMarquardt(bounds)
    evaluations = 1
    taken = [begin or known]

    def at(values: Mapping[str, float]) -> _Point:
        now = objective.residuals(values, fitted_only=True)
        return _Point(values, now, now.stacked(which))

    def linearise(point: _Point) -> Slopes:
        nonlocal evaluations
        columns = taken.pop() if taken else known
        evaluations += len(free) - len(columns or ())
        slopes = compute_jacobian(objective, point.values, free, point.residuals, columns)
        return Slopes(slopes, slopes.T @ slopes)

    def move(point: _Point, slopes: Slopes) -> Move[_Point]:
        def evaluate(end: Array) -> tuple[_Point, Array]:
            nonlocal evaluations
            evaluations += 1
            trial = at({**point.values, **{f.key: float(v) for f, v in zip(free, end, strict=True)}})
            return trial, trial.stacked

        here = np.array([point.values[f.key] for f in free])
        found = rule.step(here, point.stacked, slopes, evaluate)
        if found is None:
            return Move(None)
        end, gained, good = found
        above = max(end.cost - len(end.stacked), 0.0)
        return Move(end, finished=gained < enough + rough * above, keep_slopes=good)

    end, slopes = step_by_gauss_newton(at(dict(start)), linearise, move, most=most)
    residuals = objective.residuals(end.values)
    return Solution(dict(end.values), tuple(free), residuals, slopes.jacobian, end.cost, evaluations)
