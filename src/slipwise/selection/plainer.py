"""Plainer effects: what an effect is at an end of its bounds is tried in its place, and named unless it explains less.

A restrainer without a gap is a spring, and so is a contact that never slides. Such an effect holds the plainer one as
its limit, so it fits any data at least as well: as a further effect must, it must explain a share of what the plainer
one leaves. At the end itself it is nothing but the plainer one, and is not chosen.
"""

from collections.abc import Sequence

from slipwise.evidence.acceptance import compute_least_drop, is_kept
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis, is_at_limit
from slipwise.selection.search_state import Search, tried_or_fitted


def plainest(state: Search, found: Hypothesis) -> tuple[Search, Hypothesis]:
    """Return a hypothesis with plainer effects in the place of those that explain no more; fitted if they were not.

    Before it stands the state of the search that keeps what was fitted.

    Args:
        state: of a search.
        found: one of its hypotheses.
    """
    origin = state.path[0].summary
    for term in found.terms:
        rest = found.without(term)
        for plain in _plainer(state, term, rest):
            starts = {plain.label: _start(state, plain)}
            state, other = tried_or_fitted(state, [*rest, plain], starts, found)
            least = compute_least_drop([term])
            at_end = term.label in is_at_limit(found) and found.solution.cost >= (1.0 - least) * other.solution.cost
            explains_more = is_kept(origin, other.summary, found.summary, least) and not at_end
            if not explains_more and not is_at_limit(other):
                return plainest(state, other)
    return state, found


def holds_as_limit(found: Hypothesis, plain: Hypothesis) -> bool:
    """Return whether a hypothesis is another with an effect in the place of the plainer one that it becomes."""
    own, others = ({t.effect.name: t.effect for t in h.terms} for h in (found, plain))
    gone = others.keys() - own.keys()
    return any(limit.becomes in gone for name in own.keys() - others.keys() for limit in own[name].limits)


def _plainer(state: Search, term: Term, beside: Sequence[Term]) -> list[Term]:
    """Return the candidates that an effect becomes at an end of its bounds, but those that are there already."""
    becomes = {limit.becomes for limit in term.effect.limits} - {t.effect.name for t in beside}
    return [t for t in state.terms if t.effect.name in becomes and not t.group]


def _start(state: Search, term: Term) -> dict[str, float]:
    seen = (s.values for s in state.alone if s.term.label == term.label)
    return next(seen, term.effect.typical())
