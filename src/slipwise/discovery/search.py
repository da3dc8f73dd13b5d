"""The search for one law: screened, matched with forms, fitted with everything else free; best first.

A law that is missing may have dragged the base parameters far away, where curves are bent: the search for the first law
begins from the fit and from the rated numbers of the base law, and what leaves least leads.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.form import forms
from slipwise.discovery.law_objective import LEVER, FittedLaw, LawObjective, PlacedLaw, fit_law, fit_on
from slipwise.discovery.matching import Match, matched
from slipwise.discovery.screening import screen_states, screened_field, weighed
from slipwise.estimation.least_squares import Solution, with_slopes
from slipwise.model import Model
from slipwise.noise.level import AT_FLOOR
from slipwise.residual_map.ports import gates, girder_ports, girder_states, load_ports, opened, pad_ports, places_of
from slipwise.residual_map.states import pad_instants, pad_states, rig_states

#: Candidates, forms of each, and matches of each start that are fitted, and of these the ones that are fitted finely.
_CANDIDATES, _FORMS, _FITTED, _FINELY = 6, 5, 9, 3
#: Of these candidates and matches, the ones that have a single state: two states bend further than the truth's one
#: where the base parameters are far away.
_SINGLE_CANDIDATES, _SINGLE = 3, 4
#: How far from the girder's centre a force on it may act, in heights of the centre [1].
_LEVER = 3.0
#: The motion of the rig is looked at where no state of the pads explains this much: on one motion many go with it [1].
_OF_THE_RIG = 0.9
#: A candidate explains at least this much of what its relation leaves above noise [1].
_LEAST = 0.1


@dataclass(frozen=True)
class Found:
    """What a search gives.

    Attributes:
        candidates: of all screens, best first.
        fitted: laws, that which leaves least first.
    """

    candidates: tuple[CurveCandidate, ...]
    fitted: tuple[FittedLaw, ...]


def find_law(before: LawObjective, solution: Solution, model: Model, label: str) -> Found:
    """Search for one more law.

    Args:
        before: the fit's objective, with laws that were found before.
        solution: of the fit, with slopes of its own.
        model: the user's model, whose law has rated numbers.
        label: of the law, for the keys of its numbers.
    """
    candidates: list[CurveCandidate] = []
    tried: list[FittedLaw] = []
    for start in _starts(before, solution, model) if not before.laws else [solution]:
        every = pad_instants(before.plain, start.values)
        here = replace(before, every=every)
        screened = _screened(here, start)
        candidates += screened
        for match in _matches(screened):
            tried.append(fit_law(here, start, _placed(label, match, here), match.strength))
            tried.sort(key=lambda f: f.solution.cost)
            tried[_FINELY:] = [_without_slopes(f) for f in tried[_FINELY:]]
    fine = [fit_on(_where_it_acts(_carried_by_its_fit(f))) for f in tried[:_FINELY]]
    return Found(
        tuple(sorted(candidates, key=lambda c: -c.share)),
        tuple(sorted([*fine, *tried[_FINELY:]], key=lambda f: f.solution.cost)),
    )


def _matches(screened: Sequence[CurveCandidate]) -> list[Match]:
    """Return the matches to be fitted: the best of the best candidates, and the best of one state each."""
    chosen = [c for c in screened[:_CANDIDATES] if c.share > _LEAST]
    single = [c for c in screened if len(c.states) == 1 and c.share > _LEAST][:_SINGLE_CANDIDATES]
    every = {id(c): matched(c, forms())[:_FORMS] for c in (*chosen, *single)}
    best = sorted((m for c in chosen for m in every[id(c)]), key=lambda m: -m.gain)[:_FITTED]
    alone = sorted((m for c in single for m in every[id(c)]), key=lambda m: -m.gain)[:_SINGLE]
    return [*best, *(m for m in alone if m not in best)]


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


def _screened(here: LawObjective, start: Solution) -> list[CurveCandidate]:
    """Screen every relation with more than noise; shares are of what all of them leave."""
    states = pad_states(here.every)
    fields = [screened_field(here.plain, start, r) for r in ("pads", "girder", "heave") if r in here.relations]
    fields = [f for f in fields if f.residual @ f.residual >= AT_FLOOR**2 * len(f.residual)]
    whole = max(sum(f.excess for f in fields), 1e-9)
    out: list[CurveCandidate] = []
    for field in fields:
        if field.relation == "pads":
            places = places_of(here.plain)
            tried = gates(places, here.plain.pads) if here.plain.specimen.free else []
            ports = pad_ports(here.every)
            found = screen_states(field, states, ports, tried, places, here.every.states)
            if max((c.share for c in found), default=0.0) < _OF_THE_RIG:
                found += screen_states(field, rig_states(here.every), ports, [], places, here.every.states)
        else:
            on_load = field.relation == "heave"
            ports = load_ports(here.every) if on_load else girder_ports(here.plain, start.values, here.every)
            found = screen_states(field, girder_states(states), ports, [], [], here.every.states)
        out += [replace(c, share=c.share * field.excess / whole) for c in found]
    return sorted(out, key=lambda c: -weighed(c))


def _starts(before: LawObjective, solution: Solution, model: Model) -> list[Solution]:
    """Return the fit, and the fit with the base law's own numbers as rated where they are others."""
    own = {f"{u.label}.{name}": value for u in model.uses for name, value in u.numbers.items()}
    rated = {k: v for k, v in own.items() if k in solution.values}
    if "rig.shear_strength" in solution.values:
        rated["rig.shear_strength"] = model.specimen.shear_strength
    values = {**solution.values, **rated}
    if values == solution.values:
        return [solution]
    residuals = before.residuals(values)
    there = replace(solution, values=values, residuals=residuals, cost=residuals.cost(before.fitted))
    return [solution, with_slopes(before, there)]


def different(fitted: Sequence[FittedLaw]) -> list[FittedLaw]:
    """Return the best of each state, port, gate and form, whichever start it came from."""
    kept: dict[tuple[str, ...], FittedLaw] = {}
    for f in fitted:
        c = f.law.match.candidate
        kept.setdefault((*(s.name for s in c.states), c.port.name, c.gate.name, f.law.match.name), f)
    return list(kept.values())
