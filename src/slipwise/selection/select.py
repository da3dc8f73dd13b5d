"""From a prepared campaign to a selection: what the posterior proposes is refitted, and so is what may stand for it."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, restart_base_fit, reweigh_base_fit
from slipwise.evidence.prior import Prior
from slipwise.evidence.score import FLOOR, compute_score
from slipwise.model import Model
from slipwise.preparation.prepared import Prepared, fit_prepared
from slipwise.relations.parameters import Term
from slipwise.selection.candidates import list_candidates
from slipwise.selection.explained_alone import ExplainedAlone, explain_by_statistics
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, polish, refit, refit_for_report
from slipwise.selection.inclusion import Inclusion, compute_inclusions
from slipwise.selection.initial_grid import is_lag, variants
from slipwise.selection.jacobian_memory import complete_jacobian
from slipwise.selection.plainer import plainest
from slipwise.selection.proposals import ProposedModel, compute_unexplained, list_likely, propose
from slipwise.selection.search_state import Search, try_all, try_one
from slipwise.selection.weighed_model import keep_weighed_model

#: A term that takes another's place in so large a share of the posterior is refitted in its place [1].
_RIVALS = 0.1
#: Candidates that are refitted alone where nothing is likely: what comes nearest.
_NEAREST = 2
#: Rounds in which a slider's noise at reversals is taken from what was found: the second knows laws of the first.
_WEIGHED = 2


@dataclass(frozen=True)
class SelectionResult:
    """A campaign of which it was asked what is missing.

    Attributes:
        prepared: the campaign.
        base: the base fit.
        search: what was looked at.
    """

    prepared: Prepared
    base: BaseFit
    search: Search


def select_effects(
    prepared: Prepared,
    model: Model | None = None,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
) -> SelectionResult:
    """Find what a model lacks.

    Args:
        prepared: the campaign.
        model: where to start; the paper's law on the campaign's rig when not given.
        own: effects beside those of the catalogue.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    tell = progress or (lambda what, share: None)
    own, base = tuple(own), fit_prepared(prepared, model)
    proposed = _propose(prepared, base, own, tell)
    for _ in range(0 if base.objective.balanced else _WEIGHED):
        found = proposed.found
        weighed = reweigh_base_fit(base, found.objective, found.solution.values) if found else None
        if weighed is None:
            break
        base, proposed = weighed, _propose(prepared, weighed, own, tell)
    state = _judge(base, proposed, tell)
    # what an effect seems to explain may be a local minimum that the base fit has missed
    better = restart_base_fit(base, state.best.solution.values) if state.best.terms else None
    if better is not None:
        base, state = better, _judge(better, _propose(prepared, better, own, tell), tell)
    tell("done", 1.0)
    return SelectionResult(prepared, base, state)


@dataclass(frozen=True)
class _Proposed:
    """What the posterior proposes of the candidates of a base fit.

    Attributes:
        candidates: that compete.
        cannot: effect -> why it could not compete.
        model: of the posterior.
        found: all that is likely, refitted together; None where nothing is.
    """

    candidates: list[Term]
    cannot: dict[str, str]
    model: ProposedModel
    found: Hypothesis | None


def _propose(
    prepared: Prepared, base: BaseFit, own: tuple[Effect, ...], tell: Callable[[str, float], None]
) -> _Proposed:
    """Return what is likely beside a base fit, refitted together."""
    candidates, cannot = list_candidates(base, own)
    tell("holding everything against the residual", 0.15)
    proposal = propose(base, candidates, prepared.recorded.materiality)
    starts = list_likely(proposal.linearisation, candidates, proposal.posterior)
    tell("refitting", 0.7)
    found: Hypothesis | None = None
    if starts:
        chosen = [t for t in candidates if t.label in starts]
        before = proposal.hypothesis
        contained = bool(before.terms) and {t.label for t in before.terms} <= starts.keys()
        found = polish(refit(base, chosen, starts, before if contained else None))
    return _Proposed(candidates, cannot, proposal, found)


def _judge(base: BaseFit, proposed: _Proposed, tell: Callable[[str, float], None]) -> Search:
    """Judge what is proposed by refits: with and without each, and with what may stand for it."""
    candidates, proposal, found = proposed.candidates, proposed.model, proposed.found
    origin = make_base_hypothesis(base)
    alone = _explain_alone(proposal, candidates)
    unexplained = compute_unexplained(proposal)
    weighed = keep_weighed_model(proposal.linearisation, proposal.posterior, proposal.units, proposal.apart)
    inclusions = _inclusions(proposal)
    state = Search(
        base, proposed.cannot, candidates, (), (origin,), alone, inclusions, unexplained, weighed=weighed,
        linearisation=proposal.linearisation,
    )  # fmt: skip
    if found is not None:
        state = replace(state, tried=(found,))
        state, found = _with_whole_numbers(state, found)
        state, found = _without_needless_lags(state, found)
        state, found = _without_needless(state, found)
        state, found = plainest(state, found)
        state = _with_rivals(state, proposal, candidates, found)
        tell("weighing", 0.95)
        state, steps = _climb(state, found)
        state, found, steps = _never_above_fewer_terms(state, found, steps)
        state = replace(state, path=(origin, *steps, complete_jacobian(found)))
        state = replace(state, final_refit=complete_jacobian(refit_for_report(found)))
    else:
        nearest = [a for a in alone if a.gain > 0.0][:_NEAREST]
        state, _ = try_all(state, [([a.term], {a.term.label: a.values}) for a in nearest])
    return state


