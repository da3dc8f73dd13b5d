"""Screening: which state, in which port, on which pads, explains most of a residual.

Curves are made on some motions and judged on another, so that a state that only tells runs apart gains nothing.
"""

from collections.abc import Sequence
from itertools import combinations

from slipwise.arrays import Array
from slipwise.discovery.candidate import CurveCandidate
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective
from slipwise.relations.evaluation_times import Instants
from slipwise.residual_map.curve import ResidualCurve
from slipwise.residual_map.field import ResidualField, project_base_out, take_field
from slipwise.residual_map.ports import EVERYWHERE, Gate, Port, opened
from slipwise.residual_map.splines import SplineBasis, choose_knots
from slipwise.residual_map.states import DrivingState

#: Knots over one state, over the slip (a plate may be grooved), and over each of two.
_KNOTS, _KNOTS_OF_SLIP, _KNOTS_OF_TWO = 12, 60, 6
#: Every n-th sample is screened.
_THINNED = 5
#: Dependences that are looked at again with every gate, and states that are tried in pairs.
_GATED, _PAIRED = 8, 7
#: A gate, or a second state, must explain this much more of the residual above noise [1].
_MORE = 0.04
#: Above this share a single state is enough [1].
_ENOUGH = 0.97


def screened_field(objective: Objective, solution: Solution, relation: str) -> ResidualField:
    """Return the residual of a relation as it is screened: thinned, without what base parameters can do."""
    return project_base_out(take_field(objective, solution.residuals, relation, _THINNED), objective, solution)


def fit_straight_pieces(
    field: ResidualField, states: Sequence[Array], carrier: Array, counts: Sequence[int]
) -> ResidualCurve:
    """Fit the curve of straight pieces over states, (m,) each, with at most so many knots over each."""
    knots = tuple(choose_knots(s, count) for s, count in zip(states, counts, strict=True))
    return field.fit(SplineBasis(knots, degree=1), states, carrier)


def screen_states(
    field: ResidualField, states: Sequence[DrivingState], ports: Sequence[Port], gates: Sequence[Gate],
    places: Sequence[tuple[float, float]], instants: Sequence[Instants],
) -> list[CurveCandidate]:  # fmt: skip
    """Screen single states in every port, the best of them with every gate, then pairs; best first.

    Args:
        field: the residual.
        states: over all runs.
        ports: of the field's relation.
        gates: to be tried; none where all pads move as one.
        places: of the pads [m].
        instants: of all runs.
    """
    carriers = {p.name: field.at_samples(p.carrier) for p in ports}
    values = {s.label: field.at_samples(s.values) for s in states}
    singles = [_candidate(field, (s,), p, EVERYWHERE, carriers[p.name], values) for p in ports for s in states]
    singles.sort(key=lambda c: -c.share)
    found = list(singles)
    best = _different(singles, _GATED)
    if gates:
        ways = {g.name: field.at_samples(opened(g, places, instants)) for g in gates}
        found += [
            _candidate(field, c.states, c.port, g, carriers[c.port.name] * ways[g.name], values)
            for c in best
            for g in gates
        ]
    if max((c.share for c in found), default=0.0) < _ENOUGH:
        found += _pairs(field, singles, carriers, values)
    return sorted(found, key=lambda c: -weighed(c))


def weighed(found: CurveCandidate) -> float:
    """Return the share less what a gate and a second state must earn [1]."""
    return found.share - _MORE * (len(found.states) - 1) - _MORE * (found.gate is not EVERYWHERE)


def _pairs(
    field: ResidualField, singles: Sequence[CurveCandidate], carriers: dict[str, Array], values: dict[str, Array]
) -> list[CurveCandidate]:
    out = []
    for port in dict.fromkeys(c.port.name for c in singles[:_GATED]):
        own = [c for c in singles if c.port.name == port]
        kept: dict[str, CurveCandidate] = {}
        for c in own:  # of lags of one state the best only
            kept.setdefault(c.states[0].name, c)
        for one, other in combinations(list(kept.values())[:_PAIRED], 2):
            both = (one.states[0], other.states[0])
            out.append(_candidate(field, both, one.port, EVERYWHERE, carriers[port], values))
    return out


def _different(singles: Sequence[CurveCandidate], count: int) -> list[CurveCandidate]:
    """Return the best of each state and port, whichever lag."""
    kept: dict[tuple[str, str], CurveCandidate] = {}
    for c in singles:
        kept.setdefault((c.states[0].name, c.port.name), c)
    return list(kept.values())[:count]


def _candidate(
    field: ResidualField,
    states: Sequence[DrivingState],
    port: Port,
    gate: Gate,
    carrier: Array,
    values: dict[str, Array],
) -> CurveCandidate:
    if len(states) > 1:
        counts: tuple[int, ...] = (_KNOTS_OF_TWO, _KNOTS_OF_TWO)
    elif states[0].name == "slip":
        counts = (_KNOTS_OF_SLIP,)
    else:
        counts = (_KNOTS,)
    curve = fit_straight_pieces(field, [values[s.label] for s in states], carrier, counts)
    return CurveCandidate(tuple(states), port, gate, curve, curve.carried_over() / max(field.excess, 1e-9))
