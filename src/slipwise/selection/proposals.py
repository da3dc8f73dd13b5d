"""What a campaign proposes: posterior, refit with what is likely, columns anew, until nothing new is likely."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.campaign.materiality import Materiality
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import solve, with_slopes
from slipwise.evidence.posterior import QUICK, Posterior, compute_posterior
from slipwise.evidence.prior import OF_MODEL
from slipwise.evidence.statistics import scale_columns
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import AveragedRows, make_averaged_rows
from slipwise.selection.candidates import at_odds, list_exclusions
from slipwise.selection.closer_forms import list_best_alone, list_closer_forms
from slipwise.selection.columns import CandidateColumn, compute_raw_columns, list_forms
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, refit
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.initial_grid import strengths
from slipwise.selection.linearisation import Linearisation, linearise
from slipwise.selection.units import Moved, compute_moved_by_sizes, compute_units, compute_units_of_fits
from slipwise.selection.whole_fits import compute_columns_of_fits, fit_whole, is_told_by_whole_fit

#: Likelier than this to be of so many limits and floors: it takes part in the next linearisation.
LIKELY, LIKELY_LIMITS, LIKELY_FLOORS = 0.2, 0.6, 0.5
#: Likelier than this to be no trifle: its unit is replayed at its own form and size, and its column is taken anew.
_WORTH_A_REPLAY = 0.05
#: Effects that take part in a linearisation at most, and how often it is done again.
MOST_EFFECTS, _ROUNDS = 9, 3
#: Linearisations of one slider at most, whose effects are added one at a time.
_STEPS = 5
#: Factors by which place or frequency, and width, of a law's best form are moved, one pair after the other [1].
_FINER = ((1.07, 2.0), (1.035, 2.0), (1.018, 1.4))
#: An effect that does this many times more in another run than in the last is replayed there too [1].
_MUCH_MORE = 1.5
#: A whole fit that changes a smaller share of what matters is none: to bring it to one limit would bring up round-off.
_NOTHING = 1e-3
#: A unit that a replay changes by less than this factor stays.
_SAME_UNIT = 1.2


@dataclass(frozen=True)
class ProposedModel:
    """What a campaign proposes.

    Attributes:
        origin: at the base model.
        linearisation: the last one.
        posterior: over what is in its model and beside it.
        units: (label, strength) of a candidate -> what some size of it moves.
        apart: labels of terms that cannot be in one model, in both orders.
    """

    origin: Linearisation
    linearisation: Linearisation
    posterior: Posterior
    units: Mapping[tuple[str, str], Moved]
    apart: frozenset[tuple[str, str]]

    @property
    def hypothesis(self) -> Hypothesis:
        """The last model that was fitted."""
        return self.linearisation.hypothesis


def propose(base: BaseFit, terms: Sequence[Term], limits: Materiality) -> ProposedModel:
    """Propose what is missing.

    Args:
        base: the base fit.
        terms: candidates.
        limits: what matters.
    """
    rows = make_averaged_rows(base.objective)
    origin = make_base_hypothesis(base)
    whole = fit_whole(base, terms)
    raw = [*compute_raw_columns(base, list_forms(base, terms), rows), *compute_columns_of_fits(base, whole, rows)]
    most = find_runs_of_most(raw, rows)
    units = compute_units(base, terms, whole, limits, most)
    here = linearise(base, origin, rows, bring_to_units(raw, units, rows), limits)
    apart = frozenset(list_exclusions(terms))
    here, posterior = _weighed(base, terms, here, limits, most, apart)
    first = here
    for _ in range(_ROUNDS if base.objective.balanced else _STEPS):
        starts = _leave_one_chord(here, posterior, list_likely(here, terms, posterior))
        if set(starts) == {t.label for t in here.hypothesis.terms}:
            break
        found = _refitted(base, [t for t in terms if t.label in starts], starts) if starts else origin
        here = _linearised_again(base, here, found, terms, units, posterior, limits)
        here, posterior = _weighed(base, terms, here, limits, most, apart)
    return ProposedModel(first, here, posterior, units, apart)


def compute_chances_of_large(posterior: Posterior) -> Array:
    """Return for each term (T,) how likely it is large and seen: from `LIKELY` on it is refitted."""
    return np.mean((posterior.sizes > LIKELY_LIMITS) & (posterior.seen > LIKELY_FLOORS), axis=0)


def compute_unexplained(proposal: ProposedModel) -> dict[str, float]:
    """Return relation -> share of what the model leaves that small imperfections of everything do not explain [1]."""
    here = proposal.linearisation
    left = here.statistics.fitted / np.maximum(here.statistics.rows, 1.0)
    shares = np.where(left > 0.0, proposal.posterior.level / np.maximum(left, 1e-12), 1.0)
    return {r: float(min(share, 1.0)) for r, share in zip(here.rows.relations, shares, strict=True)}


def _refitted(base: BaseFit, terms: Sequence[Term], starts: Mapping[str, Mapping[str, float]]) -> Hypothesis:
    found = refit(base, terms, starts)
    objective = found.objective.weigh(found.solution.values)
    solution = solve(objective, found.solution.values, found.solution.free, most=6, enough=5.0, rough=5e-4)
    return replace(found, objective=objective, solution=with_slopes(objective, solution))


def _weighed(
    base: BaseFit,
    terms: Sequence[Term],
    here: Linearisation,
    limits: Materiality,
    most: Mapping[str, int],
    apart: frozenset[tuple[str, str]],
) -> tuple[Linearisation, Posterior]:
    """Compute the posterior, with units of what may matter replayed at the size and form that it says."""
    posterior = compute_posterior(here.statistics, here.columns, here.tolerances, apart, QUICK)
    of = {t.label: t for t in terms}
    for finer in _FINER:
        closer = list_closer_forms(here, of, posterior, finer)
        if not closer:
            break
        raw = compute_raw_columns(make_fit(base, here.hypothesis, with_slopes=False), closer, here.rows)
        here = here.with_columns([*here.beside, *_like_neighbours(raw, here.beside, here.rows)])
        posterior = compute_posterior(here.statistics, here.columns, here.tolerances, apart, QUICK)
    done = set[tuple[str, int]]()
    for _ in range(2):
        asked = {k: v for k, v in _worth_a_replay(here, of, posterior).items() if k not in done}
        if not asked:
            break
        done |= asked.keys()
        pairs = [(of[label], values) for (label, _), (values, _) in asked.items()]
        moved = compute_moved_by_sizes(make_fit(base, here.hypothesis, with_slopes=False), pairs, limits, most)
        factors = np.ones(len(here.columns))
        for ((label, form), (_, size)), share in zip(asked.items(), (m.share for m in moved), strict=True):
            if share > 0.0 and size > 0.0 and not 1.0 / _SAME_UNIT < share / size < _SAME_UNIT:
                at = [i for i, c in enumerate(here.columns) if (c.label, c.form) == (label, form)]
                factors[at] = size / share
        if np.all(factors == 1.0):
            break
        columns = tuple(
            replace(c, unit=c.unit * f, column=c.column * np.float32(f)) if f != 1.0 else c
            for c, f in zip(here.columns, factors, strict=True)
        )
        here = replace(here, columns=columns, statistics=scale_columns(here.statistics, factors))
        posterior = compute_posterior(here.statistics, here.columns, here.tolerances, apart, QUICK)
    posterior = compute_posterior(here.statistics, here.columns, here.tolerances, apart)
    return here, posterior


def find_runs_of_most(raw: Sequence[CandidateColumn], rows: AveragedRows) -> dict[str, int]:
    """Return label -> place of the fitted run in which a candidate does most, where it does much less in the last."""
    runs = np.unique(rows.run)
    out: dict[str, int] = {}
    for c in raw:
        if c.form == 0 and not c.gauge:
            square = np.array([np.mean(c.column[rows.run == run].astype(float) ** 2) for run in runs])
            if square.max() > _MUCH_MORE**2 * square[-1]:
                out[c.label] = int(runs[square.argmax()])
    return out


def _like_neighbours(
    raw: Sequence[CandidateColumn], columns: Sequence[CandidateColumn], rows: AveragedRows
) -> list[CandidateColumn]:
    """Bring columns of further forms to the unit of those that are there: alike in the residual, alike in weight."""
    known: dict[tuple[str, str], float] = {}
    for c in columns:
        known.setdefault((c.label, c.strength), _direct(c.column, rows))
    out: list[CandidateColumn] = []
    for c in raw:
        share = _direct(c.column, rows) / max(known.get((c.label, c.strength), 0.0), 1e-12)
        if 0.0 < share < 1e9:
            out.append(replace(c, unit=c.unit / share, column=c.column / np.float32(share)))
    return out


def _direct(column: NDArray[np.float32], rows: AveragedRows) -> float:
    """Return the largest rms over relations of what a column changes [noise]."""
    square = np.bincount(rows.relation, column.astype(float) ** 2, minlength=len(rows.relations))
    return float(np.sqrt(np.max(square / np.maximum(rows.samples, 1.0))))


def _worth_a_replay(
    here: Linearisation, of: Mapping[str, Term], posterior: Posterior
) -> dict[tuple[str, int], tuple[dict[str, float], float]]:
    """Return (label, form) -> values and size in limits of what is in no model yet and may be more than a trifle.

    So may be the resonance that explains most alone: how much it changes was told in proportion to one at another
    frequency, which can be a hundred times too much; so large it is not believed, and a gain stands for it.
    """
    out: dict[tuple[str, int], tuple[dict[str, float], float]] = {}
    for t, label in enumerate(posterior.labels):
        forms = posterior.forms[:, t]
        for form in np.unique(forms[forms >= 0]):
            at = forms == form
            if np.mean(at) < _WORTH_A_REPLAY or _is_whole(here, label, int(form)):
                continue  # its size was replayed
            values = values_of_form(here.columns, posterior.strengths[at].mean(axis=0), of[label], int(form))
            out[label, int(form)] = values, float(np.mean(posterior.sizes[at, t]))
    for c in (here.columns[i] for term in of.values() for i in list_best_alone(here, term, posterior)):
        out.setdefault((c.label, c.form), (dict(c.values), abs(c.values[c.strength] - c.neutral) / c.unit))
    return out


def _leave_one_chord(
    here: Linearisation, posterior: Posterior, starts: Mapping[str, Mapping[str, float]]
) -> dict[str, Mapping[str, float]]:
    """Return what is likely, of what is told by whole fits the one that shows most: such changes do not add up."""
    seen = dict(zip(posterior.labels, posterior.seen.mean(axis=0), strict=True))
    whole = [label for label in starts if any(c.label == label and c.form and not c.strength for c in here.beside)]
    gone = set(sorted(whole, key=lambda label: seen[label])[:-1])
    return {label: values for label, values in starts.items() if label not in gone}


def _is_whole(here: Linearisation, label: str, form: int) -> bool:
    """Return whether a form's column is that of a whole fit."""
    return any(c.label == label and c.form == form and not c.strength for c in here.beside)


