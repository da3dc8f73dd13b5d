"""The zero of a slider's friction gauge: an actuator never releases the load, so no record shows it.

A girder's gauges are read at rest before the table moves. What a slider's gauge is off by is one number all the same:
midway between friction forth and friction back in every stretch of every run.
"""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from slipwise.relations.parameters import ZERO, Free
from slipwise.relations.run_data import FitRun

#: A zero is off by no more than this share of the usual force, and the same everywhere within as much [1].
_SHARE = 0.05
#: Quantiles of a force that are friction forth and back: where it reverses it is neither [1].
_ENDS = (0.05, 0.95)
#: Each way of sliding must have this share of a stretch [1].
_BOTH_WAYS = 0.1


def free_zero(runs: Sequence[FitRun]) -> Free | None:
    """Return the zero of a slider's friction gauge as a number to fit; None where the runs speak of no common one.

    Args:
        runs: of one slider, those that may be fitted.
    """
    middles = list(chain.from_iterable(_middles(run) for run in runs))
    usual = float(np.sqrt(np.mean(np.concatenate([run.force.ravel() for run in runs]) ** 2)))
    most = _SHARE * usual
    if not np.isfinite(middles).all() or np.ptp(middles) > most:
        return None
    return Free(ZERO, 0.0, -most, most, 0.1 * most, "N")


def _middles(run: FitRun) -> list[float]:
    """Return force midway between friction forth and back in each half of a run [N]; nan where it slides one way."""
    found = []
    for half in np.array_split(np.arange(len(run.time)), 2):
        forth = float(np.mean(run.velocity[half][run.sliding[half]] > 0.0)) if run.sliding[half].any() else 0.0
        both = min(forth, 1.0 - forth) > _BOTH_WAYS
        found.append(float(np.mean(np.quantile(run.force[half], _ENDS))) if both else np.nan)
    return found
