"""Choosing among candidates that were screened, and among those that were fitted."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.screening import Screened
from slipwise.evidence.materiality import MATERIAL, least_material_drop, material_drop, score
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.instruments.delay_or_filter import is_delay, passed

#: What a constant of a law must be worth: the logarithm of some hundred thousand samples (Schwarz 1978).
_PER_CONSTANT = 12.0
#: A law with one constant more is no other kind of law: a filter's order, beside a delay.
_FAR_MORE = 2
#: Share of the best explanation from which on another gauge's ties with it [1].
_TIE = 0.99


def limit_per_effect(found: Sequence[Screened], count: int) -> list[Screened]:
    """Give the best candidates, each effect at most twice: a card and a single gauge."""
    out: list[Screened] = []
    for s in found:
        if sum(o.term.effect.name == s.term.effect.name for o in out) < 2:
            out.append(s)
        if len(out) == count:
            break
    return out


def best_of(origin: Hypothesis, tried: Sequence[Hypothesis]) -> Hypothesis | None:
    """Give what explains most; of one fault on several gauges that tie, that which leaves the girder its rated mass.

    Cells of load that all read 4 % less under a girder of 4 % more mass are cells of friction that all read 4 % more.
    """
    ranked = sorted(((score(origin.summary, h.summary), h) for h in tried), key=lambda pair: -pair[0])
    good = [(gain, h) for gain, h in ranked if gain > 0.0 and material_alone(origin, h)]
    if not good:
        return None
    top, first = good[0]
    if material_drop(origin.summary, first.summary)[0] < MATERIAL and ranked[0][0] > top:
        return None  # a law of so little is not named where what is no finding explains more
    ties = dict[tuple[str, ...], Hypothesis]()
    for gain, h in good:  # one gauge with a worse law is no tie
        if h.names == first.names and gain > _TIE * top:
            ties.setdefault(tuple(t.label for t in h.terms), h)
    return min(ties.values(), key=_off_rated)


def _off_rated(found: Hypothesis) -> float:
    """Give how far a hypothesis takes the girder's mass from its rated value [1]."""
    rated = found.problem.specimen.mass
    return abs(np.log(found.solution.values.get("rig.mass", rated) / rated))


def has_delay_for_filter(found: Hypothesis) -> bool:
    """Tell whether a hypothesis has a filter that takes nothing the logger's own let through: a delay by its name."""
    run = found.problem.runs[0]
    highest = passed(run.filtered, run.dt)
    return any(is_delay(t.effect, found.values_of(t), highest) for t in found.terms)


def material_alone(origin: Hypothesis, found: Hypothesis) -> bool:
    """Tell whether effects are worth a name as a first step from the base model."""
    return material_drop(origin.summary, found.summary)[0] >= least_material_drop(found.terms)


def overparameterised(simple: Hypothesis, complex_hypothesis: Hypothesis, base: ResidualSummary) -> bool:
    """Tell whether a hypothesis of far more constants explains no more, as a patch as wide as the stroke does.

    Args:
        simple: of fewer constants.
        complex_hypothesis: of more.
        base: residuals of the base model.
    """
    more = len(complex_hypothesis.solution.free) - len(simple.solution.free)
    gain = score(base, complex_hypothesis.summary) - score(base, simple.summary)
    return more >= _FAR_MORE and gain < _PER_CONSTANT * more
