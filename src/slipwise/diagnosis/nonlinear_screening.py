"""Candidates at their full size: where the residual is large, a straight line from a small size misleads."""

from collections.abc import Callable, Mapping

import numpy as np
from scipy.optimize import minimize_scalar

from slipwise.arrays import Array
from slipwise.diagnosis.initial_grid import strengths
from slipwise.diagnosis.row_subset import thinning
from slipwise.diagnosis.sensitivities import compute_residual_with, typical
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.params import Parameter
from slipwise.relations.parameters import Term

#: Mean squared residual from which on every candidate is tried at full size, and from which on only those are of which
#: the straight line promises a gain [1].
_LARGE_RESIDUAL, _MODERATE_RESIDUAL = 30.0, 3.0
#: Multiples of the typical size that are tried, and how many more beside the best of them.
_SIZES, _CLOSER = (-4.0, -1.0, 1.0, 4.0), {"maxiter": 6}
#: Least share of the squared residual that a candidate must explain to be tried at more sizes [1].
MIN_GAIN = 0.02


def at_full_size(
    base: BaseFit, term: Term, shape: Mapping[str, float], residual: Array, project: Callable[[Array], Array],
    *, adds_yaw: bool, promising: bool,
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
        adds_yaw: whether the girder's yaw is computed with the candidate, and is not without.
        promising: whether a straight line from a small size explains at least `MIN_GAIN`.

    Returns:
        parameters and the residual (m,) with them, base not projected out; None where nothing helps.
    """
    sizes, whole = _nonlinear_strengths(term.effect, shape, adds_yaw), float(residual @ residual)
    samples = thinning(base.objective) * len(residual)
    if not sizes or whole < (_MODERATE_RESIDUAL if promising else _LARGE_RESIDUAL) * samples:
        return None
    best: tuple[float, dict[str, float], Array] | None = None

    def left(size: float, name: str) -> float:
        nonlocal best
        values = {**term.effect.neutral(), **shape, name: float(size)}
        there = compute_residual_with(base, term, values)
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
        if found[nearest] < (1.0 - MIN_GAIN) * whole:
            ends = sorted({*found, p.low, p.high})
            below = max((x for x in ends if x < nearest), default=p.low)
            above = min((x for x in ends if x > nearest), default=p.high)
            minimize_scalar(left, bounds=(below, above), args=(p.name,), method="bounded", options=_CLOSER)
    return best[1:] if best else None


def _nonlinear_strengths(effect: Effect, shape: Mapping[str, float], adds_yaw: bool) -> list[Parameter]:
    """Return the strengths whose effect on the residual is far from a straight line."""
    if effect.port == "gauge":
        return [p for p in strengths(effect) if p.unit == "s"]
    return strengths(effect) if adds_yaw and not shape else []
