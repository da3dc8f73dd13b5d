"""The verdict of a search: what its evidence decides, and what was fitted in the place of an effect."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.findings import EffectFinding, compute_excess_over_noise
from slipwise.diagnosis.held_out_regime import find_untestable_reason
from slipwise.diagnosis.indistinguishable import is_distinguishable, list_alike_pairs, list_known_effects
from slipwise.diagnosis.limitations import list_hidden_in_the_sum
from slipwise.diagnosis.unknown_surface import ResidualSurface, compute_share_of_floor, leftover, structured
from slipwise.diagnosis.unknown_surface import above_noise as left_above_noise
from slipwise.estimation.objective import Objective
from slipwise.evidence.acceptance import LEAST
from slipwise.evidence.calibration import load_calibration
from slipwise.evidence.decision import EVEN_ODDS, decide, is_left
from slipwise.evidence.prior import Prior
from slipwise.evidence.residual_summary import get_error
from slipwise.evidence.score import compute_relative_drop
from slipwise.instruments.suspects import effect_of
from slipwise.preparation.sample_fault import SampleFault
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis
from slipwise.selection.inclusion import make_evidence
from slipwise.selection.search_state import Search
from slipwise.short_repr import short_repr

#: Share of a probability that is left where no run is held out, which could have confirmed it [1].
_UNCONFIRMED = 0.9
#: Share of what the base model leaves above the noise of a held-out run that may stay there where effects hold [1].
_CARRIED_OVER = 0.5
#: Mean squared residual of a held-out run over that of the motions left out, up to which they are left alike [1].
_AS_LEFT_OUT = 1.5
#: The balance in which many laws show.
_MANY_LAWS = "pads"
#: Error of a model in floors, and over that of the base model [1]: above both much is left unexplained.
_MUCH = (3.0, 0.05)


@short_repr
@dataclass(frozen=True)
class Verdict:
    """What is missing.

    Attributes:
        kind: complete, named, ambiguous, unknown or instrument.
        effects: names of what matters, most important first.
        minor: names of what is there and does not matter.
        probability: that kind and names are right.
        leftover: "unknown" where something outside the catalogue is missing, alone or beside names; else "none".
        explained: share of what the base left above the noise that the effects that were found take away [1].
        surface: what remains, where anything does.
        rivals: hypotheses that nearly tie with the named one.
        findings: evidence for every effect that was found.
        unknown_beside: whether, beside what is named, something outside the catalogue is likelier than not.
    """

    kind: str
    effects: tuple[str, ...]
    minor: tuple[str, ...]
    probability: float
    leftover: str
    explained: float
    surface: ResidualSurface | None
    rivals: tuple[Hypothesis, ...]
    findings: tuple[EffectFinding, ...]
    unknown_beside: bool = False

    @property
    def is_doubtful(self) -> bool:
        """Whether the names, all together, or that something outside the catalogue is missing, are likelier wrong."""
        return self.kind in ("named", "instrument", "unknown") and self.probability < EVEN_ODDS


def compute_explained_share_of_base(origin: Hypothesis, found: Hypothesis, relation: str = "") -> float:
    """Return share of what the base left above the noise that a hypothesis takes away, in one balance or all [1]."""
    before, after = origin.summary, found.summary
    if not relation:
        return 1.0 - compute_excess_over_noise(after, after) / max(compute_excess_over_noise(before, after), 1e-12)
    noise = min(after.counts[relation][0], after.left_out[relation])
    over = max(before.left_out[relation] - noise, 1e-12)
    return 1.0 - max(after.left_out[relation] - noise, 0.0) / over


def decide_verdict(state: Search, found: Sequence[EffectFinding], limits: Materiality) -> Verdict:
    """Return the verdict of a search.

    Args:
        state: of the finished search.
        found: evidence for every effect of its final model.
        limits: what matters.
    """
    origin, final = state.path[0], state.final
    surface = leftover(final)
    surface = surface if structured(surface) else None
    rest = evidence_of_rest(origin, final, surface, state.unexplained, list_shares_of_limit(state))
    of_effects = {f.name: evidence_of(f) for f in found if not (f.at_limit or f.is_trifle)}
    decided = decide(of_effects, rest, limits.channel, load_calibration())
    kind, named, probability = decided.kind, decided.named, decided.probability
    if kind == "complete" and {f.name for f in found} - set(decided.minor):
        bare = evidence_of_rest(origin, origin, None)
        if is_left(bare, limits.channel):
            # what takes it away is not believed, so it is still there: a model that leaves it is not complete
            kind, rest, probability = "unknown", bare, EVEN_ODDS
    if named and _explains_little(origin, final) and is_left(rest, limits.channel):
        kind, named, probability = "unknown", (), max(1.0 - probability, EVEN_ODDS)
    if kind != "unknown":
        probability *= _chance_that_nothing_hides(state, named) * (1.0 if origin.summary.judged_apart else _UNCONFIRMED)
    nameless = any(f.at_limit and f.material >= 1.0 for f in found)
    beside = kind not in ("unknown", "complete") and (decided.unknown_beside or nameless)
    verdict = Verdict(
        kind,
        named,
        decided.minor,
        probability,
        "unknown" if kind == "unknown" or beside else "none",
        compute_explained_share_of_base(origin, final),
        surface,
        (),
        tuple(found),
        beside,
    )
    if kind == "unknown":  # what is drawn is all that is missing, not what unnamed effects have left of it
        whole = leftover(origin)
        return replace(verdict, surface=whole if structured(whole) else surface)
    if decided.tied:
        rivals = [(f, f.rival) for f in found if f.name in decided.tied and f.rival is not None]
        every = dict.fromkeys([*decided.named, *(n for f, _ in rivals for n in _in_place(state, f))])
        return replace(verdict, effects=tuple(every), rivals=tuple(rival.hypothesis for _, rival in rivals))
    for pair, unless in list_alike_pairs(list_known_effects(state).values()).items():
        if len(pair & set(decided.named)) == 1 and not is_distinguishable(final.objective, unless):
            every = (*sorted(pair), *(n for n in decided.named if n not in pair))
            return replace(verdict, kind="ambiguous", effects=every)
    return verdict


def _explains_little(origin: Hypothesis, final: Hypothesis) -> bool:
    """Return whether effects leave more than half where no pad's force was measured: no gauge tells what else it is."""
    without = origin.objective.specimen.free and not origin.objective.forces_measured
    return without and compute_explained_share_of_base(origin, final) < 1.0 - _CARRIED_OVER


