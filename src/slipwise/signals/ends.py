"""Carry a signal on beyond its ends, so that work in the frequency domain does not wrap one end into the other."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.errors import InputError


def carried_on(values: Array, beyond: int) -> Array:
    """Carry a signal on at both ends by its point reflection, which keeps value and slope.

    Args:
        values: (n,).
        beyond: samples to add at each end; at most n - 1 are added.

    Returns:
        (n + 2 min(beyond, n - 1),).
    """
    count = min(beyond, len(values) - 1)
    before = 2.0 * values[0] - values[count:0:-1]
    after = 2.0 * values[-1] - values[-2 : -count - 2 : -1]
    return np.concatenate([before, values, after])


def in_frequency(values: Array, dt: float, gain: Callable[[Array], NDArray[Any]], beyond: int, finer: int = 1) -> Array:
    """Multiply a signal's spectrum.

    Args:
        values: (n,) without NaN.
        dt: sampling step [s].
        gain: function of frequency (m,) [Hz] that gives the factor (m,), complex or real.
        beyond: samples by which the ends are carried on.
        finer: samples to give for each one given.

    Returns:
        (finer n,), dt / finer apart.

    Raises:
        InputError: a value is missing; a spectrum needs every sample.
    """
    missing = int(np.count_nonzero(~np.isfinite(values)))
    if missing:
        raise InputError(f"{missing} samples are missing; a filter needs every one of them: fill or cut them first")
    if len(values) < 2:
        return np.repeat(values, finer)
    long = carried_on(values, beyond)
    start = (len(long) - len(values)) // 2
    # A smooth way back from the last value to the first, where nobody looks: a jump there would ring into the ends.
    # A multiple of 256 has a fast transform.
    size = -(-(len(long) + max(2 * beyond, 16)) // 256) * 256
    circle = np.concatenate([long, long[-1] + (long[0] - long[-1]) * _way(size - len(long))])
    spectrum = np.fft.rfft(circle) * gain(_frequencies(size, dt))
    if finer > 1:
        spectrum *= finer
        spectrum[-1] *= 0.5  # half the sampling rate is no longer the end, and counts at both signs
    return np.fft.irfft(spectrum, finer * size)[finer * start : finer * (start + len(values))]


@lru_cache(maxsize=64)
def _way(count: int) -> Array:
    """Go smoothly from 0 to 1 in so many samples; read only, for all who ask."""
    way = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
    way.flags.writeable = False
    return way


@lru_cache(maxsize=64)
def _frequencies(size: int, dt: float) -> Array:
    """Return the frequencies of a real transform [Hz]; read only, for all who ask."""
    found = np.asarray(np.fft.rfftfreq(size, dt), dtype=np.float64)
    found.flags.writeable = False
    return found
