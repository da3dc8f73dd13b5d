"""The verb: diagnose a campaign."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign
from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.findings import collect_findings
from slipwise.diagnosis.full_length_errors import compute_full_length_errors
from slipwise.diagnosis.indistinguishable import list_alike_pairs
from slipwise.diagnosis.limitations import list_limitations
from slipwise.diagnosis.replays import replayed_errors
from slipwise.diagnosis.reported_sizes import list_named_sizes
from slipwise.diagnosis.result import Candidate, Diagnosis
from slipwise.diagnosis.verdict import Verdict, decide_verdict, is_confirmed, with_faults
from slipwise.effects import Effect
from slipwise.errors import InputError
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.estimation.intervals import Interval, compute_intervals
from slipwise.estimation.prediction_interval import PredictedFriction, predict_friction
from slipwise.evidence.residual_summary import ResidualSummary, get_error
from slipwise.evidence.score import compute_score, find_largest_drop
from slipwise.instruments.suspects import effect_of
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.jobs.stage_clock import StageClock
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.noise.level import is_at_floor
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared
from slipwise.selection.candidates import NOTHING_SLIDES
from slipwise.selection.explained_alone import list_least_sizes
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, refit_for_report
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.importance import compute_importance
from slipwise.selection.jacobian_memory import complete_jacobian
from slipwise.selection.search_state import Search
from slipwise.selection.select import SelectionResult, select_effects
from slipwise.selection.upper_limits import UpperLimit, compute_upper_limits

#: Hypotheses that are listed.
_LISTED = 6


@one_thread_algebra()
def diagnose(
    campaign: Campaign | Path | str | Prepared,
    model: Model | Path | str | None = None,
    *,
    own: Iterable[Effect] = (),
    system: bool = False,
    progress: Callable[[str, float], None] | None = None,
) -> Diagnosis:
    """Say which effect a model lacks.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        model: the user's current model, or its model.toml; the paper's law on the campaign's rig when not given.
        own: effects beside those of the catalogue, as `slipwise.effects.find_effect` gives them.
        system: replay base and final model as well.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    clock = StageClock(progress)
    tell = clock.tell
    tell("reading", 0.0)
    prepared = prepare(campaign)
    measured = prepared.recorded
    start = None if model is None else as_model(model)
    tell("fitting base parameters", 0.02)
    part = 0.7 if system else 0.9
    selected = select_effects(prepared, start, own, lambda words, share: tell(words, part * share))
    base, state = selected.base, selected.search
    tell("replaying without each effect", part)
    judgement = _judge(base, state, measured.materiality)
    small = _explained_by_one(state) if judgement.verdict.kind == "complete" else None
    if small is not None:
        listed = _judge(base, small, measured.materiality)
        judgement = listed if listed.verdict.kind == "complete" and listed.verdict.minor else judgement
    state, found, sizes, decided = judgement.state, judgement.found, judgement.sizes, judgement.verdict
    before = refit_for_report(state.path[0])
    shown = state.final if decided.effects else before
    verdict = with_faults(decided, prepared.gauge_faults, state.best.terms)
    final = found if shown is state.final else make_fit(base, shown, with_slopes=True)
    reasons = [*_untested(state), *list_limitations(state, final, prepared.faults)]
    cannot = [f"{name}: {reason}" for name, reason in reasons]
    replayed: dict[str, float] = {}
    if system:
        tell("replaying", part)
        try:
            roles = ("holdout",) if base.objective.held_out else ("fit", "repeat")
            models = [final] if shown is before else [make_fit(base, before), final]
            errors = replayed_errors(models, roles, lambda share: tell("replaying", part + (1.0 - part) * share))
            replayed = {"base": errors[0], "final": errors[-1]}
        except InputError as error:
            cannot.append(f"system level: {error}")
    judged_at_all = (r for r, counts in before.summary.counts.items() if any(counts))
    relations = {r: (get_error(before.summary, r), get_error(shown.summary, r)) for r in judged_at_all}
    judged = (before,) if shown is before else (before, shown)
    whole = compute_full_length_errors(prepared.uncut, prepared.unjudged, base.campaign, judged)
    recorded = _unmended(prepared, start) or before.summary
    tell("done", 1.0)
    stages = clock.stages()
    return Diagnosis(
        campaign=measured.name,
        verdict=verdict,
        component=_component(state, verdict),
        recorded_error=max(get_error(recorded, r) for r in recorded.fitted),
        base_error=max(a for a, _ in relations.values()),
        final_error=max(b for _, b in relations.values()),
        relations=relations,
        all_samples={relation: (errors[0], errors[-1]) for relation, errors in whole.items()},
        system=replayed,
        candidates=_listed(selected, recorded, before.summary, decided, verdict, sizes),
        confirmed=is_confirmed(state) if decided.effects else None,
        predicted_friction=_predicted_friction(final),
        least=list_least_sizes(state.alone),
        cannot_tell=tuple(cannot),
        corrections=prepared.corrections,
        search=state,
        final=final,
        seconds=sum(stages.values()),
        stages=stages,
        limits=_limits(state, verdict),
    )