def values_of_form(columns: Sequence[CandidateColumn], sizes: Array, term: Term, form: int) -> dict[str, float]:
    """Return the values of a term's parameters at one form, its strengths at sizes (K,) of all columns [limits]."""
    effect = term.effect
    members = [i for i, c in enumerate(columns) if c.label == term.label and c.form == form]
    first = columns[members[0]]
    values = dict(first.values)
    if form == OF_MODEL:
        share = float(sizes[members[0]]) * first.unit
        for p in strengths(effect):
            end = float(p.neutral or 0.0)
            values[p.name] = float(np.clip(end + share * (values[p.name] - end), p.low, p.high))
        return values
    if not first.strength:
        return values
    values |= {p.name: float(p.neutral or 0.0) for p in strengths(effect)}
    for i in members:
        c = columns[i]
        p = effect.parameter(c.strength)
        values[c.strength] = float(np.clip(c.neutral + sizes[i] * c.unit, p.low, p.high))
    return values


def _linearised_again(
    base: BaseFit, before: Linearisation, found: Hypothesis, terms: Sequence[Term],
    units: Mapping[tuple[str, str], Moved], posterior: Posterior, limits: Materiality,
) -> Linearisation:  # fmt: skip
    """Linearise at another model; columns of what is unlikely hardly change, and stay as they are."""
    rows = make_averaged_rows(found.objective)
    chance = dict(zip(posterior.labels, np.mean(posterior.sizes > 0.0, axis=0), strict=True))
    present = {t.label for t in found.terms}
    beside = [t for t in terms if t.label not in present and not any(at_odds(t, p) for p in found.terms)]
    were = {c.label for c in before.beside}
    fit = make_fit(base, found, with_slopes=False)
    told = {t.label for t in beside if not t.effect.replaces and is_told_by_whole_fit(fit, t)}
    anew = [
        t
        for t in beside
        if t.label in told
        or not t.effect.replaces
        and (chance.get(t.label, 0.0) > _WORTH_A_REPLAY or t.label not in were)
    ]
    stays = {t.label for t in beside} - {t.label for t in anew}
    noise = (before.rows.sigma / rows.sigma).astype(np.float32)
    kept = [replace(c, column=c.column * noise) for c in before.columns if c.label in stays]
    whole = fit_whole(fit, [t for t in beside if t.label in told], once=True)
    raw = [*compute_raw_columns(fit, list_forms(fit, anew), rows), *compute_columns_of_fits(fit, whole, rows)]
    every = {**units, **compute_units_of_fits(fit, whole, limits)}
    return linearise(base, found, rows, [*kept, *bring_to_units(raw, every, rows)], limits)


