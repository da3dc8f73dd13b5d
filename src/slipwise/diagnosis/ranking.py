"""Choosing among candidates that were screened, and among those that were fitted."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis, is_at_limit
from slipwise.diagnosis.screening import Screened
from slipwise.evidence.acceptance import compute_least_drop, is_kept
from slipwise.evidence.score import compute_score
from slipwise.instruments.delay_or_filter import is_delay, passed

#: Share of the best explanation from which on another gauge's ties with it [1].
_TIE = 0.99


def limit_per_effect(found: Sequence[Screened], count: int) -> list[Screened]:
    """Return the best candidates, each effect at most twice: a card and a single gauge."""
    out: list[Screened] = []
    for s in found:
        if sum(o.term.effect.name == s.term.effect.name for o in out) < 2:
            out.append(s)
        if len(out) == count:
            break
    return out


def best_of(origin: Hypothesis, tried: Sequence[Hypothesis]) -> Hypothesis | None:
    """Return what explains most; of one fault on several gauges that tie, that which leaves the girder its rated mass.

    Cells of load that all read 4 % less under a girder of 4 % more mass are cells of friction that all read 4 % more.
    """
    ranked = sorted(((compute_score(origin.summary, h.summary), h) for h in tried), key=lambda pair: -pair[0])
    good = [(gain, h) for gain, h in ranked if kept_alone(origin, h)]
    if not good:
        return None
    top, first = good[0]
    ties = dict[tuple[str, ...], Hypothesis]()
    for gain, h in good:  # one gauge with a worse law is no tie
        if h.names == first.names and gain > _TIE * top:
            ties.setdefault(tuple(t.label for t in h.terms), h)
    return min(ties.values(), key=_off_rated)


def _off_rated(found: Hypothesis) -> float:
    """Return how far a hypothesis takes the girder's mass from its rated value [1]."""
    rated = found.objective.specimen.mass
    return abs(np.log(found.solution.values.get("rig.mass", rated) / rated))


def has_delay_for_filter(found: Hypothesis) -> bool:
    """Return whether a hypothesis has a filter that takes nothing the logger's own let through: a delay by its name."""
    run = found.objective.run(0)
    highest = passed(run.filtered, run.dt)
    return any(is_delay(t.effect, found.values_of(t), highest) for t in found.terms)


def kept_alone(origin: Hypothesis, found: Hypothesis) -> bool:
    """Return whether effects are worth being kept as a first step from the base model, and are what they are called."""
    return not is_at_limit(found) and is_kept(
        origin.summary, origin.summary, found.summary, compute_least_drop(found.terms)
    )
