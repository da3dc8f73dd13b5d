"""Refits: a candidate with its own parameters and all base parameters free, and what it is worth."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.effects import Limit
from slipwise.estimation.base_fit import BaseFit, refit_finally
from slipwise.estimation.least_squares import Solution, get_slopes, solve
from slipwise.estimation.objective import Objective
from slipwise.evidence.residual_summary import ResidualSummary, summarise_residuals
from slipwise.relations.parameters import ZERO, Free, Term, list_replaced_numbers, make_free_inertia
from slipwise.selection.initial_grid import REFERENCES
from slipwise.short_repr import short_repr

#: A fit is over when a step lowers the squared residual by less than this, and by less than this share of what is left
#: above the noise [1].
_ENOUGH, _ROUGH = 10.0, 5e-4
#: A polish that lowers the squared residual by more than this share is followed by another, so often at most.
_FALLS, _POLISHES = 0.05, 3
#: Slip over which a pad's friction reverses belongs to the stick of the base model only.
STICK_LENGTH = "rig.stick_length"


@short_repr
@dataclass(frozen=True)
class Hypothesis:
    """Effects that were added to the base model, refitted.

    Attributes:
        terms: the effects.
        objective: base and effects.
        solution: of the fit.
        summary: of its residuals.
    """

    terms: tuple[Term, ...]
    objective: Objective
    solution: Solution
    summary: ResidualSummary

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, each once."""
        return tuple(dict.fromkeys(t.effect.name for t in self.terms))

    def without(self, term: Term) -> list[Term]:
        """Return the terms but for one."""
        return [t for t in self.terms if t.label != term.label]

    def values_of(self, term: Term) -> dict[str, float]:
        """Return the fitted parameters of one effect."""
        return {n: self.solution.values[f"{term.label}.{n}"] for n in term.effect.parameter_names}

    def level_of(self, relation: str, runs: Sequence[int]) -> float:
        """Return the mean squared residual of a relation over some runs [noise variance]."""
        return self.solution.residuals.mean_square(relation, runs)


def make_base_hypothesis(base: BaseFit) -> Hypothesis:
    """Return the base model as a hypothesis without effects."""
    return _hypothesis((), base.objective, base.solution)


def refit(
    base: BaseFit,
    terms: Sequence[Term],
    starts: Mapping[str, Mapping[str, float]],
    before: Hypothesis | None = None,
    *,
    most: int = 7,
) -> Hypothesis:
    """Fit a hypothesis, all base parameters free; `polish` takes what is worth it to the end.

    Args:
        base: the base fit.
        terms: effects to add.
        starts: label -> parameters to start from.
        before: a hypothesis whose numbers are a better start than the base's.
        most: Jacobians at most.
    """
    objective = base.objective.adding(*terms)
    values, free = prepare_refit(base, objective, terms, starts, before)
    labels = {t.label for t in before.terms} if before is not None else set[str]()
    if not objective.balanced and before is None:
        solution = _several_starts(objective, values, free, terms)
    else:
        known = None  # a slider's laws change it too much for slopes of before, and are quick
        if objective.balanced:  # a hypothesis of other runs gives a start, but no slopes
            alike = before is not None and len(before.solution.jacobian) == len(base.solution.jacobian)
            known = get_slopes(before.solution if before is not None and alike else base.solution)
        solution = solve(objective, values, free, most=most, enough=_ENOUGH, rough=_ROUGH, known=known)
        contained = before if before is not None and labels <= {t.label for t in terms} else base
        if solution.cost > contained.solution.cost:  # the base has moved too far for its slopes of before
            solution = solve(objective, solution.values, free, most=most, enough=_ENOUGH, rough=_ROUGH)
    return _hypothesis(terms, objective, solution)


def prepare_refit(
    base: BaseFit,
    objective: Objective,
    terms: Sequence[Term],
    starts: Mapping[str, Mapping[str, float]],
    before: Hypothesis | None = None,
) -> tuple[dict[str, float], list[Free]]:
    """Return where a refit begins, key -> value of everything, and what is free in it.

    Args:
        base: the base fit.
        objective: base and terms.
        terms: effects to add.
        starts: label -> parameters to start from.
        before: a hypothesis whose numbers are a better start than the base's.
    """
    values = dict(base.solution.values)
    if before is not None:  # numbers of effects that are no longer there would act, or be begun from
        kept = values.keys() | set(objective.inertias)
        values |= {k: v for k, v in before.solution.values.items() if k in kept}
    labels = {t.label for t in before.terms} if before is not None else set[str]()
    gone = list_replaced_numbers(t.effect for t in terms) | ({STICK_LENGTH} if objective.has_stick else set())
    free: list[Free] = [f for f in base.free if f.key not in gone]
    if ZERO in gone:
        values.pop(ZERO, None)
    for term in terms:
        if before is not None and term.label in labels:
            start = before.values_of(term)
        else:
            start = _inside(term, starts[term.label])
        values.update({f"{term.label}.{k}": v for k, v in start.items()})
        free += [f for f in term.free(start) if f.key.rsplit(".", 1)[1] not in REFERENCES]
    present = {f.key for f in free}
    for key in objective.inertias:
        if key not in present:
            free.append(make_free_inertia(objective.specimen, key))
            values.setdefault(key, free[-1].start)
    return values, free


def _hypothesis(terms: Sequence[Term], objective: Objective, solution: Solution) -> Hypothesis:
    return Hypothesis(tuple(terms), objective, solution, summarise_residuals(objective, solution))


