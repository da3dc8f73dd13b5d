"""Columns: what every candidate changes in the residual, per limit of materiality.

A candidate has one column for each of its strengths and each of some forms (values of what switches nothing). Columns
are in units of what matters: one is the size that moves slip, energy, load or a channel by its limit.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core
from slipwise.params import Parameter
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.initial_grid import is_lag, shapes, strengths, two_sided
from slipwise.selection.sensitivities import compute_change, compute_stacked_with, small, typical
from slipwise.short_repr import short_repr

FloatArray = NDArray[np.float32]


#: Multiples of the typical strength at which a candidate is tried whose effect is far from a straight line.
FULL_SIZES: tuple[float, ...] = (-4.0, -1.0, 1.0, 4.0)
#: A change of this size at most is round-off: what a candidate changes may still show beside another effect [noise].
_ROUND_OFF = 1e-9


@short_repr
@dataclass(frozen=True)
class CandidateColumn:
    """One strength of a candidate at one form.

    Attributes:
        label: of the candidate's term.
        effect: its name.
        gauge: whether it is a fault of gauges.
        form: number of the form.
        strength: name of the parameter; "" for all strengths of an effect of the model together.
        values: of all parameters, the strength at a small size; of an effect of the model as they were fitted.
        neutral: value of the strength at which the effect is absent.
        two_sided: whether the strength may lie on either side of that.
        unit: strength that is one limit, signed as the column was taken [the parameter's unit]; of an effect of the
            model the share of its fitted size.
        column: (q,) change of the averaged residual by one unit [noise].
        numbers: how many were fitted beside its size, where it is the change of a whole fit.
    """

    label: str
    effect: str
    gauge: bool
    form: int
    strength: str
    values: Mapping[str, float]
    neutral: float
    two_sided: bool
    unit: float
    column: FloatArray
    numbers: int = 0


def make_column(
    term: Term, form: int, moved: Parameter | None, values: Mapping[str, float], unit: float, column: Array | FloatArray
) -> CandidateColumn:
    """Return the column of a term; of all its strengths together where no parameter is given."""
    effect = term.effect
    neutral, either = (0.0, False) if moved is None else (float(moved.neutral or 0.0), two_sided(moved))
    name = "" if moved is None else moved.name
    small = column.astype(np.float32)
    return CandidateColumn(
        term.label, effect.name, effect.port == "gauge", form, name, values, neutral, either, unit, small
    )


@dataclass(frozen=True)
class CandidateForm:
    """A candidate with values of what switches nothing.

    Attributes:
        term: the candidate.
        number: of the form among the candidate's.
        shape: values of its constants.
        size: at which its columns are taken [typical strength]; 0 for a small one, from which a straight line goes on.
    """

    term: Term
    number: int
    shape: Mapping[str, float]
    size: float = 0.0


def list_forms(base: BaseFit, terms: Sequence[Term], *, late: bool = False) -> list[CandidateForm]:
    """Return the forms of candidates that are tried first.

    A gauge that lags by a third of a period changes little or the opposite of what a small lag does: such candidates,
    and those that turn the girder, are tried at full size too.

    Args:
        base: the fit from which the candidates depart.
        terms: candidates.
        late: gauges' lags too; else these are tried so once they explain something.
    """
    out = [CandidateForm(t, number, shape) for t in terms for number, shape in enumerate(shapes(t.effect))]
    for term in terms:
        if is_curved(base, term) or (late and is_lag(term.effect)):
            most = sum(form.term is term for form in out)
            out += [CandidateForm(term, most + k, shapes(term.effect)[0], size) for k, size in enumerate(FULL_SIZES)]
    return out


def is_curved(base: BaseFit, term: Term) -> bool:
    """Return whether a candidate turns the girder: friction holds that until it is large enough.

    Args:
        base: the fit from which the candidate departs.
        term: the candidate.
    """
    return base.objective.adding(term).makes_yaw != base.objective.makes_yaw and len(shapes(term.effect)) == 1


def compute_raw_columns(base: BaseFit, forms: Sequence[CandidateForm], rows: AveragedRows) -> list[CandidateColumn]:
    """Return the columns of candidates as they were taken: `unit` is the step, of which `column` is the change.

    Args:
        base: the fit from which the candidates depart.
        forms: of the candidates.
        rows: how residuals are averaged.
    """
    left = base.solution.residuals.stacked(base.objective.fitted)
    by_term: dict[str, list[CandidateForm]] = {}
    for form in forms:
        by_term.setdefault(form.term.label, []).append(form)
    order = sorted(by_term.values(), key=lambda of: -len(of))  # what takes longest first, or one core waits for it
    answers = on_every_core(lambda k: _columns_of(base, order[k], rows, left), len(order))
    return [
        make_column(of[0].term, number, of[0].term.effect.parameter(name), values, step, column)
        for of, found in zip(order, answers, strict=True)
        for number, name, values, step, column in found
    ]


def _columns_of(
    base: BaseFit, forms: Sequence[CandidateForm], rows: AveragedRows, left: Array
) -> list[tuple[int, str, dict[str, float], float, FloatArray]]:
    """Return form, strength, values, step, and the averaged change by the step, of every column of a candidate."""
    out: list[tuple[int, str, dict[str, float], float, FloatArray]] = []
    term = forms[0].term
    if base.objective.adding(term).makes_yaw != base.objective.makes_yaw:  # yaw made from measured forces is noise too
        bare = compute_stacked_with(base, term, term.effect.neutral())
        if bare is None:
            return []
        left = bare
    for form in forms:
        for moved in strengths(term.effect):
            off = float(moved.neutral or 0.0)
            values = small(term.effect, form.shape, moved)
            if form.size:
                values[moved.name] = off + form.size * (typical(term.effect, moved) - off)
                if not moved.low <= values[moved.name] <= moved.high:
                    continue
                there = compute_stacked_with(base, term, values)
                change = None if there is None else there - left
            else:
                change = compute_change(lambda v: compute_stacked_with(base, term, v), term, moved, values, left)
            step = values[moved.name] - off
            if change is not None and np.abs(change).max() > _ROUND_OFF:
                out.append((form.number, moved.name, values, step, rows.average(change).astype(np.float32)))
    return out