def _chance_that_nothing_hides(state: Search, named: Sequence[str]) -> float:
    """Return the prior chance that no law matters of those that show in single pads only, where none was measured."""
    hidden = set(list_hidden_in_the_sum(state)) - set(named)
    return (1.0 - Prior().chance) ** len(hidden)


def _in_place(state: Search, finding: EffectFinding) -> list[str]:
    """Return the names that a rival has and the final model has not."""
    return [] if finding.rival is None else [n for n in finding.rival.hypothesis.names if n not in state.best.names]


def evidence_of(finding: EffectFinding) -> dict[str, float]:
    """Return the numbers on which the probability of an effect rests."""
    behind = finding.rival.behind if finding.rival is not None else 10.0
    shared = make_evidence(
        finding.inclusion, lead=finding.lead, gauge=finding.is_gauge, share=finding.share, beside=finding.beside
    )
    return {
        **shared,
        "worth": float(np.log(max(finding.worth, 1.0))),
        "rival": float(np.clip(behind, 0.0, 10.0)),
        "bound": float(bool(finding.at_bound)),
        "size": float(np.log(max(finding.material, 1e-3))),
    }


def evidence_of_rest(
    origin: Hypothesis,
    final: Hypothesis,
    surface: ResidualSurface | None,
    unexplained: Mapping[str, float] = MappingProxyType({}),
    of_limit: Mapping[str, float] = MappingProxyType({}),
) -> dict[str, float]:
    """Return the numbers on which rests whether the effects that were found are the right ones, whatever they leave.

    Args:
        origin: the base model.
        final: the model with the effects.
        surface: structure in what is left.
        unexplained: relation -> share of what is left that small imperfections do not explain; all where not given.
        of_limit: as of `list_shares_of_limit`.
    """
    over = left_above_noise(final, unexplained)
    where = max(over, key=lambda relation: over[relation])
    return {
        "explained": max(compute_explained_share_of_base(origin, final, where), 0.0) if final.terms else 0.0,
        "left": surface.explained if surface else 0.0,
        "relative": float(np.log(max(over[where], 1e-6))),
        "limit": float(np.log(of_limit.get(where, 1.0))),
        "floors": float(np.log(max(1.0, *(get_error(final.summary, r) for r in final.summary.fitted)))),
    }


