"""Backward elimination: what is not material goes, rival and plainer laws are weighed, the rest is fitted anew."""

from dataclasses import replace

from slipwise.diagnosis.ablation import without
from slipwise.diagnosis.hypothesis import Hypothesis, refit_for_report
from slipwise.diagnosis.indistinguishable import list_alike_pairs, list_known_effects
from slipwise.diagnosis.plainer import plainest
from slipwise.diagnosis.ranking import has_delay_for_filter
from slipwise.diagnosis.search_state import Search, left_with, tried_before, tried_or_fitted, try_one
from slipwise.evidence.acceptance import compute_least_drop, is_kept
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import compute_score
from slipwise.relations.parameters import Term

#: Share by which a delay may lie behind a filter that takes nothing: true delays lay 0.0024 behind, filters 0.015 [1].
_NO_FILTER = 0.004


def pruned(state: Search) -> Search:
    """Take effects away again that are not worth being kept beside the others, the least first."""
    origin = state.path[0].summary
    while len(state.best.terms) > 1:
        state, least = _least_needed(state, state.best, origin)
        if least is None:
            return state
        state, rest = left_with(state, state.best.without(least), state.best)
        state = state.stepped_to(rest)
    return state


def _least_needed(state: Search, whole: Hypothesis, origin: ResidualSummary) -> tuple[Search, Term | None]:
    """Return the effect whose loss costs least, where a hypothesis is as good without it; the new state before it."""
    losses: list[tuple[float, Term]] = []
    for term in whole.terms:
        state, fewer = without(state, whole, [term])
        if not is_kept(origin, fewer, whole.summary, compute_least_drop([term])):
            losses.append((compute_score(fewer, whole.summary), term))
    return state, min(losses, key=lambda loss: loss[0])[1] if losses else None


def with_final_refit(state: Search) -> Search:
    """Weigh the best against rival and plainer laws, and fit it anew, without what is not worth being kept then.

    A large first effect leaves the noise near reversals wrong until it is weighed anew, and a second one repairs that.
    """
    state = _simplified(_with_rivals_tried(state))
    state, plain = plainest(state, state.best)
    state = state if plain is state.best else pruned(state.stepped_to(plain))
    reported = refit_for_report(state.best)
    origin = state.path[0].summary
    while len(reported.terms) > 1:
        state, least = _least_needed(state, reported, origin)
        if least is None:
            break
        state, rest = left_with(state, reported.without(least), reported)
        state = state.stepped_to(rest)
        reported = refit_for_report(state.best)
    return replace(state, final_refit=reported)


def _with_rivals_tried(state: Search) -> Search:
    """Refit what is nearly one thing with an effect in its place: a screen sees little of it beside that effect."""
    best, origin = state.best, state.path[0].summary
    pairs = list_alike_pairs(list_known_effects(state).values())
    for term in best.terms:
        others = {name for pair in pairs if term.effect.name in pair for name in pair} - set(best.names)
        rest = best.without(term)
        for equivalent in (t for t in state.terms if t.effect.name in others):
            typical = {equivalent.label: equivalent.effect.typical()}
            state, again = tried_or_fitted(state, [*rest, equivalent], typical, best)
            if compute_score(origin, again.summary) > compute_score(origin, state.best.summary):
                state = state.stepped_to(again)
    return state


def _simplified(state: Search) -> Search:
    """Take a delay for a filter that takes nothing, where it does as well."""
    origin, best = state.path[0].summary, state.best
    plain: list[Hypothesis] = []
    if has_delay_for_filter(best):
        top = compute_score(origin, best.summary)
        least = (1.0 - _NO_FILTER) * top
        state, found = _with_delays(state, best)
        plain += [h for h in found if compute_score(origin, h.summary) > least]
    if not plain:
        return state
    return state.stepped_to(max(plain, key=lambda h: compute_score(origin, h.summary)))


def _with_delays(state: Search, found: Hypothesis) -> tuple[Search, list[Hypothesis]]:
    """Return a hypothesis with delays in the place of its filters, fitted if it was not before; the new state first."""
    offered = {(t.effect.name, t.group): t for t in state.terms}
    delays = {t.label: d for t in found.terms if (d := offered.get((t.effect.plainer, t.group)))}
    if not delays:
        return state, []
    terms = [delays.get(t.label, t) for t in found.terms]
    starts = {
        d.label: {**d.effect.typical(), d.effect.lag: found.values_of(t)[t.effect.lag]}
        for t in found.terms
        if (d := delays.get(t.label))
    }
    known = tried_before(state, terms)
    if known:
        return state, known
    state, fitted = try_one(state, terms, starts, found)
    return state, [fitted]
