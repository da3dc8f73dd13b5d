"""What a fit leaves: squared residuals above noise, and levels in noise floors."""

from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective


def excess(objective: Objective, solution: Solution) -> float:
    """Return the squared residual above noise of the relations that have any, over the fitted runs [1]."""
    out = 0.0
    for r in objective.relations:
        left = solution.residuals
        out += max(left.squares(r, objective.fitted) - left.count(r, objective.fitted), 0.0)
    return out


def held_out_level(objective: Objective, solution: Solution, relation: str) -> float:
    """Return the rms of a residual over the held-out runs, or the fitted ones where none is held out [noise floors]."""
    return solution.residuals.level(relation, objective.held_out or objective.fitted)
