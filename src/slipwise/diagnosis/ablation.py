"""What a hypothesis would leave without one of its effects: a straight line from where it stands, or a refit.

The effect is set to its absence, the residual is evaluated there, and one Gauss-Newton step lets every other number
make up for what it can. An effect that is never absent, or in whose place a number of the base comes back, is taken out
by a refit.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.errors import SlipwiseError
from slipwise.evidence.left_out import LinearFit, fit_linearly
from slipwise.evidence.residual_summary import ResidualSummary, summarise_linear_fit
from slipwise.relations.parameters import ZERO, Term, list_replaced_numbers
from slipwise.selection.hypothesis import Hypothesis, weigh_as
from slipwise.selection.initial_grid import strengths
from slipwise.selection.search_state import Search, left_with


def without(state: Search, found: Hypothesis, terms: Sequence[Term]) -> tuple[Search, ResidualSummary]:
    """Return what a hypothesis leaves without some of its effects, after the state of the search that refitted it.

    Args:
        state: of a search.
        found: the hypothesis.
        terms: that are taken out.
    """
    labels = {t.label for t in terms}
    rest = [t for t in found.terms if t.label not in labels]
    slider = not found.objective.specimen.free
    linear = None if any(_needs_refit(t, slider) for t in terms) else _linear(found, terms, labels)
    if linear is None:
        state, left = left_with(state, rest, found)
        return state, weigh_as(left, found.objective).summary
    return state, summarise_linear_fit(found.objective, linear, found.summary.held_out, found.summary.counts)


def _needs_refit(term: Term, slider: bool) -> bool:
    effect = term.effect
    replaced = list_replaced_numbers([effect]) - (set[str]() if slider else {ZERO})  # which only a slider's base has
    return not strengths(effect) or bool(replaced) or effect.reverses


def _linear(found: Hypothesis, terms: Sequence[Term], labels: set[str]) -> LinearFit | None:
    objective, solution = found.objective, found.solution
    absent = {f"{t.label}.{p.name}": float(p.neutral or 0.0) for t in terms for p in strengths(t.effect)}
    try:
        there = objective.residuals({**solution.values, **absent}, fitted_only=True)
    except SlipwiseError:
        return None
    left = there.stacked(objective.fitted)
    if not np.isfinite(left).all():
        return None
    ends = set(solution.at_bounds)
    inside = [f.key for f in solution.free if f.key not in ends]
    stays = np.array([key.rpartition(".")[0] not in labels for key in inside], dtype=bool)
    fit = fit_linearly(objective, solution)
    slopes, low, high = fit.slopes[:, stays], fit.low[stays], fit.high[stays]
    step = np.clip(-np.linalg.lstsq(slopes.T @ slopes, slopes.T @ left, rcond=1e-12)[0], low, high)
    constants = fit.constants - sum(f.key.rpartition(".")[0] in labels for f in solution.free)
    return replace(
        fit, residual=left + slopes @ step, slopes=slopes, low=low - step, high=high - step, constants=constants
    )