def _explain_alone(proposal: ProposedModel, candidates: Sequence[Term]) -> list[ExplainedAlone]:
    first = proposal.origin
    return explain_by_statistics(first.statistics, first.columns, candidates)


def _inclusions(proposal: ProposedModel) -> dict[str, Inclusion]:
    fitted: dict[str, float] = {}
    for c in proposal.linearisation.own:
        fitted[c.effect] = max(fitted.get(c.effect, 0.0), 1.0 / c.unit)
    return compute_inclusions(proposal.posterior, fitted)


def _with_whole_numbers(state: Search, found: Hypothesis) -> tuple[Search, Hypothesis]:
    """Return a model with the better ones of constants that no fit changes, such as the order of a filter."""
    starts = {t.label: found.values_of(t) for t in found.terms}
    asked = [
        (found.terms, {**starts, t.label: v}) for t in found.terms for v in variants(t.effect, starts[t.label])[1:]
    ]
    if not asked:
        return state, found
    state, others = try_all(state, asked)
    return state, max([found, *others[:1]], key=lambda h: compute_score(state.path[0].summary, h.summary))


def _without_needless_lags(state: Search, found: Hypothesis) -> tuple[Search, Hypothesis]:
    """Return a model without lags of gauges whose channels another one shifts as well, where that does for both.

    A lag of a third of a period is far from the straight lines by which they were told apart. One is needless where
    the likelihood falls by less than an effect costs, samples counted as in the posterior.
    """
    lags = [t for t in found.terms if is_lag(t.effect)]
    for term in lags:
        if any(set(term.targets) & set(t.targets) for t in lags if t is not term):
            state, other = try_one(state, found.without(term), {}, found)
            if _compute_loss(other, found) < Prior().cost_of_effect:
                return _without_needless_lags(state, other)
    return state, found


def _without_needless(state: Search, found: Hypothesis) -> tuple[Search, Hypothesis]:
    """Return a model without those of its effects whose absence costs less than they do, each refitted without.

    By straight lines an effect may explain what it does not once all is fitted: that all cells read too little is
    one with more mass, and beside a filter of the wrong order something else makes up for the order.
    """
    if len(found.names) < 2:
        return state, found
    asked = [([t for t in found.terms if t.effect.name != name], {}) for name in found.names]
    state, without = try_all(state, asked, found)
    least = min(without, key=lambda h: _compute_loss(h, found))
    if _compute_loss(least, found) < Prior().cost_of_effect:
        return _without_needless(state, least)
    return state, found


def _compute_loss(less: Hypothesis, more: Hypothesis) -> float:
    """Return by how much a model is less likely than another, of left-out motions, samples counted few [nats]."""
    out = 0.0
    for relation in more.summary.fitted:
        count = min(more.summary.counts[relation][0], Prior.independent)
        one, other = (max(h.summary.left_out_level(relation), FLOOR) for h in (less, more))
        out += 0.5 * count * float(np.log(one / other))
    return out


def _climb(state: Search, found: Hypothesis) -> tuple[Search, list[Hypothesis]]:
    """Refit a model's terms one more at a time, first what shows most, up to all but the last."""
    seen = {name: of.seen for name, of in state.inclusions.items()}
    order = sorted(found.terms, key=lambda t: -seen.get(t.effect.name, 0.0))
    state, steps = try_all(state, [(order[:k], {}) for k in range(1, len(order))], found)
    return state, sorted(steps, key=lambda h: len(h.terms))


def _never_above_fewer_terms(
    state: Search, found: Hypothesis, steps: list[Hypothesis]
) -> tuple[Search, Hypothesis, list[Hypothesis]]:
    """Return a model that is fitted at least as well as with fewer of its terms, and the steps up to it.

    A fit that ends above one with fewer terms is in a local minimum: it begins again from there, and where that finds
    nothing below, its other terms are not needed.
    """
    lower = min(steps, key=lambda h: h.solution.cost, default=found)
    if lower.solution.cost >= found.solution.cost:
        return state, found, steps
    starts = {t.label: found.values_of(t) for t in found.terms}
    state, anew = try_one(state, found.terms, starts, lower)
    better = anew if anew.solution.cost < lower.solution.cost else lower
    return state, better, [h for h in steps if len(h.terms) < len(better.terms)]


def _with_rivals(state: Search, proposal: ProposedModel, terms: Sequence[Term], found: Hypothesis) -> Search:
    """Refit what stands in the place of a term where the posterior is without it."""
    posterior, here = proposal.posterior, {t.label for t in found.terms}
    of = {t.label: t for t in terms}
    for term in (t for t in found.terms if t.label in posterior.labels):
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
