"""Which held-out runs can confirm what was found: those whose loads, speeds and strokes some fitted run has reached.

A law that was fitted to small and slow motion says nothing of a large and fast one; where such a run disagrees it is
the law's range that ends, and where it agrees that may be luck.
"""

from collections.abc import Callable

import numpy as np

from slipwise.estimation.objective import Objective
from slipwise.relations.run_data import FitRun

#: A held-out run may go beyond the fitted ones by this factor [1]: laws are smooth, and no test repeats another.
_BEYOND = 1.5
#: Share of the samples that reach the largest value of a run [1]: single peaks are no regime.
_REACHED = 0.995
#: What makes a regime -> how large it is in a run, its unit and how many of that are one SI unit.
_REGIMES: dict[str, tuple[Callable[[FitRun], float], str, float]] = {
    "loads": (lambda run: float(np.quantile(run.load, _REACHED)), "kN", 1e-3),
    "speeds": (lambda run: float(np.quantile(np.abs(run.velocity), _REACHED)), "mm/s", 1e3),
    "strokes": (lambda run: float(np.ptp(run.slip)), "mm", 1e3),
}


def find_untestable_reason(objective: Objective) -> dict[int, str]:
    """Return the held-out runs that no fitted run covers: place of the run -> why, in words."""
    out: dict[int, str] = {}
    for i in objective.held_out:
        reasons = []
        for name, (size, unit, factor) in _REGIMES.items():
            here, most = size(objective.run(i)), max(map(size, objective.fitted_runs))
            if here > _BEYOND * most:
                reasons.append(
                    f"{name} reach {here * factor:.3g} {unit}, in the fitted runs {most * factor:.3g} {unit}"
                )
        if reasons:
            out[i] = "; ".join(reasons)
    return out
