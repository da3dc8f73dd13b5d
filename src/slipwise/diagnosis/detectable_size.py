"""How small an effect may be and still be seen: the least size that this campaign would have shown."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.initial_grid import strengths
from slipwise.diagnosis.row_subset import rows_of
from slipwise.diagnosis.screening import Screened
from slipwise.evidence.acceptance import compute_least_drop


def estimate_least_sizes(screened: Sequence[Screened], base: Hypothesis) -> dict[str, tuple[float, str]]:
    """Return for every effect the smallest size that would have been material, by its column: size and unit.

    Args:
        screened: candidates; of an effect on many gauges the smallest counts.
        base: the base model as a hypothesis.
    """
    out: dict[str, tuple[float, str]] = {}
    for candidate in screened:
        found = _least(candidate, base)
        old = out.get(candidate.term.effect.name)
        if found is not None and (old is None or found[0] < old[0]):
            out[candidate.term.effect.name] = found
    return dict(sorted(out.items()))


def _least(found: Screened, base: Hypothesis) -> tuple[float, str] | None:
    """Scale the strength that moved most until some relation's mean squared residual would fall by what is material."""
    away = {
        p: abs(found.values[p.name] - float(p.neutral or 0.0)) / (abs(p.typical - float(p.neutral or 0.0)) or 1.0)
        for p in strengths(found.term.effect)
    }
    leading = max(away, key=lambda p: away[p], default=None)
    if leading is None or away[leading] == 0.0 or found.length <= 0.0:
        return None
    size = abs(found.values[leading.name] - float(leading.neutral or 0.0))
    step = (found.length * found.column.astype(np.float64)) ** 2
    rows = rows_of(base.objective)
    drops = np.add.reduceat(step, np.concatenate([[0], np.cumsum([*rows.values()])[:-1]]))
    counts = np.array([base.summary.counts[r][0] for r in rows])
    return float(size * np.sqrt(compute_least_drop([found.term]) / np.max(drops / np.maximum(counts, 1)))), leading.unit
