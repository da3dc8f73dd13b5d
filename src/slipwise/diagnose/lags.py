"""Lags of gauges at their full sizes: where much is amiss, a straight line from a small one lies."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from slipwise.diagnose.columns import residual_with
from slipwise.diagnose.shapes import strengths
from slipwise.fit.base import BaseFit
from slipwise.fit.terms import Term

Array = NDArray[np.float64]
#: Mean squared residual from which on every lag is tried so, and those that a straight line makes something of [1].
_MUCH_AMISS, _AMISS = 30.0, 3.0
#: Multiples of the typical lag that are tried, and how many more beside the best of them.
_LAGS, _CLOSER = (-4.0, -1.0, 1.0, 4.0), 6
#: Share of the squared residual that the best must explain to be looked at more closely [1].
_WORTH_A_LOOK = 0.02


def lag_at_its_size(
    base: BaseFit, term: Term, shape: Mapping[str, float], residual: Array, project: Callable[[Array], Array],
    *, hopeful: bool,
) -> tuple[dict[str, float], Array] | None:  # fmt: skip
    """Look for the lag of a gauge that explains most, base projected out.

    Args:
        base: the base fit.
        term: the candidate; one without a lag has none to look for.
        shape: its shape constants.
        residual: (m,) of the fitted runs, base projected out.
        project: the projection.
        hopeful: whether a straight line from a small lag explains anything worth a look.

    Returns:
        parameters and the residual (m,) with them, base not projected out; None where nothing helps.
    """
    lags = [p for p in strengths(term.effect) if p.unit == "s"] if term.effect.port == "gauge" else []
    whole = float(residual @ residual)
    if not lags or whole < (_AMISS if hopeful else _MUCH_AMISS) * len(residual):
        return None
    best: tuple[float, dict[str, float], Array] | None = None

    def left(lag: float, name: str) -> float:
        nonlocal best
        values = {**term.effect.neutral(), **shape, name: float(lag)}
        there = residual_with(base, term, values)
        if there is None:
            return np.inf
        clean = project(there)
        found = float(clean @ clean)
        if found < (best[0] if best else whole):
            best = found, values, there
        return found

    for p in lags:
        sizes = [size * p.typical for size in _LAGS if p.low <= size * p.typical <= p.high]
        found = {0.0: whole} | {size: left(size, p.name) for size in sizes}
        nearest = min(found, key=lambda size: found[size])
        if found[nearest] < (1.0 - _WORTH_A_LOOK) * whole:
            ends = sorted({*found, p.low, p.high})
            beside = (
                max((x for x in ends if x < nearest), default=p.low),
                min((x for x in ends if x > nearest), default=p.high),
            )
            minimize_scalar(left, bounds=beside, args=(p.name,), method="bounded", options={"maxiter": _CLOSER})
    return best[1:] if best else None
