"""A channel with a filter of its own taken out again, as far as its noise bears it, and what becomes of that noise."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun, smooth_record
from slipwise.signals.ends import in_frequency

#: Frequencies (m,) [Hz] and the factors (m,) by which the power of noise is raised there [1].
Spectrum = tuple[Array, Array]
#: A filter is taken out as far as it weakened a channel by no more than this [1].
_SHARPEST = 3.0


def without_filter(values: Array, pulse: Array, run: FitRun) -> Array:
    """Take out of a channel what made a pulse in the middle of a record look so; noise above the logger's band stays.

    What came out weaker than a third stays as weak as that would be: its noise would be all there is.

    Args:
        values: (n,) of the channel.
        pulse: (n,) what the filter makes of a pulse.
        run: its step, and its logger's filter.
    """
    middle = len(pulse) // 2
    passed, grid = np.fft.rfft(np.roll(pulse, -middle)), np.fft.rfftfreq(len(pulse), run.dt)

    def inverse(f: Array) -> NDArray[np.complex128]:
        here = np.asarray(np.interp(f, grid, passed.real) + 1j * np.interp(f, grid, passed.imag), dtype=np.complex128)
        size = np.maximum(np.abs(here), 1e-12)
        return np.asarray(np.minimum(1.0 / size, _SHARPEST) * np.conj(here) / size, dtype=np.complex128)

    smooth = smooth_record(values, run)
    return values + in_frequency(smooth, run.dt, inverse, min(middle, 256)) - smooth


def remove_filter_from_spectrum(pulse: Array, run: FitRun) -> Spectrum:
    """Tell by how much `without_filter` raises the power of white noise."""
    impulse = np.zeros(len(pulse))
    impulse[len(impulse) // 2] = 1.0
    power = np.abs(np.fft.rfft(without_filter(impulse, pulse, run))) ** 2
    return np.asarray(np.fft.rfftfreq(len(pulse), run.dt), dtype=np.float64), np.asarray(power, dtype=np.float64)


def whiten_again(left: Array, run: FitRun, raised: Mapping[str, Spectrum], shares: Mapping[str, float]) -> Array:
    """Bring a residual (n,) to white noise again.

    Args:
        left: the residual.
        run: its times.
        raised: channel -> by how much the power of its noise was raised.
        shares: channel -> its share in the variance of the residual's noise before that [1].
    """
    here = [(raised[name], shares[name]) for name in shares if name in raised]
    if not here:
        return left

    def white(f: Array) -> Array:
        return 1.0 / np.sqrt(1.0 + sum(share * (np.interp(f, *factor) - 1.0) for factor, share in here))

    return in_frequency(left, run.dt, white, 256)
