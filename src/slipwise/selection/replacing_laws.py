"""Laws that take the place of a simpler one: never absent, so what they change is that of a whole fit with each.

A strength that is zero where an effect is absent gives a column by a small step. A law that replaces another has none:
its column is the change from the fit with the simpler law to the fit with it, and its size is the share of that.
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
from slipwise.selection.columns import CandidateColumn, make_column
from slipwise.selection.hypothesis import Hypothesis, refit


def fit_replacing_laws(base: BaseFit, terms: Sequence[Term]) -> list[Hypothesis]:
    """Fit each law that takes the place of another, in turn; one that cannot be evaluated is left out.

    Args:
        base: the base fit.
        terms: candidates of every kind.
    """
    laws = [t for t in terms if t.effect.replaces]

    def fit(k: int) -> tuple[Solution, ResidualSummary] | None:
        try:
            found = refit(base, [laws[k]], {laws[k].label: laws[k].effect.typical()})
        except SlipwiseError:
            return None
        return found.solution, found.summary  # functions of a term cannot be sent from one process to another

    fits = zip(laws, on_every_core(fit, len(laws), memory=base.solution.fit_memory), strict=True)
    return [Hypothesis((law,), base.objective.adding(law), *found) for law, found in fits if found is not None]


def make_fit_without_law(base: BaseFit, found: Hypothesis, law: Term) -> BaseFit:
    """Return a fitted model with the simpler law again, as the base fit has it, the other terms as they are.

    Args:
        base: the base fit.
        found: a model with the law.
        law: that takes the place of another.
    """
    rest = found.without(law)
    kept = {f"{t.label}.{n}": found.solution.values[f"{t.label}.{n}"] for t in rest for n in t.effect.parameter_names}
    objective, values = base.objective.adding(*rest), base.solution.values | kept
    solution = replace(base.solution, values=values, residuals=objective.residuals(values))
    return replace(base, objective=objective, solution=solution)


def compute_columns_of_laws(base: BaseFit, fits: Sequence[Hypothesis], rows: AveragedRows) -> list[CandidateColumn]:
    """Return the column of each law: from the base fit to the fit with it.

    Args:
        base: the base fit.
        fits: of `fit_replacing_laws`.
        rows: how residuals are averaged.
    """
    left = base.solution.residuals.stacked(base.objective.fitted)
    out: list[CandidateColumn] = []
    for found in fits:
        [law] = found.terms
        change = found.solution.residuals.stacked(base.objective.fitted) - left
        if np.isfinite(change).all() and np.any(change):
            out.append(make_column(law, 0, None, found.values_of(law), 1.0, rows.average(change)))
    return out
