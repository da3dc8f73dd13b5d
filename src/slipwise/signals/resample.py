"""Put a signal on a uniform time axis."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from slipwise.arrays import Array

#: Steps that differ by less than this are uniform [1].
_UNIFORM = 0.01
#: A clock that is only written coarsely stays this close to a straight line, in steps.
_ROUNDED = 0.75
#: A step longer than this many median steps is a gap.
_GAP = 1.6
#: So many long steps that differ by less than this share are no gaps: there the logger was set to a slower rate [1].
_STEADY, _SAME_STEP = 8, 0.05


@dataclass(frozen=True)
class UniformTime:
    """A uniform time axis for samples that may not have been quite so.

    Attributes:
        time: (m,) uniform [s].
        measured: (m,) False where the samples have a gap, and between the samples of a slower rate.
        moved: whether values must be interpolated to it; if not, sample i stays sample i.
    """

    time: Array
    measured: NDArray[np.bool_]
    moved: bool


def uniform_time(time: Array) -> UniformTime:
    """Find the uniform axis behind sampling times.

    Times that are only rounded (10, 20, 31, 41 ms) are put on their straight line; times with gaps or with a rate that
    changes get a new axis at the median step.

    Args:
        time: (n,) strictly rising [s].
    """
    steps = np.diff(time)
    dt = float(np.median(steps))
    everywhere = np.ones(len(time), dtype=bool)
    if len(steps) == 0 or np.max(np.abs(steps - dt)) <= _UNIFORM * dt:
        return UniformTime(time, everywhere, moved=False)
    line = np.polynomial.Polynomial.fit(np.arange(len(time)), time, 1)(np.arange(len(time)))
    if np.max(np.abs(line - time)) < _ROUNDED * dt:
        return UniformTime(np.asarray(line), everywhere, moved=False)
    # rounding must not lose the last sample
    count = int(np.floor((time[-1] - time[0]) / dt + 1e-6)) + 1
    new = time[0] + dt * np.arange(count)
    after = np.clip(np.searchsorted(time, new, side="right"), 1, len(time) - 1)
    measured = steps[after - 1] <= _GAP * dt
    slower = slower_rate(steps, dt)
    taken = np.searchsorted(new, time[np.concatenate([slower, slower[-1:]])] - 0.5 * dt)
    measured[taken[taken < count]] = True
    return UniformTime(new, measured, moved=True)


def slower_rate(steps: Array, dt: float) -> NDArray[np.bool_]:
    """Tell which steps (n,) are those of a logger that was set to a slower rate for a while.

    Args:
        steps: between samples (n,) [s].
        dt: the usual step [s].
    """
    same = np.abs(np.diff(steps, prepend=0.0)) <= _SAME_STEP * steps
    length = np.zeros(len(steps), dtype=int)
    edges = np.flatnonzero(np.concatenate([[True], ~same[1:], [True]]))
    for start, end in zip(edges[:-1], edges[1:], strict=True):
        length[start:end] = end - start
    return (length >= _STEADY) & (steps > _GAP * dt)


def resampled(time: Array, values: Array, new_time: Array) -> Array:
    """Return values at new times by a cubic spline, constant beyond the ends.

    Args:
        time: (n,) strictly rising [s].
        values: (n,).
        new_time: (m,) [s].
    """
    return CubicSpline(time, values)(np.clip(new_time, time[0], time[-1]))
