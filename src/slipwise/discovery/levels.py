"""What a fit leaves: squared residuals above noise, and levels in noise floors."""

from collections.abc import Sequence

from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective


def excess(objective: Objective, solution: Solution) -> float:
    """Return the squared residual above noise of the relations that have any, over the fitted runs [1]."""
    out = 0.0
    for r in objective.relations:
        left = solution.residuals
        out += max(left.squares(r, objective.fitted) - left.count(r, objective.fitted), 0.0)
    return out


def level(objective: Objective, solution: Solution, relation: str, runs: Sequence[int]) -> float:
    """Return the rms of a relation's residual over some runs, in noise floors."""
    return solution.residuals.level(relation, runs)


def held_out_level(objective: Objective, solution: Solution, relation: str) -> float:
    """Return the same over the held-out runs; over the fitted ones where none is held out."""
    return level(objective, solution, relation, objective.held_out or objective.fitted)
