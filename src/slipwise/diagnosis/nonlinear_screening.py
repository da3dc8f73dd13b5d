"""Candidates at their full size: where much is wrong, a straight line from a small one lies."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from slipwise.diagnosis.sensitivities import residual_with, typical
from slipwise.diagnosis.starting_grid import strengths
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.parameters import Term
from slipwise.params import Parameter

Array = NDArray[np.float64]
#: Mean squared residual from which on all of them are tried so, and those that a straight line makes something of [1].
_MUCH_AMISS, _AMISS = 30.0, 3.0
#: Multiples of the typical size that are tried, and how many more beside the best of them.
_SIZES, _CLOSER = (-4.0, -1.0, 1.0, 4.0), {"maxiter": 6}
#: Share of the squared residual that a candidate must explain to be looked at more closely [1].
WORTH_A_LOOK = 0.02


def at_full_size(
    base: BaseFit, term: Term, shape: Mapping[str, float], residual: Array, project: Callable[[Array], Array],
    *, turns: bool, promising: bool,
) -> tuple[dict[str, float], Array] | None:  # fmt: skip
    """Look for the size at which a gauge's lag, or what turns the girder, explains most, base projected out.

    A gauge that lags by a third of a period, and a girder that friction holds until its buffers are unlike enough, do
    little or the opposite when they are small.

    Args:
        base: the base fit.
        term: the candidate; of another kind it has nothing to look for.
        shape: its shape constants.
        residual: (m,) of the fitted runs, base projected out.
        project: the projection.
        turns: whether the girder turns with the candidate, and does not without.
        promising: whether a straight line from a small size explains anything worth a look.

    Returns:
        parameters and the residual (m,) with them, base not projected out; None where nothing helps.
    """
    sizes, whole = _crooked(term.effect, shape, turns), float(residual @ residual)
    if not sizes or whole < (_AMISS if promising else _MUCH_AMISS) * len(residual):
        return None
    best: tuple[float, dict[str, float], Array] | None = None

    def left(size: float, name: str) -> float:
        nonlocal best
        values = {**term.effect.neutral(), **shape, name: float(size)}
        there = residual_with(base, term, values)
        if there is None:
            return np.inf
        clean = project(there)
        found = float(clean @ clean)
        if found < (best[0] if best else whole):
            best = found, values, there
        return found

    for p in sizes:
        one = typical(term.effect, p)
        found = {0.0: whole} | {x * one: left(x * one, p.name) for x in _SIZES if p.low <= x * one <= p.high}
        nearest = min(found, key=lambda x: found[x])
        if found[nearest] < (1.0 - WORTH_A_LOOK) * whole:
            ends = sorted({*found, p.low, p.high})
            below = max((x for x in ends if x < nearest), default=p.low)
            above = min((x for x in ends if x > nearest), default=p.high)
            minimize_scalar(left, bounds=(below, above), args=(p.name,), method="bounded", options=_CLOSER)
    return best[1:] if best else None


def _crooked(effect: Effect, shape: Mapping[str, float], turns: bool) -> list[Parameter]:
    """Give the strengths of which a straight line from a small size may say nothing."""
    if effect.port == "gauge":
        return [p for p in strengths(effect) if p.unit == "s"]
    return strengths(effect) if turns and not shape else []
