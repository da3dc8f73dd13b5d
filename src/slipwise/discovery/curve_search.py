"""Every state, port and gate as a curve in the joint system: the evidence of each, and what stands beside it."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.curve_columns import CurveColumns, Dependence, average_over_rows, make_curve_columns
from slipwise.discovery.curve_posterior import (
    Weighed,
    add_curve,
    as_fitted,
    curve_by_blocks,
    list_alike,
    sizes_of,
    variance_of,
    weigh,
)
from slipwise.discovery.curve_system import CurveProducts, CurveSystem, level_of, solve_system, take_curve_products
from slipwise.estimation.objective import Objective
from slipwise.relations.parameters import Free, Term
from slipwise.residual_map.ports import (
    EVERYWHERE,
    Port,
    gates,
    girder_ports,
    girder_states,
    load_ports,
    opened,
    pad_ports,
    places_of,
)
from slipwise.residual_map.states import DrivingState, PadInstants, pad_states, rig_states
from slipwise.selection.proposals import LIKELY_LIMITS, values_of_form

#: Curves that are weighed each with a search of its own for what stands beside it, of those that add most.
_SEARCHED = 16
#: Of these, those that are tried with every gate; ports, and states at each, that are tried with every other state.
_GATED, _PORTS, _LEADING = 6, 2, 2
#: A single state that explains this share is enough: no pairs are tried [1].
_ENOUGH = 0.95
#: Curves whose evidence is lower than the best one's by less are as likely [nats].
_ALIKE = 3.0
#: A second state explains at least this much more of motions left out [1].
_MORE_LEFT_OUT = 0.01
#: The motion of the rig is looked at where no state of the pads explains this much: on one motion many go with it [1].
_OF_THE_RIG = 0.9
#: Chance that something is missing that no catalogue holds, and that it needs a gate, or two states [1].
_CHANCE, _GATE, _PAIR = 0.03, 0.2, 0.1
#: Candidates of which points are kept to be drawn, and how many points.
_DRAWN, _POINTS = 3, 4000


@dataclass(frozen=True)
class _Made:
    of: Dependence
    columns: CurveColumns
    products: CurveProducts
    prior: float


@dataclass(frozen=True)
class Curves:
    """What the joint system says of curves.

    Attributes:
        candidates: best first.
        catalogue: the likeliest of the catalogue without any curve.
    """

    candidates: tuple[CurveCandidate, ...]
    catalogue: Weighed


def weigh_curves(
    system: CurveSystem,
    objective: Objective,
    every: PadInstants,
    values: Mapping[str, float],
    free: Sequence[Free],
    terms: Mapping[str, Term],
) -> Curves:
    """Weigh every curve beside everything else.

    Args:
        system: the joint system of a fit.
        objective: of that fit.
        every: all runs at the instants.
        values: of the fit.
        free: its free numbers.
        terms: label -> candidate of the catalogue, those of the model included.
    """
    plain, bare = weigh(system, None, {}, level_of(system, system.summed[2]), moves=0), weigh_catalogue(system)
    pads, ports = pad_states(every), _ports(objective, values, every)
    made = [_make(system, objective, of, prior) for of, prior in _singles(pads, ports)]
    starts = (plain, bare)
    found = _searched(system, made, starts)
    if _best_share(found) < _OF_THE_RIG:
        on_pads = [p for p in ports if p.relation == "pads"]
        rig = [_make(system, objective, of, prior) for of, prior in _singles(rig_states(every), on_pads)]
        found = _sorted([*found, *_searched(system, rig, starts)])
    more = [*_gated(system, objective, every, found)]
    single = _best_share(found)
    if single < _ENOUGH:
        more += _pairs(system, objective, found, made)
    for one, parent in more:
        other = weigh(system, one.products, parent.active, parent.level, moves=2)
        both = _candidate(system, one, other)
        if len(one.of.states) == 1 or both.share > single + _MORE_LEFT_OUT:
            found.append((one, other, both))
    out = []
    scale = {f.key: f for f in free}
    for number, (one, weighed, c) in enumerate(_sorted(found)):
        points = _points(system, objective, one, weighed) if number < _DRAWN else ()
        start = _start(system, weighed, values, scale)
        alike = list_alike(system, weighed, one.products) if number < _DRAWN else {}
        beside, worth = _beside(system, weighed, terms), c.evidence - bare.evidence
        out.append(replace(c, evidence=worth, beside=beside, alike=alike, start=start, points=points))
    return Curves(tuple(out), bare)


def weigh_catalogue(system: CurveSystem) -> Weighed:
    """Return what of the catalogue is likeliest without any curve."""
    level = level_of(system, system.summed[2])
    tried = [weigh(system, None, start, level) for start in ({}, as_fitted(system))]
    return max(tried, key=lambda w: w.evidence)


def compute_dirt(system: CurveSystem) -> dict[str, float]:
    """Return relation -> share of its squared residual that small imperfections of everything do not explain [1]."""
    level = weigh_catalogue(system).level
    raw = np.maximum(level_of(system, system.summed[2]), level)
    return {r: float(x) for r, x in zip(system.rows.relations, level / raw, strict=True)}


def list_missing(system: CurveSystem, terms: Mapping[str, Term]) -> dict[str, Mapping[str, float]]:
    """Return label -> values of the effects of the catalogue that are likely in a system without any curve."""
    return _beside(system, weigh_catalogue(system), terms)


def _ports(objective: Objective, values: Mapping[str, float], every: PadInstants) -> list[Port]:
    there = [*pad_ports(every), *load_ports(every)]
    if "girder" in objective.relations:
        there += girder_ports(objective, values, every)
    return [p for p in there if p.relation in objective.relations]


def _singles(states: Sequence[DrivingState], ports: Sequence[Port]) -> list[tuple[Dependence, float]]:
    """Return every state at every port, with the logarithm of its prior: lags of one state share theirs."""
    out: list[tuple[Dependence, float]] = []
    for port in ports:
        own = states if port.relation == "pads" else girder_states(states)
        alike = Counter(s.name for s in own)
        out += [(Dependence((s,), port), -float(np.log(alike[s.name]))) for s in own]
    among = len({(of.port.name, of.states[0].name) for of, _ in out})
    return [(of, prior + float(np.log(_CHANCE / max(among, 1)))) for of, prior in out]


def _make(system: CurveSystem, objective: Objective, of: Dependence, prior: float) -> _Made:
    made = make_curve_columns(objective, system.rows, of)
    products = take_curve_products(system, of.port.relation, made.columns, made.splines.shape)
    return _Made(of, replace(made, columns=np.zeros((0, 0))), products, prior)


def _searched(
    system: CurveSystem, made: Sequence[_Made], starts: Sequence[Weighed]
) -> list[tuple[_Made, Weighed, CurveCandidate]]:
    """Weigh the curves that add most, each with what stands beside it; best first."""
    adds = [max(s.evidence + add_curve(system, s, m.products) + m.prior for s in starts) for m in made]
    kept = [made[i] for i in np.argsort(adds)[::-1][:_SEARCHED]]
    out = []
    for one in kept:
        tried = [weigh(system, one.products, s.active, s.level) for s in starts]
        best = max(tried, key=lambda w: w.evidence)
        out.append((one, best, _candidate(system, one, best)))
    return _sorted(out)


def _best_share(found: Sequence[tuple[_Made, Weighed, CurveCandidate]]) -> float:
    """Return the largest share of the likeliest curves: of what hardly adds anything a share says nothing."""
    likely = [c for _, _, c in found if c.evidence > found[0][2].evidence - _ALIKE]
    return max((c.share for c in likely), default=0.0)


def _sorted(found: Sequence[tuple[_Made, Weighed, CurveCandidate]]) -> list[tuple[_Made, Weighed, CurveCandidate]]:
    return sorted(found, key=lambda each: -each[2].evidence)


def _candidate(system: CurveSystem, one: _Made, weighed: Weighed) -> CurveCandidate:
    curve, excess = curve_by_blocks(system, weighed, one.products, one.columns)
    share = max(curve.carried_over() / excess, 0.0)
    return CurveCandidate(one.of.states, one.of.port, one.of.gate, curve, share, weighed.evidence + one.prior)


def _different(found: Sequence[tuple[_Made, Weighed, CurveCandidate]]) -> list[tuple[_Made, Weighed, CurveCandidate]]:
    """Return the best of each state and port, whichever lag."""
    kept: dict[tuple[str, str], tuple[_Made, Weighed, CurveCandidate]] = {}
    for each in found:
        kept.setdefault((each[0].of.states[0].name, each[0].of.port.name), each)
    return list(kept.values())


def _gated(
    system: CurveSystem, objective: Objective, every: PadInstants,
    found: Sequence[tuple[_Made, Weighed, CurveCandidate]],
) -> list[tuple[_Made, Weighed]]:  # fmt: skip
    """Return the best curves with every gate with which they are likelier."""
    if not objective.specimen.free:
        return []
    places, out = places_of(objective), []
    tried = gates(places, objective.pads)
    on_pads = [each for each in _different(found) if each[0].of.port.relation == "pads"][:_GATED]
    for gate in tried:
        ways = opened(gate, places, every.states)
        for one, weighed, _ in on_pads:
            prior = one.prior + float(np.log(_GATE / len(tried)))
            gated = _make(system, objective, replace(one.of, gate=gate, opened=ways), prior)
            out.append((gated, weighed))
    return _most(system, out)


def _pairs(
    system: CurveSystem,
    objective: Objective,
    found: Sequence[tuple[_Made, Weighed, CurveCandidate]],
    singles: Sequence[_Made],
) -> list[tuple[_Made, Weighed]]:
    """Return products of the best states at a port with every other one: of a product one factor may show alone."""
    out: list[tuple[_Made, Weighed]] = []
    best = [each for each in _different(found) if each[0].of.gate is EVERYWHERE]
    for port in list(dict.fromkeys(one.of.port.name for one, _, _ in best))[:_PORTS]:
        own = [m for m in singles if m.of.port.name == port]
        names = {m.of.states[0].name for m in own}
        for one, weighed, _ in [each for each in best if each[0].of.port.name == port][:_LEADING]:
            without = _without_curve(system, weighed)
            likeliest: dict[str, tuple[float, _Made]] = {}
            for other in own:  # of lags of one state the likeliest
                name, adds = other.of.states[0].name, add_curve(system, without, other.products)
                if name != one.of.states[0].name and adds > likeliest.get(name, (-np.inf,))[0]:
                    likeliest[name] = adds, other
            prior = one.prior + float(np.log(_PAIR / max(len(names) - 1, 1)))
            for _, other in likeliest.values():
                states = (one.of.states[0], other.of.states[0])
                out.append((_make(system, objective, Dependence(states, one.of.port), prior), weighed))
    return _most(system, out)


def _without_curve(system: CurveSystem, weighed: Weighed) -> Weighed:
    return replace(weighed, solved=solve_system(system, variance_of(system, weighed.active), weighed.level))


def _most(system: CurveSystem, made: Sequence[tuple[_Made, Weighed]]) -> list[tuple[_Made, Weighed]]:
    """Return those that add most to the evidence of what stands beside their single state."""
    bare = {number: _without_curve(system, w) for number, w in {id(w): w for _, w in made}.items()}
    adds = [add_curve(system, bare[id(w)], one.products) + one.prior for one, w in made]
    return [made[i] for i in np.argsort(adds)[::-1][: _SEARCHED // 2]]


def _beside(system: CurveSystem, weighed: Weighed, terms: Mapping[str, Term]) -> dict[str, Mapping[str, float]]:
    """Return label -> values of the effects that are likely, no trifles, beside a curve."""
    out: dict[str, Mapping[str, float]] = {}
    groups, means = system.groups, weighed.solved.means[system.base :]
    for form, size in sizes_of(system, weighed).items():
        label = groups.labels[groups.owner[form]]
        if size > LIKELY_LIMITS and label in terms:
            out[label] = values_of_form(system.columns, means, terms[label], int(groups.number[form]))
    return out


def _start(
    system: CurveSystem, weighed: Weighed, values: Mapping[str, float], scale: Mapping[str, Free]
) -> dict[str, float]:
    """Return the base numbers as the joint system has them, inside their bounds."""
    out = {}
    for key, step in zip(system.keys, weighed.solved.means, strict=False):
        if key in scale:
            f = scale[key]
            inside = 1e-3 * f.scale
            out[key] = float(np.clip(values[key] + step * f.scale, f.low + inside, f.high - inside))
    return out


def _points(system: CurveSystem, objective: Objective, one: _Made, weighed: Weighed) -> tuple[Array, ...]:
    """Return states and heights that the curve has to go through, of averaged rows that tell of it."""
    relation = one.of.port.relation
    columns = make_curve_columns(objective, system.rows, one.of).columns
    at = system.rows.relation == system.rows.relations.index(relation)
    left = system.left[at] + system.every[at] @ weighed.solved.means
    told = columns.sum(axis=1)
    kept = np.flatnonzero(np.abs(told) > 0.3 * np.median(np.abs(told)))
    kept = kept[:: max(1, len(kept) // _POINTS)]
    states = [average_over_rows(objective, system.rows, relation, s.values)[kept] for s in one.of.states]
    return (*states, -left[kept] / told[kept])
