"""A fitted model with what every candidate changes in its residual, counted from the absence of each effect."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign.materiality import Materiality
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import Solution
from slipwise.evidence.prior import OF_MODEL
from slipwise.evidence.statistics import Statistics
from slipwise.relations.measurement import is_shifting
from slipwise.relations.parameters import Free, Term
from slipwise.rig import Specimen
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn, make_column
from slipwise.selection.hypothesis import Hypothesis
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.initial_grid import strengths
from slipwise.selection.sensitivities import evaluate_stacked
from slipwise.selection.statistics import compute_statistics
from slipwise.selection.units import compute_sizes_in_place
from slipwise.selection.whole_fits import make_fit_without
from slipwise.short_repr import short_repr

#: Standard deviations of a rated mass, and of the constants of an effect in the model, as shares of the values [1].
_MASS, _CONSTANTS = 0.03, 0.05
#: A constant that is nearly zero keeps at least this share of its scale for its value [1].
_LEAST = 0.02


@short_repr
@dataclass(frozen=True)
class Linearisation:
    """A model with what is likely in it, and what everything changes in it.

    Attributes:
        hypothesis: that was fitted.
        rows: how its residuals are averaged.
        left: (q,) averaged residual that would be left without the effects of the model.
        fitted: (q,) averaged residual of the model.
        slopes: (q, b) averaged slopes of the numbers that are fitted whatever is missing.
        of_base: (b,) which of these belong to the base model.
        numbers: (b,) these numbers.
        tolerances: of these numbers, for `compute_posterior`.
        own: columns of the effects of the model.
        columns: of candidates, in units of materiality, then those of the model's own effects.
        statistics: products of all these.
    """

    hypothesis: Hypothesis
    rows: AveragedRows
    left: Array
    fitted: Array
    slopes: Array
    of_base: Mask
    numbers: tuple[Free, ...]
    tolerances: Mapping[int, tuple[float, float]]
    own: tuple[CandidateColumn, ...]
    columns: tuple[CandidateColumn, ...]
    statistics: Statistics

    @property
    def keys(self) -> tuple[str, ...]:
        """Names of the numbers that are fitted whatever is missing (b,)."""
        return tuple(number.key for number in self.numbers)

    @property
    def beside(self) -> list[CandidateColumn]:
        """Columns of candidates that are not in the model."""
        return [c for c in self.columns if c.form != OF_MODEL]

    def with_columns(self, beside: Sequence[CandidateColumn]) -> "Linearisation":
        """Return the same model with other candidates beside it."""
        every = (*beside, *self.own)
        statistics = compute_statistics(self.rows, self.left, self.fitted, self.slopes, self.of_base, every)
        return replace(self, columns=every, statistics=statistics)


def linearise(
    base: BaseFit, found: Hypothesis, rows: AveragedRows, columns: Sequence[CandidateColumn], limits: Materiality
) -> Linearisation:
    """Hold a model's residual, the slopes of its numbers, and columns of what is beside it, against each other.

    Sizes are counted from absence: what the strengths of the model's own effects explain is brought back.
    """
    here = make_fit(base, found, with_slopes=False)
    objective, solution = found.objective, found.solution
    slopes = rows.average(solution.jacobian)
    stacked = solution.residuals.stacked(objective.fitted)
    left = fitted = rows.average(stacked)
    keys = [f.key for f in solution.free]
    own: list[CandidateColumn] = []
    laws = {t.label: make_fit_without(base, found, t) for t in found.terms if t.effect.replaces}
    sizes = compute_sizes_in_place(here, found.terms, laws, limits) if found.terms else {}
    for term in found.terms:
        if sizes[term.label] > 0.0:
            if term.label in laws:
                whole = rows.average(stacked - laws[term.label].solution.residuals.stacked(objective.fitted))
            else:
                whole = _whole_effect(here, term, rows, slopes, stacked)
            column = whole / sizes[term.label]
            own.append(make_column(term, OF_MODEL, None, found.values_of(term), 1.0 / sizes[term.label], column))
            left = left - whole
    of_rig = {f.key for f in base.free}
    strong = {f"{t.label}.{p.name}" for t in found.terms for p in strengths(t.effect)}
    ends = set(solution.at_bounds)  # what has run against a bound makes up for nothing
    free = [j for j, key in enumerate(keys) if key not in strong | ends]  # of a strength the whole effect tells
    of_base = np.array([keys[j] in of_rig for j in free], bool)
    kept, names = slopes[:, free], tuple(keys[j] for j in free)
    tolerances = list_tolerances(solution, found.objective.specimen, of_rig, names)
    every = (*columns, *own)
    statistics = compute_statistics(rows, left, fitted, kept, of_base, every)
    numbers = tuple(solution.free[j] for j in free)
    return Linearisation(found, rows, left, fitted, kept, of_base, numbers, tolerances, tuple(own), every, statistics)


def _whole_effect(here: BaseFit, term: Term, rows: AveragedRows, slopes: Array, stacked: Array) -> Array:
    """Return what a term of the model changes in the averaged residual (q,), all of it: from its absence to the fit.

    Of a fault that moves noise in time the slopes tell it: between moved and unmoved noise there is less of it.
    """
    absent = {p.name: float(p.neutral or 0.0) for p in strengths(term.effect)}
    values = here.solution.values
    if not is_shifting([term]):
        there = evaluate_stacked(here.objective, {**values, **{f"{term.label}.{n}": x for n, x in absent.items()}})
        if there is not None and np.isfinite(there).all():
            return rows.average(stacked - there)
    free = here.solution.free
    steps = {f"{term.label}.{n}": values[f"{term.label}.{n}"] - x for n, x in absent.items()}
    return sum(
        (slopes[:, j] * (steps[f.key] / f.scale) for j, f in enumerate(free) if f.key in steps), np.zeros(len(slopes))
    )


def list_tolerances(
    solution: Solution, specimen: Specimen, unknown: Collection[str], keys: Sequence[str]
) -> dict[int, tuple[float, float]]:
    """Return what is known of numbers that are fitted whatever is missing; see `compute_posterior`.

    A number that came with an effect stays near what was fitted with it, an inertia of the girder too: the inertia by
    which a pitching table shows, free down to nothing, would stand for its absence.

    Args:
        solution: of the fit.
        specimen: rated values.
        unknown: keys of numbers of which nothing but their bounds is known, the mass aside: those of the base fit.
        keys: of the numbers.
    """
    out: dict[int, tuple[float, float]] = {}
    free = {f.key: f for f in solution.free}
    for place, key in enumerate(keys):
        f = free[key]
        if key == "rig.mass":
            out[place] = ((specimen.mass - solution.values[key]) / f.scale, _MASS * specimen.mass / f.scale)
        elif key not in unknown:
            out[place] = (0.0, _CONSTANTS * float(np.clip(abs(solution.values[key]) / f.scale, _LEAST, 1.0)))
    return out
