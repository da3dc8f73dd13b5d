"""The search for one law: curves weighed in the joint system, matched with forms, fitted with everything else free.

What of the catalogue stands beside a curve is part of its candidate: each form is fitted beside the very effects that
are likely with it, and begins where the joint system has the base numbers.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.curve_search import Curves, list_missing, weigh_curves
from slipwise.discovery.curve_system import CurveSystem, leave_out, make_curve_system
from slipwise.discovery.form import forms
from slipwise.discovery.law_objective import LEVER, FittedLaw, LawObjective, PlacedLaw, fit_law, fit_on
from slipwise.discovery.matching import Match, matched
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import Solution, get_slopes, solve, with_slopes
from slipwise.estimation.objective import Objective
from slipwise.evidence.prior import Prior
from slipwise.relations.parameters import Free, Term
from slipwise.residual_map.ports import girder_ports, load_ports, opened, pad_ports, places_of
from slipwise.residual_map.states import pad_instants
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.candidates import at_odds, list_exclusions
from slipwise.selection.hypothesis import ends_at_limit, prepare_refit
from slipwise.selection.linearisation import Linearisation, list_tolerances

#: Candidates, forms of each, and matches that are fitted, and of these the ones that are fitted finely.
_CANDIDATES, _FORMS, _FITTED, _FINELY = 5, 5, 8, 2
#: Matches of a single state that are fitted at least: two states bend further than the truth's one.
_SINGLE = 3
#: Candidates whose evidence is lower than the best one's by more are not fitted [nats].
_NEAR = 20.0
#: How far from the girder's centre a force on it may act, in heights of the centre [1].
_LEVER = 3.0
#: A candidate explains at least this much of what is left without it [1].
_LEAST = 0.1
#: A single motion is cut into so many stretches, to be left out by turns.
_STRETCHES = 8
#: A fit ends where a step lowers the squared residual by less than this, and than this share of what is left [1].
_ENOUGH, _ROUGH = 10.0, 5e-4
#: How often an effect beside a law may turn out to stand for another one.
_REPLACED = 3
#: Effects beside a law that are exchanged for what is likely without them.
_EXCHANGED = 2


@dataclass(frozen=True)
class Ground:
    """A fit in which a law is looked for, with the joint system there.

    Attributes:
        base: the base fit.
        objective: with the laws that were found before.
        solution: of the fit, with slopes of its own.
        system: base numbers and every candidate of the catalogue.
        terms: label -> candidate of the catalogue.
        starts: labels of effects beside the base -> the fit with them, without a law; filled as it is asked for.
    """

    base: BaseFit
    objective: LawObjective
    solution: Solution
    system: CurveSystem
    terms: Mapping[str, Term]
    starts: dict[frozenset[str], tuple[Objective, Solution]] = field(
        default_factory=dict[frozenset[str], tuple[Objective, Solution]]
    )


@dataclass(frozen=True)
class Found:
    """What a search gives.

    Attributes:
        curves: of the joint system.
        fitted: laws, that which leaves least first.
    """

    curves: Curves
    fitted: tuple[FittedLaw, ...]

    @property
    def candidates(self) -> tuple[CurveCandidate, ...]:
        """Curves, best first."""
        return self.curves.candidates


def make_ground(base: BaseFit, here: Linearisation, terms: Sequence[Term]) -> Ground:
    """Return where a diagnosis ended, as ground for the first law.

    Args:
        base: the base fit.
        here: the linearisation of which the diagnosis' posterior is.
        terms: candidates of the catalogue.
    """
    found = here.hypothesis
    system = make_curve_system(
        here.rows, here.left, here.slopes, here.keys, here.columns, here.tolerances,
        frozenset(list_exclusions(terms)), _blocks(found.objective, here.rows),
    )  # fmt: skip
    objective = LawObjective(pad_instants(found.objective, found.solution.values), found.objective, ())
    return Ground(base, objective, found.solution, system, {t.label: t for t in terms})


def move_ground(ground: Ground, objective: LawObjective, solution: Solution) -> Ground:
    """Return the ground at a fit with laws; columns of candidates hardly change, and stay as they are.

    Args:
        ground: of before.
        objective: of the fit.
        solution: of the fit, with slopes of its own.
    """
    rows, present = ground.system.rows, objective.plain.terms
    labels = {t.label for t in present}
    beside = [
        c
        for c in ground.system.columns
        if c.label not in labels and not any(at_odds(ground.terms[c.label], t) for t in present)
    ]
    ends = set(solution.at_bounds)
    kept = [j for j, f in enumerate(solution.free) if f.key not in ends]
    keys = [solution.free[j].key for j in kept]
    laws = {law.label for law in objective.laws}
    unknown = {f.key for f in ground.base.free} | {key for key in keys if key.rpartition(".")[0] in laws}
    left, slopes = solution.residuals.stacked(objective.fitted), rows.average(solution.jacobian)
    tolerances = list_tolerances(solution, objective.plain.specimen, unknown, keys)
    system = make_curve_system(
        rows, rows.average(left), slopes[:, kept], keys, beside, tolerances, ground.system.apart, ground.system.block
    )
    return Ground(ground.base, objective, solution, system, ground.terms)


def find_law(ground: Ground, label: str) -> Found:
    """Search for one more law.

    Args:
        ground: where it is looked for.
        label: of the law, for the keys of its numbers.
    """
    here, solution = ground.objective, ground.solution
    curves = weigh_curves(ground.system, here.plain, here.every, solution.values, solution.free, ground.terms)
    tried: list[FittedLaw] = []
    for match in _matches(curves.candidates):
        start = _start_with(ground, match.candidate)
        placed = _placed(label, match, start[0])
        tried.append(fit_law(*start, placed, match.strength))
        tried.sort(key=lambda f: f.solution.cost)
        tried[_FINELY:] = [_without_slopes(f) for f in tried[_FINELY:]]
    fine = [fit_on(_where_it_acts(_carried_by_its_fit(f))) for f in tried[:_FINELY]]
    return Found(curves, tuple(sorted([*fine, *tried[_FINELY:]], key=lambda f: f.solution.cost)))


def exchange_beside(ground: Ground) -> Ground:
    """Return the ground with those effects of the catalogue beside its laws with which everything leaves least.

    What stands beside a law was chosen by straight lines from where there was none: those of which the data ask least
    are taken out in turn, and what is likely then is fitted in the place of each.
    """
    for term in _least_asked(ground)[:_EXCHANGED]:
        lean = _without_effect(ground, term)
        other = add_missing(lean) or lean
        if other.solution.cost < ground.solution.cost:
            ground = other
    return ground


def _least_asked(ground: Ground) -> list[Term]:
    """Return the effects beside the base, that first without which a fit along straight lines would lose least."""
    own = {t.label for t in ground.base.objective.terms}
    terms = [t for t in ground.objective.plain.terms if t.label not in own]
    solution = ground.solution
    normal = solution.normal + np.diag(1e-9 * np.diag(solution.normal) + 1e-300)
    covariance = np.linalg.inv(normal)

    def lost(term: Term) -> float:
        absent = {f"{term.label}.{p.name}": p.neutral for p in term.effect.parameters if p.neutral is not None}
        at = [j for j, f in enumerate(solution.free) if f.key in absent]
        numbers = [solution.free[j] for j in at]
        away = np.array([(solution.values[f.key] - absent[f.key]) / f.scale for f in numbers])
        return float(away @ np.linalg.solve(covariance[np.ix_(at, at)], away))

    return sorted(terms, key=lost)


def fit_without_laws(ground: Ground) -> tuple[Objective, Solution]:
    """Return the fit with the effects that stand beside the laws, but without these."""
    plain = ground.objective.plain
    values, free, known = take_out(ground.solution, [law.label for law in ground.objective.laws])
    return plain, solve(plain, values, free, most=8, enough=_ENOUGH, rough=_ROUGH, begin=known)


def take_out(
    solution: Solution, labels: Sequence[str]
) -> tuple[dict[str, float], list[Free], dict[str, NDArray[np.float64]]]:
    """Return values, free numbers and their slopes without those of effects or laws of these labels."""
    out = tuple(f"{label}." for label in labels)
    slopes, free = get_slopes(solution), [f for f in solution.free if not f.key.startswith(out)]
    values = {k: v for k, v in solution.values.items() if not k.startswith(out)}
    return values, free, {f.key: slopes[f.key] for f in free if f.key in slopes}


def _without_effect(ground: Ground, term: Term) -> Ground:
    """Return the ground fitted without an effect, which does not compete there any more."""
    here = ground.objective
    plain = here.plain.having(tuple(t for t in here.plain.terms if t is not term))
    objective = replace(here, plain=plain).without_results()
    values, free, known = take_out(ground.solution, [term.label])
    solution = solve(objective, values, free, most=8, enough=_ENOUGH, rough=_ROUGH, begin=known)
    return move_ground(ground, objective, with_slopes(objective, solution))  # columns of what is in a model are gone


def without_law(ground: Ground, found: FittedLaw) -> tuple[Objective, Solution]:
    """Return the fit with the effects beside a law, but without any law."""
    return _beside(ground, found.law.match.candidate)


def add_missing(ground: Ground) -> Ground | None:
    """Return the ground with effects of the catalogue that are likely beside its laws; None where none is.

    One that ends where it is another effect, or nothing, stands for another one: what is likely without it is tried.
    """
    for _ in range(_REPLACED):
        missing = list_missing(ground.system, ground.terms)
        labels = {t.label for t in ground.objective.plain.terms}
        terms = [ground.terms[label] for label in missing if label not in labels]
        if not terms:
            return None
        more = _fit_with(ground, terms, missing)
        nameless = {t.label for t in terms if ends_at_limit(t, more.solution)}
        if not nameless:
            return more
        ground = replace(ground, system=leave_out(ground.system, nameless))
    return None


def _fit_with(ground: Ground, terms: Sequence[Term], starts: Mapping[str, Mapping[str, float]]) -> Ground:
    """Return the ground with further effects, everything fitted from these values of theirs."""
    values, free = dict(ground.solution.values), list(ground.solution.free)
    for t in terms:
        values |= {f"{t.label}.{n}": x for n, x in starts[t.label].items()}
        free += [f for f in t.free(starts[t.label])]
    plain = ground.objective.plain.adding(*terms)
    objective = replace(ground.objective, plain=plain).without_results()
    solution = solve(objective, values, free, most=8, enough=_ENOUGH, rough=_ROUGH, begin=get_slopes(ground.solution))
    return move_ground(ground, objective, with_slopes(objective, solution))


def _blocks(objective: Objective, rows: AveragedRows) -> NDArray[np.int64]:
    """Return the motion of every averaged row (q,), or its stretch of time where there is one motion only."""
    motion = np.array([objective.measurements.motion_of[place] for place in range(len(objective.runs))])[rows.run]
    _, block = np.unique(motion, return_inverse=True)
    if block.max(initial=0) > 0:
        return block.astype(np.int64)
    counts = [len(series.edges) for series in rows.series]
    return np.concatenate([np.arange(count) * _STRETCHES // count for count in counts])


def _matches(weighed: Sequence[CurveCandidate]) -> list[Match]:
    """Return the matches to be fitted: the likeliest of the likeliest candidates, and the likeliest of one state."""
    likely = [c for c in weighed if c.share > _LEAST and c.evidence > max(weighed[0].evidence - _NEAR, 0.0)]
    kept: dict[tuple[object, ...], CurveCandidate] = {}
    for c in likely:  # of lags of one state the likeliest: the lag is fitted
        kept.setdefault((*(s.name for s in c.states), c.port.name, c.gate.name), c)
    every = [m for c in list(kept.values())[:_CANDIDATES] for m in matched(c, forms())[:_FORMS]]
    every.sort(key=_evidence, reverse=True)
    alone = [place for place, m in enumerate(every) if len(m.forms) == 1]
    return [*every[:_FITTED], *(every[place] for place in alone[:_SINGLE] if place >= _FITTED)]


def _evidence(match: Match) -> float:
    """Return the evidence of a candidate's curve less what its form leaves of it, samples counted few [nats]."""
    curve = match.candidate.curve
    best = curve.gain
    left = max(float(curve.whole.sum()) - best, 1.0)
    return match.candidate.evidence - 0.5 * Prior().independent * float(np.log1p(max(best - match.gain, 0.0) / left))


