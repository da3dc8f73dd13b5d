"""Pairs: two effects that explain little alone but much together, as heating and run-in that hide each other."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.row_subset import on_screen
from slipwise.diagnosis.screening import Screened
from slipwise.estimation.base_fit import BaseFit
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import Term

#: A pair that screens this much better than the best single's best partner is tried too.
_PAIR_LEAD = 1.15
_PAIR_POOL = 24


def leading_pair(
    base: BaseFit, screened: Sequence[Screened], best: Hypothesis | None, least: float
) -> tuple[Screened, Screened] | None:
    """Return the pair that screens best, if the best single is not part of it or there is none.

    Args:
        base: the base fit.
        screened: candidates by their score against it.
        best: the best hypothesis of one effect.
        least: gain that is worth a refit [1].
    """
    pool = screened[:_PAIR_POOL]
    if len(pool) < 2:
        return None
    objective = base.objective
    project = make_projector(on_screen(objective, base.solution.inside))
    residual = project(on_screen(objective, base.solution.residuals.stacked(objective.fitted)))
    columns = np.stack([s.column for s in pool], axis=1)
    gram, right = columns.T @ columns, -(columns.T @ residual)
    gains: dict[tuple[int, int], float] = {}
    for i in range(len(pool)):
        for j in range(i):
            a, b = pool[i].term, pool[j].term
            if a.effect.name == b.effect.name or at_odds(a, b):
                continue
            two = gram[np.ix_([i, j], [i, j])]
            if abs(two[0, 1]) > 0.98:
                continue
            amounts = np.linalg.solve(two, right[[i, j]])
            if (amounts > 0.0).all():
                gains[(j, i)] = float(amounts @ right[[i, j]])
    top = max(gains, key=lambda k: gains[k], default=None)
    if top is None or gains[top] < least:
        return None
    leader = best.terms[0].label if best else pool[0].term.label
    labels = {k: (pool[k[0]].term.label, pool[k[1]].term.label) for k in gains}
    with_leader = max((g for k, g in gains.items() if leader in labels[k]), default=0.0)
    if leader in labels[top] and best is not None:
        return None
    if gains[top] < _PAIR_LEAD * with_leader and best is not None:
        return None
    return pool[top[0]], pool[top[1]]


def at_odds(a: Term, b: Term) -> bool:
    """Return whether two terms cannot be in one hypothesis: one sticks beside a stick or train, or one on a channel."""
    if a.effect.reverses and b.effect.reverses and ("stick" in a.effect.hooks or "stick" in b.effect.hooks):
        return True
    return a.effect.name == b.effect.name and bool(set(a.targets) & set(b.targets))
