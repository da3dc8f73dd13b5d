"""Squared residuals of a fit by relation: what every judgement of evidence rests on.

Three kinds: of the runs as they were fitted, of each motion by a fit to the others (see `leave_motions_out`), and of
the held-out runs, which are looked at once, at the end, to report.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective
from slipwise.evidence.left_out import LinearFit, fit_linearly, leave_motions_out
from slipwise.noise.independent_samples import SHORTEST_BLOCK
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class ResidualSummary:
    """Squared residuals of a solution, by relation.

    Attributes:
        fitted: relation -> sum over the runs that were fitted.
        left_out: relation -> sum over the same runs, each motion predicted by a fit to the others.
        held_out: relation -> sum over the held-out runs; no choice may depend on it.
        counts: relation -> (samples fitted, samples held out).
        constants: numbers that were fitted.
        blocks: relation -> (b,) sums as in `leave_motions_out` over blocks of `SHORTEST_BLOCK` seconds and over all
            runs of one motion, those of all relations alike.
    """

    fitted: dict[str, float]
    left_out: dict[str, float]
    held_out: dict[str, float]
    counts: dict[str, tuple[int, int]]
    constants: int
    blocks: dict[str, Array]

    @property
    def judged_apart(self) -> bool:
        """Whether any sample that was not fitted is judged: there may be no such run, or its gauges were dead."""
        return any(apart for _, apart in self.counts.values())

    def fitted_level(self, relation: str) -> float:
        """Return the mean squared residual of a relation on the fitted runs in units of the noise's variance."""
        return self.fitted[relation] / max(self.counts[relation][0], 1)

    def left_out_level(self, relation: str) -> float:
        """Return the same where each motion is predicted by a fit to the others."""
        return self.left_out[relation] / max(self.counts[relation][0], 1)

    def held_out_level(self, relation: str) -> float:
        """Return the same on the held-out runs."""
        return self.held_out[relation] / max(self.counts[relation][1], 1)


def summarise_residuals(objective: Objective, solution: Solution) -> ResidualSummary:
    """Sum up a solution's squared residuals."""
    left, both = solution.residuals, (objective.fitted, objective.held_out)
    held_out = {name: left.squares(name, objective.held_out) for name in objective.relations}
    counts = {name: (left.count(name, both[0]), left.count(name, both[1])) for name in objective.relations}
    return summarise_linear_fit(objective, fit_linearly(objective, solution), held_out, counts)


def summarise_linear_fit(
    objective: Objective, fit: LinearFit, held_out: dict[str, float], counts: dict[str, tuple[int, int]]
) -> ResidualSummary:
    """Sum up the squared residuals of a linear fit; what is held out, and the counts, are as given."""
    fitted = {name: float(of.sum()) for name, of in _in_blocks(objective, fit.residual).items()}
    blocks = _in_blocks(objective, leave_motions_out(objective, fit))
    predicted = {name: float(of.sum()) for name, of in blocks.items()}
    return ResidualSummary(fitted, predicted, held_out, counts, fit.constants, blocks)


def _in_blocks(objective: Objective, residual: Array) -> dict[str, Array]:
    """Sum up squared residuals (m,) of the fitted runs in blocks of time, relation -> (b,)."""
    sums: dict[str, dict[int, Array]] = {}
    for rows, of in objective.layout.rows(objective.fitted):
        squares = (residual[rows] ** 2).reshape(len(of.time), -1).sum(axis=1)
        edges = np.arange(0, len(of.time), max(1, round(SHORTEST_BLOCK * objective.scales.time / of.dt)))
        sums.setdefault(of.relation, {})[of.run] = np.add.reduceat(squares, edges)
    groups = objective.motions
    return {name: np.concatenate([_added([of[i] for i in group]) for group in groups]) for name, of in sums.items()}


def _added(parts: Sequence[Array]) -> Array:
    """Add up arrays that may differ in length, from their beginnings."""
    longest = max(len(part) for part in parts)
    return np.sum([np.pad(part, (0, longest - len(part))) for part in parts], axis=0)


def get_error(summary: ResidualSummary, relation: str) -> float:
    """Return the held-out error of a relation in floors; that of the fitted runs where none is held out."""
    held = summary.counts[relation][1] > 0
    return float(np.sqrt(summary.held_out_level(relation) if held else summary.fitted_level(relation)))
