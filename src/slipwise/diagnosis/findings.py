"""The evidence for every effect of a final model, in the few numbers on which its probability rests."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.ablation import without
from slipwise.evidence.prior import Prior
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import compute_lead, compute_relative_drop, compute_score
from slipwise.instruments.delay_or_filter import is_delay, passed
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis, is_at_limit, list_parameters_at_bound
from slipwise.selection.importance import Importance
from slipwise.selection.inclusion import ABSENT, Inclusion
from slipwise.selection.plainer import holds_as_limit
from slipwise.selection.search_state import Search
from slipwise.short_repr import short_repr

#: Nothing is surer than this many standard errors.
_SUREST = 30.0


@short_repr
@dataclass(frozen=True)
class Rival:
    """An effect in the place of one that was found.

    Attributes:
        hypothesis: the final model with the one in the place of the other, fitted.
        behind: by how many standard errors it is behind.
    """

    hypothesis: Hypothesis
    behind: float


@short_repr
@dataclass(frozen=True)
class EffectFinding:
    """One effect of a final model, with all gauges on which it acts.

    Attributes:
        name: of the effect.
        terms: it consists of.
        worth: what the model's score loses without it [nats].
        lead: by how many standard errors the model is better with it, block of time by block.
        share: of the squared residual above the noise that the base model leaves, what comes back without it [1].
        rival: the effect that could best take its place; None where none comes near.
        at_bound: parameters that ended on a bound which is not their absence.
        at_limit: whether that is a bound at which it is another effect, or none, so that it has no name of its own.
        importance: what leaving it out changes.
        material: importance over what matters, of what stays beside small faults of all gauges [1].
        stays: the share of its size that does [1].
        inclusion: what the posterior says of it.
        beside: what is left in the balance that shows it best, with it: something else hides there [floors].
    """

    name: str
    terms: tuple[Term, ...]
    worth: float
    lead: float
    share: float
    rival: Rival | None
    at_bound: tuple[str, ...]
    at_limit: bool
    importance: Importance
    material: float
    stays: float
    inclusion: Inclusion = ABSENT
    beside: float = 1.0

    @property
    def is_gauge(self) -> bool:
        """Whether it is a fault of gauges."""
        return self.terms[0].effect.component == "instrument"

    @property
    def is_trifle(self) -> bool:
        """Whether a refit of everything has left it no larger than what is always there and never named."""
        return self.material < Prior().get_trifle(gauge=self.is_gauge)


def collect_findings(
    state: Search, importances: dict[str, Importance], limits: Materiality
) -> tuple[Search, list[EffectFinding]]:
    """Return the evidence for every effect of a search's final model, most important first.

    Before it stands the state of the search that keeps what was refitted without an effect.

    Args:
        state: of the finished search.
        importances: effect -> importance.
        limits: what matters.
    """
    final, origin = state.final, state.path[0].summary
    names = [n for n in final.names if n in importances]
    parts = {name: tuple(t for t in final.terms if t.effect.name == name) for name in names}
    left = dict[str, ResidualSummary]()
    for name in names:
        state, left[name] = without(state, final, parts[name])
    rivals = _rivals(state, {n: parts[n] for n in names})
    bounds, nameless = list_parameters_at_bound(final), is_at_limit(final)
    base, end = (
        compute_excess_over_noise(origin, final.summary),
        compute_excess_over_noise(final.summary, final.summary),
    )
    sizes = {n: importances[n].share_of_limit(limits) for n in names}
    inclusions = {n: _inclusion_of(state, n, names) for n in names}
    stays = {n: of.stays for n, of in inclusions.items()}
    out = [
        EffectFinding(
            name=n,
            terms=parts[n],
            worth=compute_score(left[n], final.summary),
            lead=min(compute_lead(final.summary, left[n]), _SUREST),
            share=float(
                np.clip((compute_excess_over_noise(left[n], final.summary) - end) / max(base, 1e-12), 0.0, 1.0)
            ),
            rival=rivals.get(n),
            at_bound=tuple(p for label, p in bounds if label in {t.label for t in parts[n]}),
            at_limit=any(t.label in nameless for t in parts[n]),
            importance=importances[n],
            material=sizes[n] * stays[n],
            stays=stays[n],
            inclusion=inclusions[n],
            beside=_left_where_it_shows(left[n], final.summary),
        )
        for n in names
    ]
    return state, sorted(out, key=lambda f: -f.material)


def _inclusion_of(state: Search, name: str, names: Sequence[str]) -> Inclusion:
    """Return what the posterior says of an effect, or of one that becomes it and is not in the model.

    Their columns are alike, so the posterior may have taken the one for the other: a spring for a restrainer whose gap
    is small.
    """
    known = {t.effect.name: t.effect for t in state.terms if t.effect.name not in names}
    wider = [n for n, effect in known.items() if any(limit.becomes == name for limit in effect.limits)]
    return max((state.inclusions.get(n, ABSENT) for n in (name, *wider)), key=lambda of: of.matters)


def _left_where_it_shows(without: ResidualSummary, final: ResidualSummary) -> float:
    """Return what a model leaves of left-out motions in the balance that shows an effect best [floors]."""
    where = max(final.fitted, key=lambda r: compute_relative_drop(without, final, r))
    return float(np.sqrt(max(final.left_out_level(where), 1.0)))


def compute_excess_over_noise(summary: ResidualSummary, best: ResidualSummary) -> float:
    """Return the squared residual that stands above the noise, over all relations.

    Args:
        summary: of a hypothesis.
        best: one that may tell that the noise is less than was thought, for it leaves less.
    """
    return sum(max(summary.left_out[r] - min(count, best.left_out[r]), 0.0) for r, (count, _) in summary.counts.items())


def _rivals(state: Search, parts: dict[str, tuple[Term, ...]]) -> dict[str, Rival]:
    """Return for every effect the best of what was fitted in its place."""
    best = state.best
    ends = len(
        list_parameters_at_bound(best)
    )  # what has run against a bound, a patch wider than the stroke, is no rival
    out: dict[str, Rival] = {}
    for name in parts:
        rest = {t.label for t in best.terms if t.effect.name != name}
        others = [h for h in state.tried if name not in h.names and rest < {t.label for t in h.terms}]
        others = [h for h in others if len(h.terms) <= len(best.terms) and len(list_parameters_at_bound(h)) <= ends]
        others = [h for h in others if not holds_as_limit(h, best)]  # that is as good by what it is at a bound
        if not _has_delay_for_filter(best):  # a filter that takes nothing is a delay by another name
            others = [h for h in others if not _has_delay_for_filter(h)]
        rival = max(others, key=lambda h: compute_score(best.summary, h.summary), default=None)
        if rival is not None:
            out[name] = Rival(rival, float(np.clip(compute_lead(best.summary, rival.summary), -_SUREST, _SUREST)))
    return out


def _has_delay_for_filter(found: Hypothesis) -> bool:
    """Return whether a hypothesis has a filter that takes nothing the logger's own let through: a delay by its name."""
    run = found.objective.run(0)
    highest = passed(run.filtered, run.dt)
    return any(is_delay(t.effect, found.values_of(t), highest) for t in found.terms)
