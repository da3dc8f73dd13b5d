"""The zero of a slider's friction gauge: an actuator never releases the load, so no record shows it.

A girder's gauges are read at rest before the table moves. What a slider's gauge is off by is one number all the same:
midway between friction forth and friction back in every stretch of every run.
"""

from collections.abc import Sequence
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from slipwise.relations.parameters import ZERO, Free
from slipwise.relations.run_data import FitRun

Ints = NDArray[np.int64]

#: A zero is off by no more than this share of the usual force, and the same everywhere within as much [1].
_SHARE = 0.05
#: Parts of the way to either side in which friction forth and friction back are held against each other.
_PARTS = 5
#: Each way of sliding must have this share of a stretch [1].
_BOTH_WAYS = 0.1


def free_zero(runs: Sequence[FitRun]) -> Free | None:
    """Return the zero of a slider's friction gauge as a number to fit; None where the runs speak of no common one.

    Args:
        runs: of one slider, those that may be fitted.
    """
    middles = list(chain.from_iterable(_middles(run) for run in runs))
    most = compute_largest_zero(runs)
    if not np.isfinite(middles).all() or np.ptp(middles) > most:
        return None
    return Free(ZERO, float(np.clip(np.median(middles), -most, most)), -most, most, 0.1 * most, "N")


def compute_largest_zero(runs: Sequence[FitRun]) -> float:
    """Return by how much a slider's friction gauge may be off before that is a fault [N].

    Args:
        runs: of one slider.
    """
    return _SHARE * float(np.sqrt(np.mean(np.concatenate([run.force.ravel() for run in runs]) ** 2)))


def _middles(run: FitRun) -> list[float]:
    """Return the force midway between friction forth and back in each half of a run [N]; nan of one way only."""
    found = []
    for half in np.array_split(np.arange(len(run.time)), 2):
        forth = float(np.mean(run.velocity[half][run.sliding[half]] > 0.0)) if run.sliding[half].any() else 0.0
        both = min(forth, 1.0 - forth) > _BOTH_WAYS
        found.append(_middle(run, half) if both else np.nan)
    return found


def _middle(run: FitRun, part: Ints) -> float:
    """Return the force midway between friction forth and back in part of a run, at places as far to either side [N].

    What a spring, a wall or a curved face adds is alike forth and back, and opposite to either side; what a breakaway
    adds stands at the ends of the way.
    """
    slip, velocity, force = run.slip[part], run.velocity[part], run.force[part].mean(axis=1)
    low, high = float(slip.min()), float(slip.max())
    straddles = min(high, -low) > _BOTH_WAYS * (high - low)
    middle, reach = (0.0, min(high, -low)) if straddles else (0.5 * (low + high), 0.5 * (high - low))
    place = np.digitize(slip, middle + np.linspace(-reach, reach, 2 * _PARTS + 1)) - 1
    found = np.full((2, 2 * _PARTS), np.nan)
    for way, sign in enumerate((1.0, -1.0)):
        for k in range(2 * _PARTS):
            here = force[run.sliding[part] & (place == k) & (sign * velocity > 0.0)]
            if len(here):
                found[way, k] = np.median(here)
    by_place = found.mean(axis=0)
    pairs = 0.5 * (by_place + by_place[::-1])[:_PARTS]
    return float(np.nanmedian(pairs)) if np.isfinite(pairs).any() else np.nan
