"""Where refits begin: terms and starting values of what a screen has found, and others where those may lead astray."""

from collections.abc import Iterator, Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import STICK_LENGTH, Hypothesis, is_strength_at_bound
from slipwise.diagnosis.initial_grid import shapes, strengths, variants
from slipwise.diagnosis.screening import Screened
from slipwise.diagnosis.search_state import Search, tried_before
from slipwise.evidence.score import compute_score
from slipwise.relations.parameters import Term

#: What a refit needs: terms, and label -> parameters to start from.
Start = tuple[list[Term], dict[str, dict[str, float]]]
#: A longer stick is tried at this many times the longest of the base [1].
_LONGER = 4.0
#: Play is tried at these shares of the stroke [1].
_PLAY = (0.02, 0.08)


def starts_of(chosen: Sequence[Screened], beside: Sequence[Term] = ()) -> list[Start]:
    """Return what a refit needs of candidates: terms and starting values."""
    return [([*beside, s.term], {s.term.label: values}) for s in chosen for values in variants(s.term.effect, s.values)]


def starting_points(state: Search, chosen: Sequence[Screened], tried: Sequence[Hypothesis]) -> Iterator[list[Start]]:
    """Ask for effects beside those found, each time from elsewhere, for as long as the caller finds none of them good.

    They were screened with a base that may be far off: a law may begin in a local minimum that no fit can leave.

    Args:
        state: of a search.
        chosen: candidates.
        tried: what came of the starting points so far.
    """
    yield (
        starts_of(chosen, state.best.terms) + longer_stick(state, state.best) + _other_part_of_train(state, state.best)
    )
    yield _as_alone(state, chosen, state.best.terms)
    yield _from_typical([h for h in tried if is_strength_at_bound(h)])


def longer_stick(state: Search, before: Hypothesis) -> list[Start]:
    """Ask for a law of sticking where the base would stick over more than it may: no screen sees past its bound."""
    most = next((f.high for f in before.solution.free if f.key == STICK_LENGTH), np.inf)
    if before.solution.values.get(STICK_LENGTH, 0.0) < (1.0 - 1e-6) * most:
        return []
    out = []
    for term in (t for t in state.terms if t.effect.reverses):
        lengths = [p.name for p in strengths(term.effect) if p.unit == "m"]
        longer = {**term.effect.typical(), **dict.fromkeys(lengths, _LONGER * most)}
        out.append(([*before.terms, term], {term.label: longer}))
    return out


def _other_part_of_train(state: Search, before: Hypothesis) -> list[Start]:
    """Ask for play beside a machine that gives way, and the other way round: no screen sees play at its absence."""
    if not any("stretch" in t.effect.hooks for t in before.terms):
        return []
    stroke = max(float(np.ptp(run.slip)) for run in state.base.objective.fitted_runs)
    out = []
    for term in state.terms:
        lengths = [p.name for p in strengths(term.effect) if p.unit == "m"]
        if "stretch" in term.effect.hooks and lengths and term.label not in {t.label for t in before.terms}:
            for share in _PLAY:
                wide = {**term.effect.typical(), **dict.fromkeys(lengths, share * stroke)}
                out.append(([*before.terms, term], {term.label: wide}))
    return out


def _as_alone(state: Search, chosen: Sequence[Screened], beside: Sequence[Term]) -> list[Start]:
    """Begin those that were fitted alone where that ended."""
    out = []
    for term in (s.term for s in chosen):
        alone = tried_before(state, [term])
        if alone:
            best = max(alone, key=lambda h: compute_score(state.path[0].summary, h.summary))
            out.append(([*beside, term], {term.label: best.values_of(term)}))
    return out


def _from_typical(at_bound: Sequence[Hypothesis]) -> list[Start]:
    """Ask for the last law of each again, from its typical strength and every shape, where a strength is at a bound."""
    asked = {h.terms[-1].label: h.terms for h in at_bound}
    return [
        ([*terms], {label: {**terms[-1].effect.typical(), **shape}})
        for label, terms in asked.items()
        for shape in shapes(terms[-1].effect)
    ]
