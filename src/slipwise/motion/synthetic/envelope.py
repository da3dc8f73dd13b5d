"""Motions that begin and end at rest: an envelope over the displacement, not over the acceleration.

With e(t) the envelope and u(t) the displacement of the unfading motion, the table goes d = e u, so that
a = e u'' + 2 e' u' + e'' u. Velocity and displacement end at zero because e and e' do, whatever u is. An envelope over
the acceleration alone would leave the table with a speed and drifting away.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array


@dataclass(frozen=True)
class Envelope:
    """Rise, hold and fall with its first two derivatives, each (n,) [1], [1/s], [1/s^2]."""

    value: Array
    slope: Array
    bend: Array


def _smooth_step(s: Array) -> tuple[Array, Array, Array]:
    """Rise from 0 to 1 with three derivatives zero at both ends; s in 0..1."""
    value = s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)
    slope = 140 * s**3 * (1 - s) ** 3
    bend = 420 * s**2 * (1 - s) ** 2 * (1 - 2 * s)
    return value, slope, bend


def envelope(time: Array, start: float, rise: float, hold: float, fall: float) -> Envelope:
    """Return an envelope that rises from `start` on, holds 1 and falls to zero, all [s]."""
    up = _smooth_step(np.clip((time - start) / rise, 0.0, 1.0))
    down = _smooth_step(np.clip((start + rise + hold + fall - time) / fall, 0.0, 1.0))
    # Rise and fall do not overlap: one of the two factors is 1 with zero derivatives.
    return Envelope(
        value=up[0] * down[0],
        slope=up[1] / rise - down[1] / fall,
        bend=up[2] / rise**2 + down[2] / fall**2,
    )


def enveloped(shape: Envelope, displacement: Array, velocity: Array, acceleration: Array) -> Array:
    """Return the acceleration (n,) of an unfading motion under an envelope [m/s^2]."""
    return shape.value * acceleration + 2 * shape.slope * velocity + shape.bend * displacement


def faded_sine(time: Array, shape: Envelope, frequency: float, amplitude: float, start: float) -> Array:
    """Return a sine of acceleration under an envelope.

    Args:
        time: (n,) [s].
        shape: the envelope.
        frequency: [Hz].
        amplitude: of the acceleration where the envelope is 1 [m/s^2].
        start: where its phase is zero [s].

    Returns:
        (n,) [m/s^2].
    """
    omega = 2 * np.pi * frequency
    phase = omega * (time - start)
    acceleration = amplitude * np.sin(phase)
    return enveloped(shape, -acceleration / omega**2, -amplitude / omega * np.cos(phase), acceleration)
