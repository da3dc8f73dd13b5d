"""What a hypothesis is worth: the logarithm of how well it predicts motions that it was not fitted to.

    S = - sum over relations of n/2 ln(max(s2, floor)) - constants/2 ln(n)

with n samples of a relation and s2 their mean squared residual, each motion predicted by a fit to the others, in
variances of the noise. The variance of each relation is thereby its own discrepancy: a law of not quite the right form
that leaves thirty floors in one balance does not drown what another balance tells. The constants cost what they do in
Schwarz (1978).

Whether two hypotheses differ by more than chance is told by the blocks of time in which one is better (Vuong 1989), as
many of them as are independent.

Source: Gneiting, Raftery (2007), Journal of the American Statistical Association 102 (logarithmic score); Schwarz
(1978), Annals of Statistics 6; Vuong (1989), Econometrica 57.
"""

import numpy as np

from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.noise.independent_samples import sum_correlations

#: Mean squared residual below which a relation is as good as it can be [noise variance]: a noise that was thought too
#: large must not turn rounding into evidence.
FLOOR = 0.5


def compute_log_score(summary: ResidualSummary) -> float:
    """Return the score of a hypothesis [nats]."""
    fit = sum(n * np.log(max(summary.left_out_level(r), FLOOR)) for r, (n, _) in summary.counts.items())
    samples = sum(n for n, _ in summary.counts.values())
    return -0.5 * float(fit + summary.constants * np.log(max(samples, 2)))


def compute_score(before: ResidualSummary, after: ResidualSummary) -> float:
    """Return by how much a hypothesis is worth more than another [nats]."""
    return compute_log_score(after) - compute_log_score(before)


def compute_relative_drop(before: ResidualSummary, after: ResidualSummary, relation: str) -> float:
    """Return the share of a relation's mean squared residual that a step takes away, of left-out motions [1]."""
    level = max(before.left_out_level(relation), FLOOR)
    return 1.0 - max(after.left_out_level(relation), FLOOR) / level


def find_largest_drop(before: ResidualSummary, after: ResidualSummary) -> tuple[float, str]:
    """Return the largest `compute_relative_drop` of any relation, and the relation; (0, "") where none falls."""
    best = max((compute_relative_drop(before, after, r), r) for r in before.fitted)
    return best if best[0] > 0.0 else (0.0, "")


def compute_lead(best: ResidualSummary, other: ResidualSummary) -> float:
    """Return by how many standard errors the score of one hypothesis leads that of another, block by block.

    Args:
        best: the one; its own levels are the variances.
        other: fitted to the same runs.
    """
    gains = np.zeros(1)
    for relation, mine in best.blocks.items():
        gains = gains + 0.5 * (other.blocks[relation] - mine) / max(best.left_out_level(relation), FLOOR)
    apart = gains - gains.mean()
    deviation = float(np.sqrt(np.sum(apart**2) * sum_correlations([apart])))
    samples = sum(n for n, _ in best.counts.values())
    cost = 0.5 * (other.constants - best.constants) * np.log(max(samples, 2))
    return float(np.sum(gains) + cost) / max(deviation, 1e-9)
