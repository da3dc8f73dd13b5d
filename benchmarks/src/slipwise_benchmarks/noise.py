"""Noise of a laboratory: coloured, with a hum of the mains, in the steps of a converter."""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]
_BEGIN = 50  # samples in which the correlated noise forgets its start


def coloured(count: int, correlation: float, pink: float, rng: np.random.Generator) -> Array:
    """Give noise (count,) of variance 1: first-order autoregressive, a share of its variance replaced by 1/f.

    Args:
        count: of samples.
        correlation: of a sample with the one before [1].
        pink: share of the variance whose spectrum falls as 1/f [1].
        rng: generator.
    """
    white = rng.normal(size=count + _BEGIN)
    noise = np.asarray(lfilter([np.sqrt(1.0 - correlation**2)], [1.0, -correlation], white))[_BEGIN:]
    return noise if pink == 0.0 else np.sqrt(1.0 - pink) * noise + np.sqrt(pink) * one_over_f(count, rng)


def one_over_f(count: int, rng: np.random.Generator) -> Array:
    """Give noise (count,) of mean 0 and variance 1 on average whose power spectrum goes as 1/f."""
    frequency = np.fft.rfftfreq(count)
    height = np.zeros(frequency.size)
    height[1:] = frequency[1:] ** -0.5
    height *= 0.5 * count / np.sqrt((height**2).sum())
    phases = rng.normal(size=(2, frequency.size))
    return np.fft.irfft(height * (phases[0] + 1j * phases[1]), count)


def hum(count: int, turns: float, rng: np.random.Generator) -> Array:
    """Give the mains (count,) with amplitude 1; `turns`: its cycles in one sample."""
    return np.sin(2.0 * np.pi * turns * np.arange(count) + rng.uniform(0.0, 2.0 * np.pi))


def converter_step(reach: float, bits: int) -> float:
    """Give the step of a converter that reaches to +-`reach`, in its unit."""
    return 2.0 * reach / 2.0**bits


def quantised(signal: Array, reach: float, bits: int) -> Array:
    """Round a signal (n,) to the steps of a converter; beyond +-`reach` it stays at the rail."""
    step = converter_step(reach, bits)
    return np.clip(step * np.round(signal / step), -reach, reach - step)


def full_scale(largest: float) -> float:
    """Give the range of 1, 2 or 5 times a power of ten that a laboratory would choose for a gauge."""
    wanted = 1.3 * largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(next(part * decade for part in (1.0, 2.0, 5.0, 10.0) if part * decade >= wanted))
