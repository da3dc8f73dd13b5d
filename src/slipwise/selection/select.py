"""From a prepared campaign to a selection: what the posterior proposes is refitted, and judged as a search is."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from slipwise.diagnosis.candidates import list_candidates
from slipwise.diagnosis.hypothesis import Hypothesis, make_base_hypothesis, polish, refit, refit_for_report
from slipwise.diagnosis.jacobian_memory import complete_jacobian
from slipwise.diagnosis.search_state import Search, try_one
from slipwise.diagnosis.selection import SelectionResult
from slipwise.effects import Effect
from slipwise.model import Model
from slipwise.preparation.prepared import Prepared, fit_prepared
from slipwise.relations.parameters import Term
from slipwise.selection.proposals import ProposedModel, list_likely, propose

#: A term that takes another's place in so large a share of the posterior is refitted in its place [1].
_RIVALS = 0.1


def select_by_posterior(
    prepared: Prepared,
    model: Model | None = None,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
) -> SelectionResult:
    """Find what a model lacks; arguments, answer and errors as of `diagnosis.selection.select_effects`."""
    tell = progress or (lambda what, share: None)
    base = fit_prepared(prepared, model)
    candidates, cannot = list_candidates(base, tuple(own))
    tell("holding everything against the residual", 0.15)
    proposal = propose(base, candidates, prepared.recorded.materiality)
    origin = make_base_hypothesis(base)
    state = Search(base, cannot, candidates, (), (origin,))
    terms = [t for t in candidates if not t.effect.replaces]
    starts = list_likely(proposal.linearisation, terms, proposal.posterior)
    if starts:
        tell("refitting", 0.7)
        chosen = [t for t in terms if t.label in starts]
        before = proposal.hypothesis
        contained = bool(before.terms) and {t.label for t in before.terms} <= starts.keys()
        found = polish(refit(base, chosen, starts, before if contained else None))
        state = replace(state, tried=(found,), path=(origin, complete_jacobian(found)))
        state = _with_rivals(state, proposal, terms, found)
        tell("weighing", 0.95)
        state = replace(state, final_refit=complete_jacobian(refit_for_report(found)))
    tell("done", 1.0)
    return SelectionResult(prepared, base, state)


def _with_rivals(state: Search, proposal: ProposedModel, terms: Sequence[Term], found: Hypothesis) -> Search:
    """Refit what stands in the place of a term where the posterior is without it."""
    posterior, here = proposal.posterior, {t.label for t in found.terms}
    of = {t.label: t for t in terms}
    for term in found.terms:
        absent = posterior.sizes[:, posterior.labels.index(term.label)] == 0.0
        if np.mean(absent) < _RIVALS:
            continue
        share = np.mean(posterior.sizes[absent] > 0.0, axis=0) * np.mean(absent)
        beside = [(x, label) for x, label in zip(share, posterior.labels, strict=True) if label not in here]
        most, label = max(beside, default=(0.0, ""))
        if most < _RIVALS or label not in of:
            continue
        likely = list_likely(proposal.linearisation, terms, posterior, least=0.0)
        if label in likely:
            rest = found.without(term)
            state, _ = try_one(state, [*rest, of[label]], {label: likely[label]}, found)
    return state