@dataclass(frozen=True)
class _Judgement:
    """A search that was judged.

    Attributes:
        state: of the search, with what was refitted to judge it.
        found: its final model.
        sizes: intervals of that; empty without effects.
        verdict: what it says.
    """

    state: Search
    found: BaseFit
    sizes: Sequence[Interval]
    verdict: Verdict


def _judge(base: BaseFit, state: Search, limits: Materiality) -> _Judgement:
    found = make_fit(base, state.final, with_slopes=not state.final.objective.balanced)
    sizes = compute_intervals(found).entries if state.final.terms else ()
    state, evidence = collect_findings(state, compute_importance(found, state.final.terms, sizes), limits)
    return _Judgement(state, found, sizes, decide_verdict(state, evidence, limits))


def _explained_by_one(state: Search) -> Search | None:
    """Return a search that ends at the one effect which, refitted alone, leaves nothing above the noise.

    None where effects were found, where nothing is above the noise, or where no effect alone brings it there. What is
    too small to matter is believed to be there if it leaves nothing to explain: it is worth being told.
    """
    origin = state.path[0]
    if state.best.terms or _is_at_floor(origin):
        return None
    alone = [h for h in state.tried if len(h.terms) == 1 and _is_at_floor(h)]
    if not alone:
        return None
    best = complete_jacobian(max(alone, key=lambda h: compute_score(origin.summary, h.summary)))
    return replace(state, path=(origin, best), final_refit=complete_jacobian(refit_for_report(best)))


def _is_at_floor(found: Hypothesis) -> bool:
    return all(is_at_floor(get_error(found.summary, relation)) for relation in found.summary.fitted)


def _untested(state: Search) -> list[tuple[str, str]]:
    """Return effects that the campaign cannot test, with the reason; friction where nothing slides is named at once."""
    gone = [name for name, reason in state.cannot.items() if reason == NOTHING_SLIDES]
    together = [(", ".join(gone), NOTHING_SLIDES)] if gone else []
    return [*together, *((name, reason) for name, reason in state.cannot.items() if reason != NOTHING_SLIDES)]


def _unmended(prepared: Prepared, model: Model | None) -> ResidualSummary | None:
    """Return what the base model leaves of the campaign as it was recorded; None where no gauge has a fault of samples.

    Where nothing could be fitted as it was recorded, there is nothing to hold the mended campaign against.
    """
    if not prepared.gauge_faults:
        return None
    try:
        base = fit_base(prepared.unmended, prepared.on_rig(model), start=prepared.start)
    except InputError:
        return None
    return refit_for_report(make_base_hypothesis(base)).summary


def _predicted_friction(final: BaseFit) -> tuple[PredictedFriction, ...]:
    """Return what is predicted of one slider's held-out runs; a girder's balances judge those sample by sample."""
    if final.objective.balanced:
        return ()
    return tuple(found for found in predict_friction(final) if found.inside is not None)


def _limits(state: Search, verdict: Verdict) -> dict[str, UpperLimit]:
    """Return how large each effect that is not named can be at most; of a tie all are named."""
    if state.weighed is None:
        return {}
    return compute_upper_limits(state.weighed, state.terms, verdict.effects)