def polish(found: Hypothesis) -> Hypothesis:
    """Fit on with slopes of its own: those of the base, taken without the effects, lead only near the end.

    What still falls fast is not there yet: a delay of five milliseconds is far from where its column saw it.
    """
    before, solution = found.solution.cost, found.solution
    for _ in range(_POLISHES):
        solution = solve(found.objective, solution.values, solution.free, most=6, enough=_ENOUGH, rough=_ROUGH)
        if before - solution.cost < _FALLS * solution.cost:
            break
        before = solution.cost
    return _hypothesis(found.terms, found.objective, solution)


def weigh_as(found: Hypothesis, other: Objective) -> Hypothesis:
    """Return a hypothesis with the noise of another objective, fitted on with that: only so their residuals compare."""
    if found.objective.weighing is other.weighing:
        return found
    objective = other.having(found.objective.terms)
    solution = solve(objective, found.solution.values, found.solution.free, most=4, enough=_ENOUGH, rough=_ROUGH)
    return _hypothesis(found.terms, objective, solution)


def refit_for_report(found: Hypothesis) -> Hypothesis:
    """Fit on, weighed by its own law and finer, as what is reported of it should be."""
    objective, solution = refit_finally(found.objective, found.solution)
    return found if solution is found.solution else _hypothesis(found.terms, objective, solution)


def _several_starts(
    objective: Objective, values: Mapping[str, float], free: Sequence[Free], terms: Sequence[Term]
) -> Solution:
    """Fit one slider from several starts: its material may be far from any rated value.

    Friction that does not depend on speed, as high as the record's usual force, is tried beside the base fit; a length
    of slip also at several shares of the stroke. Beside a force that is no friction, a curved face or a wall, the rated
    material is tried too: in the base fit friction stood for it, and may have ended far from its own.
    """
    bounds = {f.key: f for f in free}
    force = np.concatenate([run.force.ravel() for run in objective.fitted_runs])
    load = np.concatenate([run.load.ravel() for run in objective.fitted_runs])
    usual = float(np.quantile(np.abs(force), 0.8) / max(float(np.mean(load)), 1e-12))
    strength = usual * objective.specimen.plastic_pressure
    flat = {"rig.shear_strength": strength}
    for term in (t for t in objective.terms if "flat" in t.effect.hooks):
        flat |= {f"{term.label}.{n}": v for n, v in term.effect.hooks["flat"](coefficient=usual).items()}
    stroke = max(float(np.ptp(run.slip)) for run in objective.fitted_runs)
    lengths = [f"{t.label}.length" for t in terms if "stick" in t.effect.hooks]
    starts = [dict(values), {**values, **{k: v for k, v in flat.items() if k in values}}]
    for key in lengths:
        starts += [{**starts[1], key: share * stroke} for share in (0.03, 0.1, 0.3)]
    if any(t.effect.port == "pad" for t in terms):
        starts.append({**values, **{f.key: f.start for f in free}})
    for start in starts:
        start.update({k: float(np.clip(v, bounds[k].low, bounds[k].high)) for k, v in start.items() if k in bounds})
    tries = [solve(objective, s, free, most=6, enough=100.0) for s in starts]
    best = min(tries, key=lambda s: s.cost)
    return solve(objective, best.values, free, most=12, enough=_ENOUGH)


def _inside(term: Term, start: Mapping[str, float]) -> dict[str, float]:
    """Move a start off neutral values and bounds, where slopes vanish or point outside."""
    out = {}
    for p in term.effect.parameters:
        value = start[p.name]
        width = abs(p.typical - (p.neutral or 0.0)) or 0.1 * (p.high - p.low)
        if p.neutral is not None and p.neutral in (p.low, p.high):
            inward = 1.0 if p.neutral == p.low else -1.0
            if abs(value - p.neutral) < 0.02 * width and p.typical != p.neutral:
                value = p.neutral + inward * 0.02 * width
        out[p.name] = float(np.clip(value, p.low, p.high))
    return out


def list_parameters_at_bound(found: Hypothesis) -> list[tuple[str, str]]:
    """Return label and name of every constant of its laws that has run against a bound other than its absence."""
    return [(t.label, name) for t in found.terms for name in sorted(_ends(t, found.solution))]


def is_at_limit(found: Hypothesis) -> list[str]:
    """Return the labels of effects that ended where their files say that they are another effect, or nothing."""
    return [t.label for t in found.terms if ends_at_limit(t, found.solution)]


def ends_at_limit(term: Term, solution: Solution) -> bool:
    """Return whether a fit has led an effect to where its file says that it is another effect, or nothing."""
    return any(_reached(term, solution, limit) for limit in term.effect.limits)


def _reached(term: Term, solution: Solution, limit: Limit) -> bool:
    bounds, value = term.effect.parameter(limit.parameter), solution.values[f"{term.label}.{limit.parameter}"]
    end = "low" if value - bounds.low < bounds.high - value else "high"
    return end == limit.end and limit.parameter in _ends(term, solution)


def _ends(term: Term, solution: Solution) -> set[str]:
    """Return the parameters of a term that ended on a bound other than their absence; whole numbers are not fitted."""
    ends, begins = set(solution.at_bounds), f"{term.label}."
    fitted = [p for p in term.effect.parameters if not p.whole]
    return {p.name for p in fitted if begins + p.name in ends and solution.values[begins + p.name] != p.neutral}
