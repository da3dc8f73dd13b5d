"""What each candidate could explain alone, beside the base numbers, and the least of it that would have been seen.

A candidate's columns at each of its forms are fitted to the residual, what base numbers could do projected out (Frisch,
Waugh 1933; Lovell 1963), limits of sign kept; the drop of the squared residual is its score (Rao 1948).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.evidence.statistics import Statistics, compute_left_by_base
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.columns import CandidateColumn, compute_raw_columns, list_forms
from slipwise.selection.inclusion import SEEN
from slipwise.selection.statistics import compute_statistics
from slipwise.selection.whole_fits import compute_columns_of_fits, fit_whole
from slipwise.short_repr import short_repr

#: A column of which base numbers leave a smaller share does what they do [1].
_NOTHING_LEFT = 1e-9


@short_repr
@dataclass(frozen=True)
class ExplainedAlone:
    """A candidate by itself.

    Attributes:
        term: the candidate.
        values: of its parameters where it explains most.
        gain: drop of the squared residual of the fitted runs [noise variance]; 0 where its strength has the wrong sign.
        absorbed: part of the candidate's own effect that base numbers could mimic [1].
        least: least size of one of its strengths that a relation would show, see `inclusion.SEEN`; NaN for none [unit].
        unit: of that size.
    """

    term: Term
    values: dict[str, float]
    gain: float
    absorbed: float
    least: float
    unit: str


def explain_alone(base: BaseFit, terms: Sequence[Term]) -> list[ExplainedAlone]:
    """Hold candidates against what a fit leaves; best first, those that change nothing left out.

    Args:
        base: a fit with its slopes.
        terms: candidates.
    """
    rows = make_averaged_rows(base.objective)
    columns = [
        *compute_raw_columns(base, list_forms(base, terms, late=True), rows),
        *compute_columns_of_fits(base, fit_whole(base, terms), rows),
    ]
    slopes = rows.average(base.solution.inside)
    left = rows.average(base.solution.residuals.stacked(base.objective.fitted))
    statistics = compute_statistics(rows, left, left, slopes, np.ones(slopes.shape[1], bool), columns)
    return explain_by_statistics(statistics, columns, terms)


def explain_by_statistics(
    statistics: Statistics, columns: Sequence[CandidateColumn], terms: Sequence[Term]
) -> list[ExplainedAlone]:
    """Hold candidates against a residual by products that are known; answer as of `explain_alone`.

    Args:
        statistics: products at a fit without any of the candidates.
        columns: of the candidates.
        terms: candidates.
    """
    if not columns:
        return []
    left = compute_left_by_base(statistics)
    whole = np.tensordot(statistics.samples, left, 1)
    base = statistics.base
    products, pulls = statistics.products.sum(axis=0), statistics.pulls.sum(axis=0)
    own = products[:base, :base] + np.diag(1e-9 * np.diag(products)[:base] + 1e-9)
    pull = pulls[base:] - products[base:, :base] @ np.linalg.solve(own, pulls[:base])
    raw = np.diag(products)[base:]
    members: dict[str, dict[int, list[int]]] = {}
    for i, c in enumerate(columns):
        if whole[i, i] > _NOTHING_LEFT * raw[i]:
            members.setdefault(c.label, {}).setdefault(c.form, []).append(i)
    out: list[ExplainedAlone] = []
    for term in (t for t in terms if t.label in members):
        found = [_fit_form(term, [columns[i] for i in of], of, whole, pull, raw) for of in members[term.label].values()]
        number = max(range(len(found)), key=lambda k: found[k][1])
        least, unit = _least(term, columns, [*members[term.label].values()][number], left)
        out.append(ExplainedAlone(term, *found[number], least, unit))
    return sorted(out, key=lambda s: -s.gain)


def list_least_sizes(found: Sequence[ExplainedAlone]) -> dict[str, tuple[float, str]]:
    """Return effect -> the smallest size that would have been seen, and its unit; on many gauges the smallest counts.

    Args:
        found: candidates.
    """
    out: dict[str, tuple[float, str]] = {}
    for one in found:
        name = one.term.effect.name
        if np.isfinite(one.least) and (name not in out or one.least < out[name][0]):
            out[name] = one.least, one.unit
    return dict(sorted(out.items()))


def _fit_form(
    term: Term, columns: Sequence[CandidateColumn], places: list[int], whole: Array, pull: Array, raw: Array
) -> tuple[dict[str, float], float, float]:
    """Return values, gain and absorbed share of a candidate at one form, its strengths within their limits of sign."""
    kept = list(range(len(places)))
    amounts = np.zeros(len(places))
    while kept:
        at = [places[k] for k in kept]
        found = -np.linalg.lstsq(whole[np.ix_(at, at)], pull[at], rcond=1e-10)[0]
        bad = [k for k, a in zip(kept, found, strict=True) if a < 0.0 and not columns[k].two_sided]
        if not bad:
            amounts[kept] = found
            break
        kept = [k for k in kept if k not in bad]
    gain = float(-pull[places] @ amounts)
    values = dict(columns[0].values)
    if kept:
        for c, amount in zip(columns, amounts, strict=True):
            if c.strength:
                p = term.effect.parameter(c.strength)
                values[c.strength] = float(np.clip(c.neutral + amount * c.unit, p.low, p.high))
    clean, every = float(np.sum(np.diag(whole)[places])), float(np.sum(raw[places]))
    return values, max(gain, 0.0), float(np.clip(1.0 - clean / every, 0.0, 1.0))


def _least(term: Term, columns: Sequence[CandidateColumn], form: Sequence[int], left: Array) -> tuple[float, str]:
    """Return the least strength of which a relation shows `SEEN` floors, the one smallest beside typical; its unit."""
    best, out = np.inf, (float("nan"), "")
    for i in form:
        c, seen = columns[i], float(left[:, i, i].max())
        if not c.strength or seen <= 0.0:
            continue
        p = term.effect.parameter(c.strength)
        size = abs(c.unit) * SEEN / float(np.sqrt(seen))
        usual = abs(p.typical - c.neutral) or 1.0
        if size / usual < best:
            best, out = size / usual, (size, p.unit)
    return out
