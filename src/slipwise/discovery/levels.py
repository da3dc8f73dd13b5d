"""What a fit leaves: squared residuals above noise, and levels in noise floors."""

from collections.abc import Sequence

from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective


def excess(problem: Objective, solution: Solution) -> float:
    """Return the squared residual above noise of the relations that have any, over the fitted runs [1]."""
    out = 0.0
    for r in problem.relations:
        left = solution.residuals
        out += max(left.squares(r, problem.fitted) - left.count(r, problem.fitted), 0.0)
    return out


def level(problem: Objective, solution: Solution, relation: str, runs: Sequence[int]) -> float:
    """Return the rms of a relation's residual over some runs, in noise floors."""
    return solution.residuals.level(relation, runs)


def held_out_level(problem: Objective, solution: Solution, relation: str) -> float:
    """Return the same over the held-out runs; over the fitted ones where none is held out."""
    return level(problem, solution, relation, problem.held_out or problem.fitted)