def bring_to_units(
    raw: Sequence[CandidateColumn], units: Mapping[tuple[str, str], Moved], rows: AveragedRows
) -> list[CandidateColumn]:
    """Bring columns to units of materiality, other forms in proportion to what they change directly."""
    first: dict[tuple[str, str], float] = {}
    out: list[CandidateColumn] = []
    for c in sorted(raw, key=lambda c: c.form):
        key = (c.label, c.strength)
        # a gauge's fault is held against the channel that it changes, by as much as the step
        change = abs(c.unit) if c.gauge else _direct(c.column, rows)
        first.setdefault(key, change)
        share = (units[key].share if key in units else 0.0) * (change / first[key] if first[key] > 0.0 else 1.0)
        if share > (0.0 if c.strength else _NOTHING):
            out.append(replace(c, unit=c.unit / share, column=c.column / np.float32(share)))
    return out


def list_likely(
    here: Linearisation, terms: Sequence[Term], posterior: Posterior, least: float = LIKELY
) -> dict[str, dict[str, float]]:
    """Return label -> values of what is likely large and seen, at its likeliest form.

    Args:
        here: a linearisation.
        terms: candidates.
        posterior: at it.
        least: probability from which on something is likely.
    """
    of = {t.label: t for t in terms}
    chance = compute_chances_of_large(posterior)
    out: dict[str, dict[str, float]] = {}
    for t in np.argsort(-chance)[:MOST_EFFECTS]:
        if chance[t] < least or chance[t] == 0.0:
            break
        forms = posterior.forms[:, t]
        values, counts = np.unique(forms[forms != -1], return_counts=True)
        form = int(values[counts.argmax()])
        label = posterior.labels[t]
        sizes = posterior.strengths[forms == form].mean(axis=0)
        out[label] = values_of_form(here.columns, sizes, of[label], form)
    return out
