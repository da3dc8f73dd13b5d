"""Forward selection of what is missing: one effect after another, pairs one step ahead, and back again."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from slipwise.diagnosis.backward_elimination import pruned, with_final_refit
from slipwise.diagnosis.bound_check import with_bounds_checked
from slipwise.diagnosis.candidates import list_candidates
from slipwise.diagnosis.hypothesis import Hypothesis, is_at_limit, is_strength_at_bound, make_base_hypothesis
from slipwise.diagnosis.initial_grid import places
from slipwise.diagnosis.initial_guesses import longer_stick, starting_points, starts_of
from slipwise.diagnosis.jacobian_memory import complete_jacobian, lightened
from slipwise.diagnosis.pairs import leading_pair
from slipwise.diagnosis.plainer import plainest, with_plainer
from slipwise.diagnosis.ranking import best_of, kept_alone, limit_per_effect
from slipwise.diagnosis.rescreening import rescreen, worth_refitting
from slipwise.diagnosis.row_subset import thinning
from slipwise.diagnosis.screening import screen, screen_shapes
from slipwise.diagnosis.search_state import Search, as_base, left_with, tried_before, try_all, try_one
from slipwise.diagnosis.substitutes import substitutes
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, evaluate_at_rated
from slipwise.evidence.acceptance import LEAST, are_all_at_floor, compute_least_drop, is_kept
from slipwise.evidence.score import compute_lead, compute_score

#: Share of what is worth a name from which on a screen's gain is worth a refit [1].
_MIN_REFIT_SHARE = 0.4
#: Candidates that are refitted at each step.
_REFITTED = 4
_REFITTED_PAIRS = 2
#: Small effects that are added at once: many of them make a laboratory, and each refit takes a second.
_AT_ONCE = 3
#: Starts from which a law that leaves something is fitted again.
_RESHAPED = 2
#: Candidates that are tried in the place of an effect, and in the place of all.
_SWAPPED, _EXCHANGED = 2, 6
#: The best physics is refitted even where faults of gauges screen better, and far from its best shape.
_REFITTED_PHYSICS = 2
#: Mean squared residual of a base that is too far from the data for a screen, and residual above which the best
#: hypothesis must then be for a search to begin anew from rated numbers [noise variance].
_BASE_MISFIT, _FAR_FROM_NOISE = 1000.0, 30.0
#: Share of what is worth being kept that a step has reached where it is worth a fit to the end [1].
_NEAR = 0.5
#: Standard errors by which a gauge must explain more than what the rig may have before it is blamed in its place [1].
_SURE_ENOUGH = 2.0
#: Effects after which a search ends, whatever is left: more are no finding any more, and each takes a second.
MOST_EFFECTS = 16


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
    terms, cannot = list_candidates(base, own)
    tell = progress or _silent
    state = Search(base, cannot, terms, (), (make_base_hypothesis(base),))
    state = _screened(state, lambda share: tell("screening", 0.15 + 0.45 * share))
    tell("refitting", 0.6)
    state = _first(state, next((h for h in before.path if len(h.terms) == 1), None) if before else None)
    state = _onward(_reshaped(state), tell)
    anew = _restarted_from_nominal(state)
    state = _onward(anew, tell) if _has_moved(state, anew) else anew
    state = pruned(state)
    exchanged = _exchanged(state) if state.best.terms else state
    state = pruned(exchanged) if _has_moved(state, exchanged) else exchanged
    if state.best.terms:
        tell("weighing", 0.95)
        state = with_final_refit(state)
    if thinning(base.objective) > 1:  # what was tried is listed from now on, and hardly ever fitted on
        origin = state.path[0].summary
        state = replace(state, tried=lightened(state.tried, lambda h: compute_score(origin, h.summary), room=0))
    tell("done", 1.0)
    return state


def _silent(what: str, share: float) -> None:
    """Ignore progress."""


def _onward(state: Search, tell: Callable[[str, float], None]) -> Search:
    """Add effects to the first while one is material."""
    while len(state.path) - 1 and len(state.best.terms) < MOST_EFFECTS:
        tell("refitting", 0.7 + 0.2 * len(state.best.terms) / MOST_EFFECTS)
        before, state = state, _further(state)
        if not _has_moved(before, state):
            break
    return state


def _has_moved(before: Search, after: Search) -> bool:
    """Return whether a search has stepped to another hypothesis, and not only tried some."""
    return after.path is not before.path


def _restarted_from_nominal(state: Search) -> Search:
    """Begin anew from the rated numbers where very much is left; no step unless that leads to something better.

    With a base so far from the data a straight line through an effect's column leads elsewhere.
    """
    origin, best = state.path[0], state.best
    worst, left = (max(h.summary.fitted_level(r) for r in h.summary.fitted) for h in (origin, best))
    if worst < _BASE_MISFIT or left < _FAR_FROM_NOISE:
        return state
    anew = _reshaped(_first(_screened(replace(state, base=evaluate_at_rated(state.base), path=(origin,)))))
    if compute_score(origin.summary, anew.best.summary) <= compute_score(origin.summary, best.summary):
        return replace(state, tried=anew.tried)
    return replace(state, tried=anew.tried).stepped_to(anew.best)


def _screened(state: Search, progress: Callable[[float], None] | None = None) -> Search:
    """Screen every candidate against the base of a search."""
    found = screen(state.base, state.terms, progress)
    found = with_bounds_checked(state.base, found, _least_refitted(state.path[0]))
    screened, wrong_sign = ([s for s in found if (s.gain == 0.0) == wrong] for wrong in (False, True))
    return replace(state, screened=screened, wrong_sign=wrong_sign)


def _first(state: Search, start_hypothesis: Hypothesis | None = None) -> Search:
    """Choose the first effect, or the first two where a pair explains what none of them does alone.

    Args:
        state: with candidates that were screened.
        start_hypothesis: a first effect that another base fit led to.
    """
    origin = state.path[0]
    chosen = limit_per_effect(state.screened, _REFITTED)
    physics = [s for s in state.screened if s.term.effect.component != "instrument"]
    chosen += [s for s in physics[:_REFITTED_PHYSICS] if all(s is not c for c in chosen)]
    least = _least_refitted(origin)
    asked = starts_of([s for s in chosen if s.gain > least]) + longer_stick(state, origin)
    state, tried = try_all(state, with_plainer(state, asked))
    if start_hypothesis is not None:
        state, again = try_one(state, start_hypothesis.terms, {}, start_hypothesis)
        tried.append(again)
    best = best_of(origin, tried)
    if best is not None:
        state, best = plainest(state, best)
    pair = leading_pair(state.base, state.screened, best, least)
    if pair is not None:
        state, both = try_one(state, [p.term for p in pair], {p.term.label: p.values for p in pair})
        if kept_alone(origin, both):
            # a fit hides an effect behind the base less than a screen does: one of the two may do alone
            alone = list[Hypothesis]()
            for p in (p for p in pair if not tried_before(state, [p.term])):
                state, one = try_one(state, [p.term], {}, both)
                alone.append(one)
            best = best_of(origin, [*alone, *([best] if best else [])])
            single = best or origin
            least = compute_least_drop(both.terms)
            if single is origin or is_kept(origin.summary, single.summary, both.summary, least):
                return state.stepped_to(both)
    return state if best is None else state.stepped_to(best)


def _reshaped(state: Search) -> Search:
    """Begin a law of a place or a frequency anew from the whole grid of its constants where it leaves something.

    Its fit may be in another local minimum: of 10 laws of a place or frequency three were worth more than twice as much
    from new starts, of 15 laws of a length or time none more than 5 % more.
    """
    best, origin = state.best, state.path[0]
    if not best.terms or are_all_at_floor(best.summary):
        return state
    for term in best.terms:
        grid = places(term.effect)
        if not grid:
            continue
        rest = best.without(term)
        before = None
        if rest:
            state, before = left_with(state, rest, best)
            before = complete_jacobian(before)
        found = screen_shapes(as_base(state, before or origin), term, grid)[:_RESHAPED]
        state, again = try_all(state, [([*rest, term], {term.label: s.values}) for s in found], before)
        better = [
            h
            for h in again
            if compute_score(origin.summary, h.summary) > compute_score(origin.summary, state.best.summary)
        ]
        if better:
            state = replace(state, path=(*state.path[:-1], better[0]))
    return state


def _further(state: Search) -> Search:
    """Add what helps most beside the effects found, several small ones at once; no step where nothing is worth it."""
    before, origin = state.best, state.path[0]
    if are_all_at_floor(before.summary):
        return state
    found = rescreen(state.all_screened, before)
    several = worth_refitting(found, before, _AT_ONCE, together=True)
    several = [s for s in with_bounds_checked(as_base(state, before), several, 0.0) if s.gain > 0.0]
    if len(several) > 1:
        starts = {s.term.label: s.values for s in several}
        state, together = try_one(state, [*before.terms, *(s.term for s in several)], starts, before)
        if _is_kept(origin, before, together) and not _new_at_bound(together, before):
            further = pruned(state.stepped_to(together))
            if not _been_there(state, further.best):  # what goes again at once would come back for ever
                return further
            state = replace(state, tried=further.tried)
    chosen = limit_per_effect(worth_refitting(found, before, 2 * _REFITTED_PAIRS, together=False), _REFITTED_PAIRS + 1)
    chosen = [s for s in with_bounds_checked(as_base(state, before), chosen, 0.0) if s.gain > 0.0]
    tried = list[Hypothesis]()
    for asked in starting_points(state, chosen, tried):
        asked = with_plainer(state, asked)
        state, found = try_all(state, asked, before, lambda h: _is_kept(origin, before, h, _NEAR))
        tried += found
        sound = [
            h for h in tried if not is_at_limit(h) and (is_strength_at_bound(before) or not is_strength_at_bound(h))
        ]
        good = [h for h in sound if _is_kept(origin, before, h)]
        if good:
            state, plain = plainest(state, max(good, key=lambda h: compute_score(before.summary, h.summary)))
            return state.stepped_to(plain)
    return state


def _been_there(state: Search, found: Hypothesis) -> bool:
    """Return whether a search has stood at these effects before."""
    return any({t.label for t in h.terms} == {t.label for t in found.terms} for h in state.path)


def _new_at_bound(found: Hypothesis, before: Hypothesis) -> bool:
    return is_strength_at_bound(found) and not is_strength_at_bound(before)


def _is_kept(origin: Hypothesis, before: Hypothesis, found: Hypothesis, share: float = 1.0) -> bool:
    """Return whether the terms that a hypothesis has beside one before are worth being kept, or nearly so."""
    labels = {t.label for t in before.terms}
    least = share * compute_least_drop(t for t in found.terms if t.label not in labels)
    return is_kept(origin.summary, before.summary, found.summary, least)


def _least_refitted(before: Hypothesis) -> float:
    """Return the gain from which on a candidate is refitted [noise variance]."""
    return _MIN_REFIT_SHARE * LEAST.law * min(n for n, _ in before.summary.counts.values())


def _exchanged(state: Search) -> Search:
    """Fit what could stand in the place of an effect, and its likes on other gauges; no step if nothing is better.

    What was best alone may only have stood for two others: two gauges that read less for pads that differ.
    """
    best, origin = state.best, state.path[0].summary
    top = compute_score(origin, best.summary)
    better: list[Hypothesis] = []
    left = _EXCHANGED
    for name in best.names:
        rest = [t for t in best.terms if t.effect.name != name]
        chosen = substitutes(best, name, state.all_screened)[:_SWAPPED]
        chosen = [s for s in chosen if not tried_before(state, [*rest, s.term])][:left]
        left -= len(chosen)
        if chosen:
            others = None
            if rest:
                state, others = left_with(state, rest, best)
            state, found = try_all(state, starts_of(chosen, rest), others)
            sound = [h for h in found if not is_at_limit(h) and not _accuses_for_little(best, h)]
            better += [h for h in sound if compute_score(origin, h.summary) > top]
    return state.stepped_to(max(better, key=lambda h: compute_score(origin, h.summary))) if better else state


def _accuses_for_little(best: Hypothesis, found: Hypothesis) -> bool:
    """Return whether a hypothesis blames more gauges than another, and is hardly better for it."""
    more = _gauges(found) > _gauges(best)
    return more and compute_lead(found.summary, best.summary) < _SURE_ENOUGH


def _gauges(found: Hypothesis) -> int:
    return sum(t.effect.component == "instrument" for t in found.terms)
