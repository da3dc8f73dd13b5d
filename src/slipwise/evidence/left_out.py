"""Leave one motion out: what a fit would leave of runs that it had not seen, without fitting again.

With residuals r, slopes J and the rows of one motion g, the other rows alone would have led Gauss-Newton to

    d = -(J'J - J_g'J_g)^-1 (J'r - J_g'r_g),    and left of the motion    r_g + J_g d

so a number that bends to one motion is judged by what it does to the others. A repeat is the same motion again and is
left out with it. Where all fitted runs are of one motion, stretches of time are left out instead. A number that the
rows that stay tell nothing of keeps its value.

Source: Stone (1974), Journal of the Royal Statistical Society B 36; one Gauss-Newton step in the place of a refit:
Cook, Weisberg (1982), Residuals and Influence in Regression, section 5.2.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective

#: Stretches of time that are left out one by one where there is one motion only [1].
_STRETCHES = 4
#: What keeps a number in its place that the other rows do not tell, as a share of what all rows tell of it [1].
_RIDGE = 1e-4
#: Slopes lie further away than this [scale of the number].
_REACH = 1.0


def _parts(objective: Objective) -> tuple[list[tuple[slice, int]], int]:
    """Return rows of the stacked residuals with the number of what is left out, and how many are left out."""
    every = list(objective.layout.rows(objective.fitted))
    groups = len({of.motion for _, of in every})
    if groups > 1:
        return [(rows, of.motion) for rows, of in every], groups
    out: list[tuple[slice, int]] = []
    for rows, of in every:
        samples, width = of.columns.shape
        edges = rows.start + width * np.linspace(0, samples, _STRETCHES + 1).astype(int)
        out += [(slice(*ends), n) for n, ends in enumerate(zip(edges[:-1], edges[1:], strict=True))]
    return out, _STRETCHES


@dataclass(frozen=True)
class LinearFit:
    """A fit and what is near it: residuals of the fitted runs, stacked, and their slopes.

    Attributes:
        residual: (m,) [noise].
        slopes: (m, k) per unit of each number's scale; of the numbers inside their bounds.
        low: (k,) how far each number may go down [its scale].
        high: (k,) how far up.
        constants: numbers that were fitted, those on bounds included.
    """

    residual: Array
    slopes: Array
    low: Array
    high: Array
    constants: int


def fit_linearly(objective: Objective, solution: Solution) -> LinearFit:
    """Return a solution as a linear fit."""
    residual = solution.residuals.stacked(objective.fitted)
    ends = set(solution.at_bounds)
    free = [f for f in solution.free if f.key not in ends]
    room = [((f.low - solution.values[f.key]) / f.scale, (f.high - solution.values[f.key]) / f.scale) for f in free]
    low, high = np.array(room).reshape(-1, 2).T
    low, high = np.maximum(low, -_REACH), np.minimum(high, _REACH)
    return LinearFit(residual, solution.inside, low, high, len(solution.free))


def leave_motions_out(objective: Objective, fit: LinearFit) -> Array:
    """Return what is left of every motion by a fit to the others, (m,) like the stacked residuals [noise].

    Args:
        objective: relations and noise.
        fit: of a hypothesis to all its fitted runs.
    """
    parts, count = _parts(objective)
    width = fit.slopes.shape[1]
    normal, right = np.zeros((count, width, width)), np.zeros((count, width))
    for rows, number in parts:
        slopes = fit.slopes[rows]
        normal[number] += slopes.T @ slopes
        right[number] += slopes.T @ fit.residual[rows]
    whole, pull = normal.sum(axis=0), right.sum(axis=0)
    ridge = np.diag(_RIDGE * np.diag(whole) + 1e-12)
    steps = [
        np.clip(-np.linalg.lstsq(whole - normal[g] + ridge, pull - right[g], rcond=1e-12)[0], fit.low, fit.high)
        for g in range(count)
    ]
    out = np.empty_like(fit.residual)
    for rows, number in parts:
        out[rows] = fit.residual[rows] + fit.slopes[rows] @ steps[number]
    return out