def _beside(ground: Ground, candidate: CurveCandidate) -> tuple[Objective, Solution]:
    """Return the fit with the effects beside a candidate, but without a law of the present search."""
    here = ground.objective
    if here.laws:
        return here.plain, ground.solution
    key = frozenset(candidate.beside)
    if key not in ground.starts:
        terms = [ground.terms[label] for label in candidate.beside]
        plain = here.plain.having((*ground.base.objective.terms, *terms))
        values, free = prepare_refit(ground.base, plain, terms, candidate.beside)
        values |= {k: v for k, v in candidate.start.items() if k in values}
        known = {k: v for k, v in get_slopes(ground.solution).items() if k in {f.key for f in free}}
        solution = solve(plain, values, free, most=6, enough=_ENOUGH, rough=_ROUGH, begin=known)
        ground.starts[key] = plain, solution
    return ground.starts[key]


def _start_with(ground: Ground, candidate: CurveCandidate) -> tuple[LawObjective, Solution]:
    """Return objective and solution from which a candidate's forms are fitted, base numbers where it has them."""
    if ground.objective.laws:
        return ground.objective, ground.solution
    plain, solution = _beside(ground, candidate)
    values = {**solution.values, **{k: v for k, v in candidate.start.items() if k in solution.values}}
    for label, own in candidate.beside.items():
        values |= {f"{label}.{n}": v for n, v in own.items() if f"{label}.{n}" in values}
    return replace(ground.objective, plain=plain).without_results(), replace(solution, values=values)


