"""Rounding of samples: the steps in which a file has its values, and how often neighbours are equal by that alone."""

import numpy as np
from scipy.ndimage import minimum_filter1d, uniform_filter1d

from slipwise.arrays import Array

#: Steps are of one size within this; a size that more than this part of all steps have shows coarse rounding [1].
_LIKE, _COMMON = 0.02, 0.08
#: Samples over which noise is taken to be the same.
NEAR = 51
#: Values to either side, in order, in which the step is looked for: what is written with so many digits has a larger
#: one from the next power of ten on.
_NEIGHBOURS = 32


def is_coarse(values: Array) -> bool:
    """Return whether steps between neighbours come in few sizes, so that equal neighbours say nothing."""
    steps = np.abs(np.diff(values))
    steps = steps[steps > 0.0]
    if len(steps) < 0.2 * len(values):
        return True
    sizes = np.unique(np.round(np.log(steps) / _LIKE), return_counts=True)[1]
    return bool(sizes.max() > _COMMON * len(steps))


def estimate_chance_of_equal(values: Array) -> Array:
    """Return the probability that each sample equals the one before by rounding alone, (n,).

    Two samples that differ by a slope d and independent noise s fall into the same step q with about
    q / (2 sqrt(pi) s) exp(-d^2 / (4 s^2)). The step grows with the value where a file keeps a number of digits.
    """
    step = _rounding(values)
    third = np.zeros(len(values))
    third[2:-1] = np.diff(values, 3) ** 2 / 20.0
    noise = np.sqrt(np.maximum(uniform_filter1d(third, NEAR), 0.0))
    slope = np.zeros(len(values))
    slope[4:-3] = (values[7:] - values[:-7]) / 7.0
    noise = np.maximum(noise, step / np.sqrt(12.0))
    near = np.exp(-np.square(slope / np.maximum(2.0 * noise, 1e-300)))
    return np.minimum(step / np.maximum(2.0 * np.sqrt(np.pi) * noise, 1e-300) * near, 1.0)


def _rounding(values: Array) -> Array:
    """Return the rounding step at each sample (n,): the smallest difference between values of like size."""
    largest = float(np.abs(values).max())
    ordered, place = np.unique(values, return_inverse=True)
    gaps = np.diff(ordered)
    gaps[gaps <= 1e-9 * largest] = np.inf  # where a mean was subtracted, equal values differ in their last digits
    if not np.isfinite(gaps).any():
        return np.full(len(values), largest)
    nearest = minimum_filter1d(gaps, 2 * _NEIGHBOURS + 1, mode="nearest")
    steps = np.minimum(np.append(nearest, np.inf), np.append(np.inf, nearest))
    return np.minimum(steps, largest)[place]
