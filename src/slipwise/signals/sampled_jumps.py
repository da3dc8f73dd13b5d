"""Jumps that a record shows from one sample to the next, where nothing had smoothed them before they were sampled."""

import numpy as np

from slipwise.arrays import Array

#: Variance of a jump that noise alone shows over that of a sample: 1/2, 3/2, 3/2 and 1/2 of four, squared.
_OF_NOISE = 5.0


def squared_jumps(values: Array, noise: float) -> Array:
    """Return the square of each change from one sample to the next beyond what those beside it would have it (n - 1,).

    Args:
        values: (n,) of a channel.
        noise: standard deviation of a sample; what it shows by itself is taken out.
    """
    change = np.diff(values)
    beside = change.copy()
    beside[1:-1] = 0.5 * (change[:-2] + change[2:])
    return np.maximum((change - beside) ** 2 - _OF_NOISE * noise**2, 0.0)
