"""A fitted law in the words of its result: numbers with intervals, the range of the data, what ties with it."""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.law import Law, LawConstant, TiedForm
from slipwise.discovery.law_objective import STRENGTH, TIME_CONSTANT, FittedLaw
from slipwise.discovery.matching import constants_of, place_of
from slipwise.estimation.intervals import Interval
from slipwise.residual_map.states import UNITS


def summarise_law(
    leader: FittedLaw, tied: Sequence[FittedLaw], fitted: Sequence[int], share: float, known: Mapping[str, Interval]
) -> Law:
    """Tell a law that leads, with those that tie with it.

    Args:
        leader: its fit, the solution being that of all laws together.
        tied: what explains as much.
        fitted: places of the runs that are fitted.
        share: of the error above noise that it explains [1].
        known: key -> interval, of all numbers of the solution.
    """
    match = leader.law.match
    candidate = match.candidate
    alike = [f for f in tied if _same_place(f.law.match.candidate, candidate) and not _more_general(f, leader)]
    others = [f for f in tied if not _same_place(f.law.match.candidate, candidate) and not _contains(f, leader)]
    others = [f for f in others if not _lags_by_nothing(f, leader)]
    names = tuple(s.name for s in candidate.states)
    return Law(
        name=leader.law.label,
        states=names,
        port=candidate.port.name,
        where=candidate.gate.name,
        parity=parity_of(candidate),
        form=match.name,
        tied=tuple(dict.fromkeys(f.law.match.name for f in alike)),
        rivals=tuple(dict.fromkeys(f"{f.law.match.candidate.label}, {f.law.match.name}" for f in others)),
        constants=tuple(_constant(leader, name, known) for name in _ordered(leader)),
        share=share,
        other_states=any({s.name for s in f.law.match.candidate.states} != set(names) for f in others),
        at_buffers=leader.law.lever != 0.0,
        valid={s.name: _ends(s.values, fitted) for s in candidate.states},
        fitted=leader,
        tied_forms=tuple(TiedForm(f.law.match.forms, f.values) for f in alike),
        alternatives=tuple(summarise_law(f, (), fitted, share, {}) for f in (*alike, *others)),
    )


def parity_of(candidate: CurveCandidate) -> str:
    """Return whether a force turns with the velocity: "outward" turns with it, and so turns what it multiplies."""
    turned = sum(s.name == "outward" for s in candidate.states) % 2 == 1
    return {"odd": "even", "even": "odd"}[candidate.port.parity] if turned else candidate.port.parity


def _ordered(leader: FittedLaw) -> list[str]:
    """Return the names of its numbers: strength, constants, time constant."""
    names = [STRENGTH, *constants_of(leader.law.match.forms)]
    return [*names, TIME_CONSTANT] if leader.law.lag else names


def _constant(leader: FittedLaw, name: str, known: Mapping[str, Interval]) -> LawConstant:
    match = leader.law.match
    found = known.get(f"{leader.law.label}.{name}")
    low, high = (found.low, found.high) if found else (float("nan"),) * 2
    if name == STRENGTH:
        unit = match.candidate.port.unit
    elif name == TIME_CONSTANT:
        unit = "s"
    else:
        state = match.candidate.states[place_of(name)].name
        unit = "1" if constants_of(match.forms)[name].kind == "number" else UNITS.get(state, "m")
    return LawConstant(name, leader.values[name], low, high, unit, found.bound if found else "")


def _same_place(one: CurveCandidate, other: CurveCandidate) -> bool:
    return (
        [s.name for s in one.states] == [s.name for s in other.states]
        and one.port.name == other.port.name
        and one.gate.name == other.gate.name
    )


def _more_general(other: FittedLaw, leader: FittedLaw) -> bool:
    """Return whether another form is the leader's with more constants."""
    pairs = zip(other.law.match.forms, leader.law.match.forms, strict=True)
    return all(mine.name == theirs.name or theirs.name in mine.contains for mine, theirs in pairs)


def _contains(other: FittedLaw, leader: FittedLaw) -> bool:
    """Return whether a rival is the leader with something more: a second state, or no gate."""
    mine, theirs = leader.law.match.candidate, other.law.match.candidate
    return mine.port.name == theirs.port.name and {s.name for s in mine.states} < {s.name for s in theirs.states}


def _lags_by_nothing(other: FittedLaw, leader: FittedLaw) -> bool:
    """Return whether a rival has the leader's state behind a lag shorter than a sample: it is the same state."""
    mine, theirs = ([s.name for s in f.law.match.candidate.states] for f in (other, leader))
    if mine == theirs or [n.removeprefix("lagged_") for n in mine] != theirs:
        return False
    return other.values.get(TIME_CONSTANT, other.law.lag) < min(run.dt for run in other.objective.plain.fitted_runs)


def _ends(values: Sequence[np.ndarray], fitted: Sequence[int]) -> tuple[float, float]:
    whole = np.concatenate([values[i].ravel() for i in fitted])
    return float(whole.min()), float(whole.max())
