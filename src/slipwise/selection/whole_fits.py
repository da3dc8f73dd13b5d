"""Candidates that no small step describes: their column is what a whole fit with each of them changes.

A strength that is zero where an effect is absent gives a column by a small step from there. A law that replaces a
simpler one is never absent. One slider's law may be so far from the measured one that no small step leads on: the
friction of a rubber layer turns round over millimetres, that of the base law at once; its fits are quick. A frame that
rings at another frequency is soon out of step. Their column is the change from the fit without to the fit with them,
all numbers free in both, and their size is the share of that.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import Solution
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.jobs.parallel import on_every_core
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import FULL_SIZES, CandidateColumn, make_column
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, refit
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.sensitivities import compute_stacked_with, typical


def is_told_by_whole_fit(here: BaseFit, term: Term) -> bool:
    """Return whether a candidate's column is that of a whole fit.

    Args:
        here: a fit without the candidate.
        term: the candidate.
    """
    return bool(term.effect.replaces) or not here.objective.balanced or "storeys" in term.effect.needs


def fit_whole(here: BaseFit, terms: Sequence[Term], *, once: bool = False) -> list[Hypothesis]:
    """Add each candidate that is told by a whole fit to a fit, in turn; one that cannot be evaluated is left out.

    Args:
        here: a fit without the candidates.
        terms: candidates of every kind.
        once: from one start each, where a fit is no longer as far off as that of the base may be.
    """
    near = make_base_hypothesis(here) if once else None
    asked = [t for t in terms if is_told_by_whole_fit(here, t)]

    def fit(k: int) -> tuple[Solution, ResidualSummary] | None:
        try:
            found = refit(here, [asked[k]], {asked[k].label: _choose_start(here, asked[k])}, near)
        except SlipwiseError:
            return None
        return found.solution, found.summary  # functions of a term cannot be sent from one process to another

    fits = zip(asked, on_every_core(fit, len(asked), memory=here.solution.fit_memory), strict=True)
    return [Hypothesis((t,), here.objective.adding(t), *found) for t, found in fits if found is not None]


def _choose_start(here: BaseFit, term: Term) -> dict[str, float]:
    """Return the values of a candidate, typical but for the first strength, at which it explains most as it stands."""
    usual = term.effect.typical()
    starts = [usual]
    for p in strengths(term.effect)[:1]:
        off = float(p.neutral or 0.0)
        sizes = (off + size * (typical(term.effect, p) - off) for size in FULL_SIZES)
        starts += [{**usual, p.name: x} for x in sizes if p.low <= x <= p.high]
    left = [compute_stacked_with(here, term, start) for start in starts]
    return min(zip(starts, left, strict=True), key=lambda s: np.inf if s[1] is None else float(s[1] @ s[1]))[0]


def make_fit_without(base: BaseFit, found: Hypothesis, term: Term) -> BaseFit:
    """Return a fitted model without a term, a simpler law again as the base fit has it, all else as it is.

    Args:
        base: the base fit.
        found: a model with the term.
        term: to leave out.
    """
    rest = found.without(term)
    kept = {f"{t.label}.{n}": found.solution.values[f"{t.label}.{n}"] for t in rest for n in t.effect.parameter_names}
    objective, values = base.objective.adding(*rest), base.solution.values | kept
    solution = replace(base.solution, values=values, residuals=objective.residuals(values))
    return replace(base, objective=objective, solution=solution)


def compute_columns_of_fits(here: BaseFit, fits: Sequence[Hypothesis], rows: AveragedRows) -> list[CandidateColumn]:
    """Return the column of each candidate: from the fit without to the fit with it.

    A fit that ends above the one without it has not found its minimum, and tells nothing.

    Args:
        here: the fit without.
        fits: of `fit_whole`.
        rows: how residuals are averaged.
    """
    left = here.solution.residuals.stacked(here.objective.fitted)
    out: list[CandidateColumn] = []
    for found in fits:
        [term] = found.terms
        change = found.solution.residuals.stacked(here.objective.fitted) - left
        if found.solution.cost < here.solution.cost and np.isfinite(change).all():
            number = 0 if term.effect.replaces else len(shapes(term.effect))
            column = make_column(term, number, None, found.values_of(term), 1.0, rows.average(change))
            own = sum(f.key.rpartition(".")[0] == term.label for f in found.solution.free)
            out.append(replace(column, numbers=max(own - 1, 0)))
    return out
