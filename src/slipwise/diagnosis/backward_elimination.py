"""Backward elimination: what is not material goes, rival and plainer laws are weighed, the rest is fitted anew."""

from dataclasses import replace

from slipwise.diagnosis.choice import has_delay_for_filter, overparameterised
from slipwise.diagnosis.hypothesis import Hypothesis, final_refit_of
from slipwise.diagnosis.indistinguishable import alike_pairs, known_effects
from slipwise.diagnosis.search_state import Search, left_with, tried_before, try_one
from slipwise.evidence.materiality import SAME_SCORE, material, score
from slipwise.parallel import on_every_core

#: Share by which a delay may lie behind a filter that takes nothing: true delays lay 0.0024 behind, filters 0.015 [1].
_NO_FILTER = 0.004
#: What leaves so many times as much is not as good when it is weighed anew: of 14 such none changed by 1 % [1].
_FAR_OFF = 3.0


def pruned(state: Search) -> Search:
    """Take effects away again whose loss is not material."""
    origin = state.path[0]
    while len(state.best.terms) > 1:
        whole = state.best
        for rest in map(whole.without, whole.terms):
            # what was fitted before may do; only if not is it fitted again, from where the whole ended
            known = tried_before(state, rest)
            sufficient = next((h for h in known if not material(origin.summary, h.summary, whole.summary)), None)
            fewer = sufficient or try_one(state, rest, {}, whole)
            if not material(origin.summary, fewer.summary, whole.summary):
                state = state.stepped_to(fewer)
                break
        else:
            break
    return state


def with_final_refit(state: Search) -> Search:
    """Weigh the best against rival and plainer laws, and fit it anew, without what is immaterial then.

    A large first effect leaves the noise near reversals wrong until it is weighed anew, and a second one repairs that.
    """
    state = _simplified(_with_rivals_tried(state))
    origin, reported = state.path[0].summary, final_refit_of(state.best)
    while len(state.best.terms) > 1:
        rests = [left_with(state, state.best.without(t), state.best) for t in state.best.terms]
        fewer = [h for h in rests if h.solution.cost < _FAR_OFF * state.best.solution.cost]
        summaries = on_every_core(lambda i, of=fewer: final_refit_of(of[i]).summary, len(fewer))
        pairs = zip(fewer, summaries, strict=True)
        sufficient = next((h for h, summary in pairs if not material(origin, summary, reported.summary)), None)
        if sufficient is None:
            break
        state, reported = state.stepped_to(sufficient), final_refit_of(sufficient)
    return replace(state, final_refit=reported)


def _with_rivals_tried(state: Search) -> Search:
    """Refit what is nearly one thing with an effect in its place: a screen sees little of it beside that effect."""
    best, origin = state.best, state.path[0].summary
    pairs = alike_pairs(known_effects(state).values())
    for term in best.terms:
        others = {name for pair in pairs if term.effect.name in pair for name in pair} - set(best.names)
        rest = best.without(term)
        for equivalent in (t for t in state.terms if t.effect.name in others):
            typical = {equivalent.label: equivalent.effect.typical()}
            again = tried_before(state, [*rest, equivalent]) or [try_one(state, [*rest, equivalent], typical, best)]
            if score(origin, again[0].summary) > score(origin, state.best.summary):
                state = state.stepped_to(again[0])
    return state


def _simplified(state: Search) -> Search:
    """Take a law of far fewer constants, or a delay for a filter that takes nothing, where it does as well."""
    origin, best = state.path[0].summary, state.best
    alike = [h for h in state.tried if len(h.terms) == len(best.terms) and set(h.names) != set(best.names)]
    plain = [h for h in alike if overparameterised(h, best, origin)]
    if has_delay_for_filter(best):
        top = score(origin, best.summary)
        least = top - max(SAME_SCORE, _NO_FILTER * top)
        plain += [h for h in _with_delays(state, best) if score(origin, h.summary) > least]
    if not plain:
        return state
    return state.stepped_to(max(plain, key=lambda h: score(origin, h.summary)))


def _with_delays(state: Search, found: Hypothesis) -> list[Hypothesis]:
    """Give a hypothesis with delays in the place of its filters, fitted if it was not before."""
    offered = {(t.effect.name, t.group): t for t in state.terms}
    delays = {t.label: d for t in found.terms if (d := offered.get((t.effect.plainer, t.group)))}
    if not delays:
        return []
    terms = [delays.get(t.label, t) for t in found.terms]
    starts = {
        d.label: {**d.effect.typical(), d.effect.lag: found.values_of(t)[t.effect.lag]}
        for t in found.terms
        if (d := delays.get(t.label))
    }
    return tried_before(state, terms) or [try_one(state, terms, starts, found)]
