"""Acceleration of a displacement: differentiated twice, without what its last digit makes of high frequencies."""

from slipwise.arrays import Array
from slipwise.signals.derivative import derivative
from slipwise.signals.filters import LowPass

#: Tables follow their commands to about here [Hz]; samples tell less: this share of their rate.
_HIGHEST, _SHARE = 40.0, 0.2


def second_derivative(displacement: Array, dt: float) -> tuple[Array, float]:
    """Return the acceleration of a displacement.

    Args:
        displacement: (n,) [m].
        dt: step [s].

    Returns:
        The acceleration (n,) [m/s^2] of what a low-pass filter without lag leaves, and the filter's frequency [Hz].
    """
    frequency = min(_HIGHEST, _SHARE / dt)
    smoothed = LowPass(frequency, 4, "aligned")
    return derivative(derivative(displacement, dt, smoothed), dt), frequency
