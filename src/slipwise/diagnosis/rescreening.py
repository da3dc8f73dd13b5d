"""Screening again: what the remaining candidates could explain of what a hypothesis has left."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.pairs import at_odds
from slipwise.diagnosis.screening import Screened, away_from, basis_of
from slipwise.diagnosis.starting_grid import strengths, two_sided


def rescreen(screened: Sequence[Screened], before: Hypothesis) -> list[Screened]:
    """Score the remaining candidates against what a hypothesis has left, by the columns that are there already.

    Args:
        screened: candidates against the base.
        before: the hypothesis; its own effects and what is at odds with them are left out.
    """
    problem, solution = before.problem, before.solution
    basis = basis_of(solution.inside)
    residual = away_from(basis, solution.residuals.stacked(problem.fitted, problem.relations))
    across = np.column_stack([basis, residual]).T
    out = []
    for s in screened:
        if any(at_odds(s.term, t) for t in before.terms):
            continue
        column = s.column.astype(np.float64)
        *mimicked, along = across @ column
        length = float(column @ column) - float(np.dot(mimicked, mimicked))  # of what the hypothesis cannot mimic
        amount = -float(along) / length if length > 1e-6 else 0.0
        if amount > 0.0 or all(two_sided(p) for p in strengths(s.term.effect)):
            out.append(_scaled(s, amount, amount**2 * length))
    return sorted(out, key=lambda s: -s.gain)


def _scaled(found: Screened, amount: float, gain: float) -> Screened:
    """Give a candidate with the strength that fits the residual at hand."""
    ratio = amount / found.length if found.length else 0.0
    values = dict(found.values)
    for p in strengths(found.term.effect):
        off = float(p.neutral or 0.0)
        values[p.name] = float(np.clip(off + ratio * (values[p.name] - off), p.low, p.high))
    return replace(found, values=values, gain=gain)