def _without_slopes(found: FittedLaw) -> FittedLaw:
    """Return a fit whose slopes nobody will ask for: they are as long as all the runs together."""
    slopes = np.empty((0, len(found.solution.free)))
    return replace(found, solution=replace(found.solution, jacobian=slopes))


def _carried_by_its_fit(found: FittedLaw) -> FittedLaw:
    """Return a fit whose law multiplies what the fit makes of the base law's friction, not what its start made."""
    objective, values = found.objective, found.solution.values
    every = pad_instants(objective.plain, values)
    ports = [*pad_ports(every), *load_ports(every)]
    if "girder" in objective.relations:
        ports += girder_ports(objective.plain, values, every)
    match = found.law.match
    port = next(p for p in ports if p.name == match.candidate.port.name)
    law = replace(found.law, match=replace(match, candidate=replace(match.candidate, port=port)))
    return replace(
        found, law=law, objective=replace(objective, every=every, laws=(*objective.laws[:-1], law)).without_results()
    )


def _where_it_acts(found: FittedLaw) -> FittedLaw:
    """Return a force on the girder its place: at the centre, or at the buffers if those are nearer to its lever."""
    key = f"{found.law.label}.{LEVER}"
    if key not in found.solution.values:
        return found
    specimen = found.objective.plain.specimen
    places = [0.0] + [specimen.centre_height - specimen.buffer_height] * bool(specimen.buffer_stiffness)
    values = dict(found.solution.values)
    lever = values.pop(key)
    law = replace(found.law, lever=min(places, key=lambda p: abs(p - lever)), longest_lever=0.0)
    kept = [f.key != key for f in found.solution.free]
    free = tuple(f for f in found.solution.free if f.key != key)
    objective = replace(found.objective, laws=(*found.objective.laws[:-1], law))
    residuals = objective.residuals(values)
    there = replace(
        found.solution, free=free, values=values, residuals=residuals, cost=residuals.cost(objective.fitted),
        jacobian=found.solution.jacobian[:, kept],
    )  # fmt: skip
    return replace(found, law=law, objective=objective, solution=there)


def _placed(label: str, match: Match, here: LawObjective) -> PlacedLaw:
    runs = here.every.states
    if match.candidate.port.relation != "pads":
        everywhere = tuple(np.ones((len(s.time), 1)) for s in runs)
        height = here.plain.specimen.centre_height
        on_girder = match.candidate.port.relation == "girder" and "pitch" in here.relations
        return PlacedLaw(label, match, everywhere, longest_lever=_LEVER * height if on_girder else 0.0)
    return PlacedLaw(label, match, tuple(opened(match.candidate.gate, places_of(here.plain), runs)))


def different(fitted: Sequence[FittedLaw]) -> list[FittedLaw]:
    """Return the best of each state, port, gate and form, whichever start it came from."""
    kept: dict[tuple[str, ...], FittedLaw] = {}
    for f in fitted:
        c = f.law.match.candidate
        kept.setdefault((*(s.name for s in c.states), c.port.name, c.gate.name, f.law.match.name), f)
    return list(kept.values())