def _component(state: Search, verdict: Verdict) -> str:
    if verdict.kind == "complete":
        return "none"
    if verdict.kind == "instrument":
        return "instrument"
    if verdict.kind in ("named", "ambiguous"):
        found = {f.name: f.terms[0].effect.component for f in verdict.findings}
        return next(found[name] for name in verdict.effects if name in found)
    relation = verdict.surface.relation if verdict.surface else "pads"
    return {"pads": "pad friction", "girder": "girder", "heave": "pad load"}.get(relation, "pad load")


def _listed(
    selected: SelectionResult,
    recorded: ResidualSummary,
    before: ResidualSummary,
    decided: Verdict,
    verdict: Verdict,
    sizes: Sequence[Interval],
) -> tuple[Candidate, ...]:
    """Return hypotheses, and faults of samples: before them where they alone are what is missing."""
    hypotheses = _candidates(selected.search, before, decided, sizes)
    # what a dead cell spoils is not judged without it
    judged = (r for r, counts in before.counts.items() if any(counts) and r in recorded.fitted)
    where = max(judged, key=lambda relation: get_error(recorded, relation))
    with_fault, without = get_error(recorded, where), get_error(before, where)
    faults = selected.prepared.gauge_faults
    labels = dict.fromkeys(f"{effect_of(f.kind).name}[{name}]" for f in faults for name in f.channels)
    told = tuple(Candidate(label, verdict.probability, with_fault, without, 0.0, {}) for label in labels)
    return (*hypotheses, *told) if decided.effects else (*told, *hypotheses)


def _candidates(
    state: Search, before: ResidualSummary, verdict: Verdict, sizes: Sequence[Interval]
) -> tuple[Candidate, ...]:
    origin = state.path[0]
    unique: dict[tuple[str, ...], Hypothesis] = {}
    for h in sorted(state.tried, key=lambda h: -compute_score(origin.summary, h.summary)):
        if h.terms and compute_score(origin.summary, h.summary) > 0.0:
            unique.setdefault(h.names, h)
    best = state.best
    unique |= {h.names: h for h in verdict.rivals}
    order = [best, *(h for n, h in unique.items() if n != best.names)] if best.terms else list(unique.values())
    absorbed = {s.term.label: s.absorbed for s in state.alone}
    listed = order[:_LISTED]
    shares = _shares(state, verdict, listed)
    out = []
    for h, probability in zip(listed, shares, strict=True):
        _, where = find_largest_drop(origin.summary, h.summary)
        where = where or "pads"
        shown = state.final if h is best else h
        out.append(
            Candidate(
                effect=" + ".join(t.label for t in h.terms),
                probability=probability,
                holdout_before=get_error(before, where),
                holdout_after=get_error(shown.summary, where),
                absorbed_by_base=max(absorbed.get(t.label, 0.0) for t in h.terms),
                parameters=list_named_sizes(shown, sizes if verdict.effects and h is best else ()),
            )
        )
    return tuple(out)


def _shares(state: Search, verdict: Verdict, listed: list[Hypothesis]) -> list[float]:
    """Return each listed hypothesis its chance: those that tie share that of the verdict, the others what is left."""
    named = verdict.kind in ("named", "instrument", "ambiguous")
    if not listed:
        return []
    origin = state.path[0]
    weights = np.array([max(compute_score(origin.summary, h.summary), 1e-9) for h in listed])
    if not named:
        return [float(x) for x in (1.0 - verdict.probability) * weights / weights.sum()]
    rivals = verdict.rivals or [h for h in listed if _is_one_thing(h, state.best)]
    alike = [h is state.best or any(h is r for r in rivals) for h in listed]
    tied = np.array(alike) if verdict.kind == "ambiguous" else np.array([h is state.best for h in listed])
    weights[tied] = 0.0
    rest = (1.0 - verdict.probability) * weights / max(weights.sum(), 1e-12)
    sharing = max(int(tied.sum()), 2 if verdict.kind == "ambiguous" else 1)  # the equivalent may not be refitted
    return [float(x) for x in np.where(tied, verdict.probability / sharing, rest)]


def _is_one_thing(one: Hypothesis, other: Hypothesis) -> bool:
    apart = frozenset(one.names) ^ frozenset(other.names)
    return apart in list_alike_pairs(t.effect for t in (*one.terms, *other.terms))