def list_shares_of_limit(state: Search) -> dict[str, float]:
    """Return relation -> share of the balance that a law of one limit of materiality leaves there, as a rule [1].

    What matters is told by replays, in which a small force may change a slip by much. What is left has no name and
    cannot be replayed without; of the catalogue's laws that show most in the pads half leave less there at one limit.
    Other balances have too few laws for a rule.
    """
    here, weighed = state.linearisation, state.weighed
    if here is None or weighed is None or _MANY_LAWS not in here.rows.relations:
        return {}
    place = here.rows.relations.index(_MANY_LAWS)
    left = np.array([np.diag(each) for each in weighed.left_by_base])
    own = [
        j
        for j, c in enumerate(weighed.columns)
        if not c.gauge and c.form == 0 and 0.0 < left[place, j] == left[:, j].max()
    ]
    if not own:
        return {}
    floors = float(np.sqrt(np.median(left[place, own])))
    return {_MANY_LAWS: floors * compute_share_of_floor(state.final, _MANY_LAWS)}


def leaves_much(before: float, after: float) -> bool:
    """Return whether a model leaves so much that it is not confirmed, however much it explains.

    Args:
        before: error of the base model [noise floors].
        after: error of the model with the effects [noise floors].
    """
    return after > max(_MUCH[0], _MUCH[1] * before)


def _worst_errors(state: Search, runs: Sequence[int]) -> tuple[float, float]:
    """Return the error over some runs of the base model and of the final one, each where it is worst [noise floors]."""
    relations = state.path[0].summary.fitted
    before, after = (max(h.level_of(r, runs) for r in relations) for h in (state.path[0], state.final))
    return float(np.sqrt(before)), float(np.sqrt(after))


def _testable(objective: Objective) -> list[int]:
    """Return the places of the held-out runs that are not beyond what was fitted."""
    beyond = find_untestable_reason(objective)
    return [i for i in objective.held_out if i not in beyond]


def is_confirmed(state: Search) -> bool | None:
    """Return whether the held-out runs agree with what was found; None where none can tell or nothing was found.

    They agree where every balance that the effects improve has lost half of its excess over the noise there as well,
    or is left as well as the motions that were left out, and the model does not leave much. Runs beyond what was
    fitted take no part.
    """
    base, found = state.path[0], state.final
    origin, final = base.summary, found.summary
    runs = _testable(found.objective)
    improved = [
        r for r in origin.fitted if compute_relative_drop(origin, final, r) >= LEAST.law and origin.counts[r][1]
    ]
    if not found.terms or not improved or not runs:
        return None
    carried = all(_carries_over(base, found, relation, runs) for relation in improved)
    return carried and not leaves_much(*_worst_errors(state, runs))


def _carries_over(base: Hypothesis, found: Hypothesis, relation: str, runs: Sequence[int]) -> bool:
    before, after = (h.level_of(relation, runs) - 1.0 for h in (base, found))
    return after < max(_CARRIED_OVER * before, _AS_LEFT_OUT * found.summary.left_out_level(relation) - 1.0)


def with_faults(found: Verdict, faults: Sequence[SampleFault], terms: Sequence[Term] = ()) -> Verdict:
    """Add faults of samples to a verdict on what is left without them.

    Args:
        found: the verdict on the rest.
        faults: of samples.
        terms: that the verdict names.
    """
    if not faults:
        return found
    names = tuple(dict.fromkeys(effect_of(f.kind).name for f in faults))
    if found.kind == "complete":
        return replace(found, kind="instrument", effects=names, probability=found.probability)
    if found.kind == "unknown":
        # something else is missing that has no name
        return replace(found, kind="instrument", effects=names, probability=EVEN_ODDS)
    moved = {name for f in faults if f.kind == "lost" for name in f.channels}
    # a channel whose lost samples moved up the rest is delayed by that
    same = {t.effect.name for t in terms if t.effect.delays_channel and moved.issuperset(t.targets)}
    same -= {t.effect.name for t in terms if not moved.issuperset(t.targets)}
    named = tuple(n for n in found.effects if n not in same)
    return replace(found, effects=(*named, *(n for n in names if n not in named)))
