"""Derivative and integral of a sampled signal, by the cubic spline through its samples.

At a fifth of the sampling rate the spline's integral errs by 1 %, the trapezoidal rule by 14 %.
"""

import numpy as np

from slipwise.signals.ends import Array
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


def integral(values: Array, dt: float) -> Array:
    """Return the integral from the first sample to each sample (n,)."""
    from scipy.interpolate import CubicSpline

    time = dt * np.arange(len(values))
    return CubicSpline(time, values).antiderivative()(time)
