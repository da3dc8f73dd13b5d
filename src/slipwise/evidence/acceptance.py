"""When an effect is kept in the model: it must predict motions that it was not fitted to, and more than a trifle.

Significance alone is no rule, for a modeller's own small errors are significant too: a tenth of a sample, a filter of
not quite the right order. They look like lags of gauges, not like laws of pads and buffers, of which less will do. What
is kept need not matter to anybody: whether it does is told by `materiality`.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import FLOOR, compute_score
from slipwise.relations.parameters import Term
from slipwise.rig.load_basis import WARPS


@dataclass(frozen=True)
class Acceptance:
    """Least shares of a relation's mean squared residual that a step must take away [1].

    Attributes:
        law: of a law: of 400 complete models of the blind bench none had one that lowered any relation by 0.035.
        everywhere: of what acts on every force or motion at once, and so takes up a modeller's errors.
        spoilt: by how much a relation may have become worse before a step that repairs it: right effects raised none
            by more than 0.012, wrong ones one by 0.08.
        hidden: unless its mean squared residual is so large that something else must be hidden there [noise variance],
        gained: and the score gains more than this many times what the relation loses.
    """

    law: float = 0.05
    everywhere: float = 0.10
    spoilt: float = 0.03
    hidden: float = 2.0
    gained: float = 3.0


LEAST = Acceptance()
#: Ports of what acts on every force or motion at once.
_EVERYWHERE = ("gauge", "girder", "table")


def compute_least_drop(terms: Iterable[Term]) -> float:
    """Return the share of a relation's mean squared residual that effects must take away to be kept [1]."""
    return LEAST.everywhere if any(t.effect.port in _EVERYWHERE for t in terms) else LEAST.law


def is_kept(base: ResidualSummary, before: ResidualSummary, after: ResidualSummary, least: float) -> bool:
    """Return whether a step is worth being kept.

    An effect that only repairs what the one before has spoilt explains nothing of the rig, and a relation that is left
    with less than its noise has nothing to explain: that noise was thought too large.

    Args:
        base: of the base model.
        before: without the effect.
        after: with it.
        least: of `compute_least_drop`.
    """
    if compute_score(before, after) <= 0.0 or does_worsen(before, after):
        return False
    lower = {r: max(min(base.left_out_level(r), before.left_out_level(r)), FLOOR) for r in base.fitted}
    return any(of > 1.0 and 1.0 - max(after.left_out_level(r), FLOOR) / of >= least for r, of in lower.items())


def does_worsen(before: ResidualSummary, after: ResidualSummary) -> bool:
    """Return whether a step repairs some relation at the cost of another.

    Where something else is still hidden in that relation a right effect may cost some, if the score gains far more. The
    warps are one relation here: of pads that stand unevenly one after the other is found, and each moves all of them.
    """
    was, now = _levels(before), _levels(after)
    relation = max(now, key=lambda r: now[r][0] / was[r][0])
    (there, samples), (here, _) = was[relation], now[relation]
    if 1.0 - there / here <= LEAST.spoilt:
        return False
    lost = 0.5 * samples * float(np.log(here / there))
    return there < LEAST.hidden or compute_score(before, after) < LEAST.gained * lost


def _levels(summary: ResidualSummary) -> dict[str, tuple[float, int]]:
    """Return the mean squared residual of every relation [noise variance], and its samples; all warps as one."""
    sums: dict[str, tuple[float, int]] = {}
    for relation in summary.fitted:
        name = WARPS[0] if relation in WARPS else relation
        total, samples = sums.get(name, (0.0, 0))
        sums[name] = total + summary.left_out[relation], samples + summary.counts[relation][0]
    return {name: (max(total / max(samples, 1), FLOOR), samples) for name, (total, samples) in sums.items()}
