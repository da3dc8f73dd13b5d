"""Screening again: what the remaining candidates could explain of what a hypothesis has left.

Each balance counts by what is left of it: a law of not quite the right form in one must not drown what another tells.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.initial_grid import strengths, two_sided
from slipwise.diagnosis.pairs import at_odds
from slipwise.diagnosis.row_subset import on_screen, rows_of
from slipwise.diagnosis.screening import Screened
from slipwise.evidence.acceptance import compute_least_drop
from slipwise.evidence.score import FLOOR
from slipwise.regression.projection import basis_of, project_away

#: Share of the drop for which an effect is kept that a straight line must promise, for a refit [1].
_PROMISED = 0.5


def row_weights(found: Hypothesis) -> Array:
    """Return the weight (q,) of every screened row: one over the level that is left in its relation."""
    levels = {r: max(found.summary.fitted_level(r), FLOOR) for r in found.objective.relations}
    return np.concatenate([np.full(rows, levels[r] ** -0.5) for r, rows in rows_of(found.objective).items()])


def rescreen(screened: Sequence[Screened], before: Hypothesis) -> list[Screened]:
    """Score the remaining candidates against what a hypothesis has left, by the columns that are there already.

    Args:
        screened: candidates against the base.
        before: the hypothesis; its own effects and what is at odds with them are left out.
    """
    weights = row_weights(before)
    basis, residual = _beside(before, weights)
    across = np.column_stack([basis, residual]).T
    out = []
    for s in screened:
        if any(at_odds(s.term, t) for t in before.terms):
            continue
        column = weights * s.column
        *mimicked, along = across @ column
        length = float(column @ column) - float(np.dot(mimicked, mimicked))  # of what the hypothesis cannot mimic
        amount = -float(along) / length if length > 1e-6 * float(column @ column) else 0.0
        if amount > 0.0 or all(two_sided(p) for p in strengths(s.term.effect)):
            out.append(_scaled(s, amount, amount**2 * length))
    return sorted(out, key=lambda s: -s.gain)


def worth_refitting(found: Sequence[Screened], before: Hypothesis, most: int, *, together: bool) -> list[Screened]:
    """Return the leading candidates that promise enough of a relation for a refit.

    Args:
        found: of `rescreen`, best first.
        before: what they were screened against.
        most: candidates at most.
        together: whether each is judged by what it adds to those chosen before it.
    """
    weights = row_weights(before)
    basis, residual = _beside(before, weights)
    edges, counts = _relations(before)
    out: list[Screened] = []
    for s in found:
        if len(out) == most:
            break
        if together and any(at_odds(s.term, chosen.term) for chosen in out):
            continue
        column = project_away(basis, weights * s.column)
        length = float(column @ column)
        amount = -float(column @ residual) / length if length > 1e-6 else 0.0
        if amount <= 0.0 and not all(two_sided(p) for p in strengths(s.term.effect)):
            continue
        moved = residual + amount * column
        drops = np.add.reduceat(residual**2 - moved**2, edges) / np.maximum(counts, 1)
        if float(np.max(drops)) < _PROMISED * compute_least_drop([s.term]):
            continue
        out.append(s)
        if together:
            basis = np.column_stack([basis, column / np.sqrt(length)])
            residual = moved
    return out


def _beside(before: Hypothesis, weights: Array) -> tuple[Array, Array]:
    """Return a basis of what a hypothesis' numbers can do, and what is left beside it, both weighed."""
    solution, objective = before.solution, before.objective
    basis = basis_of(on_screen(objective, solution.inside) * weights[:, None])
    left = on_screen(objective, solution.residuals.stacked(objective.fitted))
    return basis, project_away(basis, weights * left)


def _relations(before: Hypothesis) -> tuple[NDArray[np.int64], Array]:
    """Return where each relation begins among the screened rows, and how many samples of it are judged."""
    rows = rows_of(before.objective)
    begins = np.concatenate([[0], np.cumsum([*rows.values()])[:-1]])
    return begins, np.array([before.summary.counts[r][0] for r in rows])


def _scaled(found: Screened, amount: float, gain: float) -> Screened:
    """Return a candidate with the strength that fits the residual at hand."""
    ratio = amount / found.length if found.length else 0.0
    values = dict(found.values)
    for p in strengths(found.term.effect):
        off = float(p.neutral or 0.0)
        values[p.name] = float(np.clip(off + ratio * (values[p.name] - off), p.low, p.high))
    return replace(found, values=values, gain=gain)
