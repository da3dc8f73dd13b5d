"""What a candidate of some size changes in the residual of a fit."""

from collections.abc import Callable, Mapping

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import Effect
from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.objective import Objective
from slipwise.params import Parameter
from slipwise.relations.measurement import is_shifting
from slipwise.relations.parameters import Term
from slipwise.selection.initial_grid import strengths

#: Size at which a column is taken, as a share of the typical size.
_SMALL = 0.3


def small(effect: Effect, shape: Mapping[str, float], moved: Parameter) -> dict[str, float]:
    """Return an effect's values with one strength at a small size, the others absent."""
    values = {**effect.neutral(), **shape}
    off = float(moved.neutral or 0.0)
    values[moved.name] = float(np.clip(off + _SMALL * (typical(effect, moved) - off), moved.low, moved.high))
    return values


def typical(effect: Effect, moved: Parameter) -> float:
    """Return a typical size for a strength; for one that is usually absent that of its siblings of the same unit."""
    if moved.typical != float(moved.neutral or 0.0):
        return moved.typical
    for p in strengths(effect):
        if p.unit == moved.unit and p.typical != p.neutral:
            return p.typical
    return float(moved.neutral or 0.0) + 0.2 * (moved.high - float(moved.neutral or 0.0))


def compute_change(
    residual_with: Callable[[Mapping[str, float]], Array | None],
    term: Term,
    moved: Parameter,
    values: Mapping[str, float],
    left: Array,
) -> Array | None:
    """Return the change of a residual by one strength of a candidate; None where it cannot be evaluated.

    Undoing a lag moves noise in time, and half way between moved and unmoved noise there is less of it, as there is of
    noise that drives a table and is whitened: a column that looked one way only would find a false gain. Both ways
    together do not.

    Args:
        residual_with: gives the residual with the candidate at some values of its parameters.
        term: the candidate.
        moved: the strength.
        values: of its parameters, the strength at a small size.
        left: (m,) residual without the candidate.
    """
    there = residual_with(values)
    if there is None:
        return None
    off = float(moved.neutral or 0.0)
    back = 2.0 * off - values[moved.name]
    if (term.effect.port == "table" or is_shifting([term])) and moved.low <= back <= moved.high:
        other = residual_with({**values, moved.name: back})
        return None if other is None else 0.5 * (there - other)
    return there - left


def compute_stacked_with(base: BaseFit, term: Term, values: Mapping[str, float]) -> Array | None:
    """Return the residual (m,) of the fitted runs with a candidate at every sample; None where it has none.

    Args:
        base: the base fit.
        term: the candidate.
        values: of its parameters.
    """
    keyed = {f"{term.label}.{k}": v for k, v in values.items()}
    stacked = evaluate_stacked(base.objective.adding(term), {**base.solution.values, **keyed})
    return None if stacked is None else _finite(stacked)


def evaluate_stacked(objective: Objective, values: Mapping[str, float]) -> Array | None:
    """Return the stacked residual (m,) of the fitted runs; None where it cannot be evaluated."""
    try:
        return objective.residuals(values, fitted_only=True).stacked(objective.fitted)
    except SlipwiseError:
        return None


def _finite(stacked: Array) -> Array | None:
    return stacked if np.isfinite(stacked).all() else None
