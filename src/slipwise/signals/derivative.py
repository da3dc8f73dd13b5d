"""Derivative of a sampled signal, by the cubic spline through its samples."""

import numpy as np

from slipwise.arrays import Array
from slipwise.signals.filters import LowPass, lowpass


def derivative(values: Array, dt: float, smoothed_by: LowPass | None = None) -> Array:
    """Return dx/dt (n,).

    Args:
        values: (n,) uniformly sampled.
        dt: sampling step [s].
        smoothed_by: a filter against noise, which a derivative raises in proportion to frequency.
    """
    from scipy.interpolate import CubicSpline  # here, for it takes long to load and a replay does without

    smooth = lowpass(values, dt, smoothed_by)
    return CubicSpline(dt * np.arange(len(smooth)), smooth)(dt * np.arange(len(smooth)), 1)
