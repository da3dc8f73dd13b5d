"""What a fit leaves: squared residuals above noise, and levels in noise floors."""

from collections.abc import Sequence

import numpy as np

from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Problem
from slipwise.evidence.residual_summary import mean_square


def excess(problem: Problem, solution: Solution) -> float:
    """Return the squared residual above noise of the relations that have any, over the fitted runs [1]."""
    out = 0.0
    for r in problem.relations:
        left = sum(float(np.sum(solution.residuals.parts[r][i] ** 2)) for i in problem.fitted)
        out += max(left - sum(int(np.count_nonzero(problem.runs[i].judged[r])) for i in problem.fitted), 0.0)
    return out


def level(problem: Problem, solution: Solution, relation: str, runs: Sequence[int]) -> float:
    """Return the rms of a relation's residual over some runs, in noise floors."""
    return float(np.sqrt(mean_square(problem, solution, relation, runs)))


def held_out_level(problem: Problem, solution: Solution, relation: str) -> float:
    """Return the same over the held-out runs; over the fitted ones where none is held out."""
    return level(problem, solution, relation, problem.held_out or problem.fitted)
