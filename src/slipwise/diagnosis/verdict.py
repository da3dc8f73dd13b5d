"""From a finished search to a verdict, never stronger than its evidence."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.diagnosis.choice import has_delay_for_filter, material_alone, overparameterised
from slipwise.diagnosis.forward_selection import MOST_EFFECTS
from slipwise.diagnosis.hypothesis import Hypothesis, constant_at_bound, strength_at_bound
from slipwise.diagnosis.indistinguishable import alike_pairs, distinguishable, known_effects
from slipwise.diagnosis.search_state import Search
from slipwise.diagnosis.unknown_surface import Surface, leftover, structured
from slipwise.estimation.parameters import Term
from slipwise.evidence.materiality import SAME_SCORE, least_material_drop, material_drop, score, worsens
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.instruments.sample_faults import SampleFault
from slipwise.instruments.suspects import effect_of

#: A right family explains this share, whatever its form: 0.87 and more on trials, most wrong ones 0.69 and less [1].
RIGHT_FAMILY = 0.70
#: Right as often as not up to the first share, as sure as its lead from the second on: wrong laws reached 0.79 [1].
_EVEN_ODDS_FAMILY, _SURE_FAMILY = 0.80, 0.92
#: What it must explain when its strength has run against a bound: more of the same, not something else.
STRAINED_FAMILY = 0.90
#: The same for geometry, which has one form only: wrong ones reached 0.96, right ones left no structure (36 campaigns).
EXACT_FAMILY = 0.98
#: The same for two or more, which take many forms together: 0.92 and more on the blind bench, the best wrong two 0.87.
SEVERAL_FAMILY = 0.90
#: Below this drop of the mean squared residual the share is itself uncertain, and half is enough [noise variance].
_SURE_SHARE = 1.0
#: An effect that explains less than half of little, and leaves nothing with structure, is no finding.
HALF, _FAINT, _EVEN_ODDS = 0.5, 0.4, 0.6
#: Beside a fault of samples something else is missing that has no name.
_EVEN_ODDS_OF_FAULTS = 0.5
#: A mean squared residual above this is no perfect model's [noise variance], even where no state predicts it.
ABOVE_NOISE = 1.5
#: Nor can rivals be told apart whose scores differ by less than this share of it, and of what the better one leaves: a
#: law of not quite the right form leaves something as well.
_SAME_SHARE, _SAME_EXCESS = 0.004, 0.5
#: The same share for two faults of gauges: both have one form only, and nothing but noise between them [1].
_SAME_FAULT = 5e-4
#: Nobody is surer than this of what no run has confirmed that was not fitted [1].
_UNCONFIRMED = 0.9


@dataclass(frozen=True)
class Verdict:
    """What is missing.

    Attributes:
        kind: complete, named, ambiguous, unknown or instrument.
        effects: names.
        probability: that kind and names are right.
        leftover: "none" or "unknown".
        explained: share of what the base left above the noise that the named effects take away [1].
        surface: what remains, where anything does.
        rivals: hypotheses that nearly tie with the named one.
    """

    kind: str
    effects: tuple[str, ...]
    probability: float
    leftover: str
    explained: float
    surface: Surface | None
    rivals: tuple[Hypothesis, ...]


def excess(of: ResidualSummary, best: ResidualSummary) -> float:
    """Give how much squared residual stands above the noise, over all relations and runs.

    Args:
        of: a hypothesis.
        best: one that may tell that the noise is less than was thought, for it leaves less.
    """
    total = 0.0
    for name, (fitted, held) in of.counts.items():
        total += max(of.fitted[name] - min(fitted, best.fitted[name]), 0.0)
        total += max(of.held_out[name] - min(held, best.held_out[name]), 0.0)
    return total


def decide_verdict(state: Search) -> Verdict:
    """Give the verdict of a search."""
    found = _decided(state)
    if any(held for _, held in state.path[0].summary.counts.values()):
        return found
    return replace(found, probability=min(found.probability, _UNCONFIRMED))


def _decided(state: Search) -> Verdict:
    origin, best = state.path[0], state.best
    surface = leftover(state.final)
    remains = structured(surface)
    explained = 1.0 - excess(best.summary, best.summary) / max(excess(origin.summary, best.summary), 1e-12)
    if not best.terms:
        if remains or _above_noise(best):
            shown = surface if remains else None
            return Verdict("unknown", (), _unknown_probability(shown, 0.0), "unknown", 0.0, shown, ())
        return Verdict("complete", (), _complete_probability(state), "none", 1.0, surface, ())
    too_many = len(best.terms) >= MOST_EFFECTS
    drop = material_drop(origin.summary, best.summary)[0]
    family = explained >= _least_share(best, drop) and not worsens(origin.summary, best.summary)
    too_little = explained < HALF if len(best.terms) == 1 else not family
    # effects of the wrong family can be bent to the fitted runs until they leave little there: held-out runs tell
    if (remains and (not family or too_many)) or (too_little and _worst(state.final.summary) > ABOVE_NOISE):
        shown = surface if remains else None
        probability = _unknown_probability(shown, explained)
        whole = leftover(origin)  # what is drawn is all that is missing, not what unnamed effects have left of it
        drawn = whole if structured(whole) else shown
        return Verdict("unknown", (), probability, "unknown", explained, drawn, ())
    if explained < HALF and not remains and drop < _FAINT and _worst(origin.summary) < ABOVE_NOISE:
        return Verdict("complete", (), _EVEN_ODDS, "none", explained, surface, ())
    rivals = _rivals(state, best)
    names = best.names
    left = "unknown" if remains or _above_noise(state.final) else "none"
    margin = _margin(state, best)
    probability = _named_probability(margin, explained, best, left)
    if drop >= _SURE_SHARE:
        probability = min(probability, _family_probability(explained))
    if rivals:
        every = tuple(dict.fromkeys(n for h in (best, *rivals) for n in h.names))
        return Verdict("ambiguous", every, probability, left, explained, surface, rivals)
    for pair, unless in alike_pairs(known_effects(state).values()).items():
        if len(pair & set(names)) == 1 and not distinguishable(best.problem, unless):
            every = (*sorted(pair), *(n for n in names if n not in pair))
            return Verdict("ambiguous", every, probability, left, explained, surface, ())
    instruments = all(t.effect.component == "instrument" for t in best.terms)
    return Verdict("instrument" if instruments else "named", names, probability, left, explained, surface, ())


def _least_share(found: Hypothesis, drop: float) -> float:
    """Give the share of what the base left that a right family explains at least."""
    if drop >= _SURE_SHARE and all(t.effect.exact for t in found.terms):
        return EXACT_FAMILY
    if strength_at_bound(found):
        return STRAINED_FAMILY
    if drop >= _SURE_SHARE and len(found.terms) > 1:
        return SEVERAL_FAMILY
    return RIGHT_FAMILY if drop >= _SURE_SHARE else HALF


def _above_noise(found: Hypothesis) -> bool:
    """Tell whether a hypothesis leaves more than noise in all runs, whether or not a state organises it."""
    levels = found.summary
    both = [[levels.level(r, held_out=h) for h in (False, True) if levels.counts[r][h]] for r in levels.fitted]
    return any(min(of) > ABOVE_NOISE for of in both if of)


def _worst(of: ResidualSummary) -> float:
    """Give the largest mean squared residual of any relation, on fitted or held-out runs [noise variance]."""
    return max(of.level(r, held_out=h) for r, counts in of.counts.items() for h in (False, True) if counts[h])


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
        return replace(found, kind="instrument", effects=names, probability=max(found.probability, 0.9))
    if found.kind == "unknown":
        return replace(found, kind="instrument", effects=names, probability=_EVEN_ODDS_OF_FAULTS)
    moved = {name for f in faults if f.kind == "lost" for name in f.channels}
    # a channel whose lost samples moved up the rest is delayed by that
    same = {t.effect.name for t in terms if t.effect.delays_channel and moved.issuperset(t.targets)}
    same -= {t.effect.name for t in terms if not moved.issuperset(t.targets)}
    named = tuple(n for n in found.effects if n not in same)
    return replace(found, effects=(*named, *(n for n in names if n not in named)))


def _rivals(state: Search, best: Hypothesis) -> tuple[Hypothesis, ...]:
    """Give other hypotheses of as many effects that explain as much."""
    origin = state.path[0]
    top = score(origin.summary, best.summary)
    unexplained = _SAME_EXCESS * excess(best.summary, best.summary)
    out: dict[tuple[str, ...], Hypothesis] = {}
    for h in state.tried:
        if len(h.terms) != len(best.terms) or set(h.names) == set(best.names):
            continue
        if (constant_at_bound(h) and not constant_at_bound(best)) or (
            has_delay_for_filter(h) and not has_delay_for_filter(best)
        ):
            continue
        if overparameterised(best, h, origin.summary):
            continue
        common = set(h.names) & set(best.names)
        shared = [score(origin.summary, o.summary) for o in state.tried if o.names and set(o.names) <= common]
        behind = top - score(origin.summary, h.summary)
        # only what is explained beyond the effects that both name can tell the two apart
        share = _SAME_FAULT if _faults_only(h, best) else _SAME_SHARE
        near = max(SAME_SCORE, min(share * (top - max(shared, default=0.0)), unexplained))
        if behind < near and material_alone(origin, h):
            out[h.names] = h
    return tuple(out.values())


def _faults_only(one: Hypothesis, other: Hypothesis) -> bool:
    """Tell whether two hypotheses differ by faults of gauges only."""
    differ = set(one.names) ^ set(other.names)
    of = {t.effect.name: t.effect.component for t in (*one.terms, *other.terms)}
    return all(of[name] == "instrument" for name in differ)


def _margin(state: Search, best: Hypothesis) -> float:
    """Give by which share of its score the best hypothesis leads the next of other names."""
    origin = state.path[0]
    top = score(origin.summary, best.summary)
    others = [
        score(origin.summary, h.summary)
        for h in state.tried
        if len(h.terms) <= len(best.terms) and not set(h.names) <= set(best.names)
    ]
    return float((top - max(others, default=0.0)) / max(top, 1e-12))


def _named_probability(margin: float, explained: float, best: Hypothesis, left: str) -> float:
    """Give the chance that these names are right; logistic in lead and share explained.

    Like the other two, set on 495 campaigns of the blind bench.
    """
    lead = np.clip(margin, 0.0, 0.5)
    odds = 0.6 + 5.0 * lead / 0.5 + 2.0 * (np.clip(explained, 0.4, 1.0) - 0.7) / 0.3
    odds -= 0.3 * (len(best.terms) - 1) + (0.7 if left == "unknown" else 0.0)
    return float(np.clip(1.0 / (1.0 + np.exp(-odds)), 0.3, 0.99))


def _family_probability(explained: float) -> float:
    """Give the chance that a family is right by the share that it explains."""
    return float(np.interp(explained, (_EVEN_ODDS_FAMILY, _SURE_FAMILY), (0.5, 0.99)))


def _unknown_probability(surface: Surface | None, explained: float) -> float:
    share = surface.explained if surface is not None else 0.0
    odds = 0.5 + 3.0 * np.clip(share, 0.0, 0.6) + 2.5 * (0.75 - np.clip(explained, 0.0, 0.75))
    return float(np.clip(1.0 / (1.0 + np.exp(-odds)), 0.3, 0.98))


def _complete_probability(state: Search) -> float:
    origin = state.path[0]
    near = max((_drop(origin, h) for h in state.tried), default=0.0)
    return float(np.clip(0.98 - 0.2 * near, 0.75, 0.98))


def _drop(origin: Hypothesis, found: Hypothesis) -> float:
    return min(material_drop(origin.summary, found.summary)[0] / least_material_drop(found.terms), 1.0)
