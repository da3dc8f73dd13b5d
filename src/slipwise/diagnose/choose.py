"""Choosing among candidates that were screened, and among those that were fitted."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnose.refit import Hypothesis
from slipwise.diagnose.screen import Screened
from slipwise.diagnose.worth import material, score

#: Share of the best explanation from which on another gauge's ties with it [1].
_TIE = 0.99


def various(found: Sequence[Screened], count: int) -> list[Screened]:
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
    good = [h for h in tried if material(origin.account, origin.account, h.account)]
    gains = [score(origin.account, h.account) for h in good]
    first = max(zip(gains, good, strict=True), key=lambda pair: pair[0], default=None)
    if first is None:
        return None
    ties = [h for gain, h in zip(gains, good, strict=True) if h.names == first[1].names and gain > _TIE * first[0]]
    return min(ties, key=_off_rated) if len(ties) > 1 else first[1]


def _off_rated(found: Hypothesis) -> float:
    """Give how far a hypothesis takes the girder's mass from its rated value [1]."""
    rated = found.problem.specimen.mass
    return abs(np.log(found.solution.values.get("rig.mass", rated) / rated))
