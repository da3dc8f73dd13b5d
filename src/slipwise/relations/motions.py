"""Which runs are of one motion: they are left out together, and what a model lacks in them counts once.

Runs whose table moved alike along x share the history of slip, and with it the errors of a model: the second is no
independent evidence, whatever its role says. The record along x decides; what the table does upwards or across changes
loads, not the path along which the pads slide.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from slipwise.relations.run_data import FitRun

#: Motions are the same where their difference is below this share of the motion, besides the noise of the gauge [1].
_SAME, _NOISE = 0.1, 2.0
#: Steps of time that differ by less than this share of themselves are one step, by clocks that run a little apart [1].
_SAME_STEP = 1e-3
#: Samples that tell a motion from another; every hypothesis asks.
_ENOUGH = 500


def is_same_motion(one: FitRun, other: FitRun) -> bool:
    """Return whether two runs are of one motion: of the table along x, or of the slip where that is prescribed.

    They have as many samples at the same step of time: a path that is gone through again more slowly is another motion.
    """
    name = next((n for n in ("table_ax", "slip_x") if n in one.record and n in other.record), "")
    if not name or len(one.record) != len(other.record) or abs(one.dt - other.dt) > _SAME_STEP * one.dt:
        return False
    every = slice(None, None, max(1, len(one.record) // _ENOUGH))
    first, second = one.record[name][every], other.record[name][every]
    apart = float(np.sqrt(np.mean((first - second) ** 2)))
    return apart < _SAME * float(np.std(first)) + _NOISE * one.noise[name]


def group_by_motion(runs: Sequence[FitRun], places: Iterable[int]) -> list[list[int]]:
    """Return the places of runs by motion, in the order in which each motion came first.

    A run of role repeat that is like none before it belongs to the last one that is as long, or to the last at all: it
    may have been cut a little differently.

    Args:
        runs: of the campaign.
        places: those that are asked for.
    """
    out: list[list[int]] = []
    for i in places:
        run = runs[i]
        same = next((group for group in out if is_same_motion(runs[group[0]], run)), None)
        if same is None and run.role == "repeat" and out:
            same = ([g for g in out if len(runs[g[0]].time) == len(run.time)] or out)[-1]
        if same is None:
            out.append([i])
        else:
            same.append(i)
    return out
