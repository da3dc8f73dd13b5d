"""The search for what is missing: one effect after another, pairs one step ahead, and back again."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.diagnosis.backward_elimination import prune, settle
from slipwise.diagnosis.bound_check import with_bounds_checked
from slipwise.diagnosis.candidates import candidates
from slipwise.diagnosis.choice import best_of, material_alone, various
from slipwise.diagnosis.hypothesis import Hypothesis, base_hypothesis, strength_at_bound
from slipwise.diagnosis.pairs import leading_pair
from slipwise.diagnosis.rescreening import rescreen
from slipwise.diagnosis.screening import screen, screen_shapes
from slipwise.diagnosis.search_state import Search, as_base, left_with, tried_before, try_all, try_one
from slipwise.diagnosis.starting_grid import places
from slipwise.diagnosis.starting_values import beginnings, longer_stick, starts_of
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, at_rated
from slipwise.evidence.materiality import MATERIAL, MATERIAL_FURTHER, all_down, is_near, material, score

Array = NDArray[np.float64]
#: Share of what is worth a name from which on a screen's gain is worth a refit [1].
_HOPEFUL = 0.4
#: Candidates that are refitted at each step.
_REFITTED = 4
_REFITTED_PAIRS = 2
#: Starts from which a law that leaves something is fitted again.
_RESHAPED = 2
#: Candidates that are tried in the place of an effect, if their columns leave less than so many times what the whole
#: has left [1].
_SWAPPED, _HOPELESS = 2, 100.0
#: The best physics is refitted even where faults of gauges screen better, and far from its best shape.
_REFITTED_PHYSICS = 2
#: Mean squared residual of a base that is bent too far for a screen, and that no effect may leave then before a search
#: from rated numbers [noise variance].
_BENT, _FAR_FROM_NOISE = 1000.0, 30.0
#: Most effects that are added, and how many of them before a logger that nobody knew is estimated anew.
MOST_EFFECTS, _FIRST_EFFECTS = 3, 2


def search(
    base: BaseFit,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
    before: Search | None = None,
) -> Search:
    """Find what the base model lacks.

    Args:
        base: the base fit.
        own: effects beside those of the catalogue.
        progress: called with what is being done and the share done.
        before: from a base fit that was left for this one: where its first effect led, no fit may come from here.
    """
    state = begun(base, own, progress, before)
    finish(state, progress)
    return state


def begun(
    base: BaseFit,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
    before: Search | None = None,
) -> Search:
    """Find the first effects, two at most, and look no further; arguments as `search`."""
    terms, cannot = candidates(base, own)
    state = Search(base, [], cannot, [base_hypothesis(base)], terms=terms)
    tell = progress or _silent
    _screen(state, lambda share: tell("screening", 0.15 + 0.45 * share))
    tell("refitting", 0.6)
    _first(state, next((h for h in before.path if len(h.terms) == 1), None) if before else None)
    _reshape(state)
    _onward(state, tell, _FIRST_EFFECTS)
    return state


def finish(state: Search, progress: Callable[[str, float], None] | None = None) -> None:
    """Go on from the first effects to the hypothesis that is reported.

    Args:
        state: of a search that was begun.
        progress: called with what is being done and the share done.
    """
    tell = progress or _silent
    if len(state.best.terms) == _FIRST_EFFECTS:  # with fewer, nothing more was worth it
        _onward(state, tell, MOST_EFFECTS)
    if _restart_from_nominal(state):
        _onward(state, tell, MOST_EFFECTS)
    prune(state)
    if _swap(state):
        prune(state)
    if state.best.terms:
        tell("settling", 0.95)
        settle(state)
    tell("done", 1.0)


def _silent(what: str, share: float) -> None:
    """Tell nobody."""


def _onward(state: Search, tell: Callable[[str, float], None], most: int) -> None:
    """Add effects to the first while one is worth it."""
    while len(state.path) - 1 and len(state.best.terms) < most:
        tell("refitting", 0.7 + 0.1 * len(state.best.terms))
        if not _further(state):
            break


def _restart_from_nominal(state: Search) -> bool:
    """Begin anew from the rated numbers where very much is left; tell if that leads to something better.

    A base that is bent that far shows each effect as a straight line that leads elsewhere: a table that rocks by 3 mrad
    was fitted with another pitch of the girder, a hundred floors off, and every fit from there ended beside the truth.
    """
    origin, best = state.path[0], state.best
    worst, left = (max(h.summary.level(r, held_out=False) for r in h.summary.fitted) for h in (origin, best))
    if worst < _BENT or left < _FAR_FROM_NOISE:
        return False
    anew = replace(state, base=at_rated(state.base), path=[origin])
    _screen(anew)
    _first(anew)
    _reshape(anew)
    if score(origin.summary, anew.best.summary) <= score(origin.summary, best.summary):
        return False
    state.path.append(anew.best)
    return True


def _screen(state: Search, progress: Callable[[float], None] | None = None) -> None:
    """Screen every candidate against the base of a search."""
    found = screen(state.base, state.terms, progress)
    found = with_bounds_checked(state.base, found, _least_refitted(state.path[0], MATERIAL))
    state.screened, state.opposed = ([s for s in found if (s.gain == 0.0) == against] for against in (False, True))


def _first(state: Search, led: Hypothesis | None = None) -> None:
    origin = state.path[0]
    chosen = various(state.screened, _REFITTED)
    physics = [s for s in state.screened if s.term.effect.component != "instrument"]
    chosen += [s for s in physics[:_REFITTED_PHYSICS] if all(s is not c for c in chosen)]
    least = _least_refitted(origin, MATERIAL)
    asked = starts_of([s for s in chosen if s.gain > least]) + longer_stick(state, origin)
    best = best_of(origin, [*try_all(state, asked), *([try_one(state, led.terms, {}, led)] if led else [])])
    pair = leading_pair(state.base, state.screened, best, least)
    if pair is not None:
        both = try_one(state, [p.term for p in pair], {p.term.label: p.values for p in pair})
        if material_alone(origin, both):
            # a fit hides an effect behind the base less than a screen does: one of the two may do alone
            alone = [try_one(state, [p.term], {}, both) for p in pair if not tried_before(state, [p.term])]
            best = best_of(origin, [*alone, *([best] if best else [])])
            single = best or origin
            both_material = single is origin or material(origin.summary, single.summary, both.summary)
            if both_material and score(origin.summary, both.summary) > score(origin.summary, single.summary):
                state.path.append(both)
                return
    if best is not None:
        state.path.append(best)


def _reshape(state: Search) -> None:
    """Begin a law of a place or a frequency anew from the whole grid of its constants where it leaves something.

    Its fit may be in another valley: a patch that was begun at the wrong place became a wide dip beside the narrow rise
    that was there. Lengths and times a fit finds from where the coarse grid has led it: of 15 such laws none was worth
    more than 5 % more from three new starts, of 10 laws of a place or frequency three more than twice as much.
    """
    best, origin = state.best, state.path[0]
    if not best.terms or all_down(best.summary):
        return
    for term in best.terms:
        grid = places(term.effect)
        if not grid:
            continue
        rest = best.without(term)
        before = left_with(state, rest, best) if rest else origin
        found = screen_shapes(as_base(state, before), term, grid)[:_RESHAPED]
        again = try_all(state, [([*rest, term], {term.label: s.values}) for s in found], before if rest else None)
        better = [h for h in again if score(origin.summary, h.summary) > score(origin.summary, state.best.summary)]
        if better:
            state.path[-1] = better[0]


def _further(state: Search) -> bool:
    """Add the effect that helps most beside those found; false when none is worth it."""
    before, origin = state.best, state.path[0]
    account = before.summary
    if all_down(account):
        return False
    least = _least_refitted(before, MATERIAL_FURTHER)
    found = with_bounds_checked(as_base(state, before), rescreen(state.seen, before), least)
    chosen = various([s for s in found if s.gain > least], _REFITTED_PAIRS + 1)
    tried = list[Hypothesis]()
    for asked in beginnings(state, chosen, tried):
        tried += try_all(state, asked, before, lambda h: is_near(origin.summary, account, h.summary))
        sound = [h for h in tried if strength_at_bound(before) or not strength_at_bound(h)]
        good = [h for h in sound if material(origin.summary, account, h.summary)]
        if good:
            state.path.append(max(good, key=lambda h: score(before.summary, h.summary)))
            return True
    return False


def _least_refitted(before: Hypothesis, drop: float) -> float:
    """Give the gain from which on a candidate is refitted, for a drop of a relation that is worth a name [1]."""
    return _HOPEFUL * drop * min(n for n, _ in before.summary.counts.values())


def _swap(state: Search) -> bool:
    """Exchange an effect, and its likes on other gauges, for one that helps more beside the rest; tell if any was.

    What was best alone may only have stood for two others: two gauges that read less for pads that differ.
    """
    best, origin = state.best, state.path[0].summary
    if len(best.names) < 2 or all_down(best.summary):
        return False
    top = score(origin, best.summary)
    for name in best.names:
        rest = [t for t in best.terms if t.effect.name != name]
        kept = left_with(state, rest, best)
        enough = kept.solution.cost - _HOPELESS * best.solution.cost
        others = [s for s in rescreen(state.seen, kept) if s.term.effect.name not in best.names and s.gain > enough]
        chosen = [s for s in others[:_SWAPPED] if not tried_before(state, [*rest, s.term])]
        better = [h for h in try_all(state, starts_of(chosen, rest), kept) if score(origin, h.summary) > top]
        if better:
            state.path.append(max(better, key=lambda h: score(origin, h.summary)))
            return True
    return False
