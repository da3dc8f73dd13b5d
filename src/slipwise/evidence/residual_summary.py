"""Squared residuals of a fit by relation, on fitted and on held-out runs: what every judgement of evidence rests on."""

from dataclasses import dataclass

import numpy as np

from slipwise.estimation.least_squares import Solution
from slipwise.estimation.problem import Problem


@dataclass(frozen=True)
class ResidualSummary:
    """Squared residuals of a solution, by relation.

    Attributes:
        fitted: relation -> sum over the runs that were fitted.
        held_out: relation -> sum over the runs that were not.
        counts: relation -> (samples fitted, samples held out).
    """

    fitted: dict[str, float]
    held_out: dict[str, float]
    counts: dict[str, tuple[int, int]]

    def level(self, relation: str, *, held_out: bool) -> float:
        """Give the mean squared residual of a relation in units of the noise's variance."""
        total, count = (self.held_out, 1) if held_out else (self.fitted, 0)
        return total[relation] / max(self.counts[relation][count], 1)

    @property
    def total(self) -> float:
        """Sum over all runs and relations."""
        return sum(self.fitted.values()) + sum(self.held_out.values())


def summarised(problem: Problem, solution: Solution) -> ResidualSummary:
    """Sum up a solution's squared residuals."""
    parts = solution.residuals.parts
    fitted, held_out, counts = {}, {}, {}
    for name in problem.relations:
        samples = [int(np.count_nonzero(run.judged[name])) for run in problem.runs]
        of = [(float(np.sum(part**2)), count) for part, count in zip(parts[name], samples, strict=True)]
        fitted[name] = sum(of[i][0] for i in problem.fitted)
        held_out[name] = sum(of[i][0] for i in problem.held_out)
        counts[name] = (sum(of[i][1] for i in problem.fitted), sum(of[i][1] for i in problem.held_out))
    return ResidualSummary(fitted, held_out, counts)


def error_of(summary: ResidualSummary, relation: str) -> float:
    """Give the held-out error of a relation in floors; that of the fitted runs where none is held out."""
    held = summary.counts[relation][1] > 0
    return float(np.sqrt(summary.level(relation, held_out=held)))
