"""Accelerations of the levels of a structure, in the frequencies in which all of them stand above their noise.

Each frequency counts alike, whatever it carries: the levels of an isolated structure move as one at the period of the
isolation, where most of the motion is, and apart at those of the storeys, which tell one level from another.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array

#: Fewer samples than these show no spectrum.
FEWEST = 200
#: Part of a record at each of its ends that is faded [1].
_FADED = 0.05
#: Power is averaged over this part of the frequency to both sides [1], and at least over so many lines.
_WIDTH, _LINES = 0.15, 2
#: Noise is what the highest frequencies carry: those above this part of half the sampling rate [1].
_HIGHEST = 0.8
#: Power above noise from which a frequency counts [1], and what of all power lies below and above those that count [1].
_ABOVE, _BELOW, _BEYOND = 10.0, 0.02, 0.005
#: What is taken where noise hides all that is beside the strongest motion [1]; fewer lines than these show nothing.
_STRONGEST, _FEWEST_LINES = 0.98, 20


@dataclass(frozen=True, eq=False)
class LevelSpectra:
    """Spectra of accelerations in the frequencies that count.

    Attributes:
        values: (n, m) complex, each frequency divided by the root of the mean power of all signals there [1].
        turning: (m,) circular frequency [rad/s].
        samples: of the record.
        dt: step of the record [s].
    """

    values: NDArray[np.complex128]
    turning: Array
    samples: int
    dt: float

    @property
    def highest(self) -> float:
        """Highest frequency that counts [Hz]."""
        return float(self.turning[-1]) / (2.0 * np.pi)

    def signed(self, signs: Sequence[int]) -> "LevelSpectra":
        """Return them with some signals turned round; a sign of each, +1 or -1."""
        return replace(self, values=self.values * np.array(signs, dtype=np.float64)[:, None])

    def brought_forward(self, delays: Sequence[float]) -> "LevelSpectra":
        """Return them with each signal brought forward by its delay [s]."""
        return replace(self, values=self.values * np.exp(1j * np.outer(delays, self.turning)))


def level_spectra(accelerations: Array, dt: float) -> LevelSpectra | None:
    """Return the spectra of accelerations in the frequencies in which all of them show motion.

    Args:
        accelerations: (n, samples) [m/s^2], finite.
        dt: step [s].

    Returns:
        None where the record is too short, or an acceleration never moves.
    """
    if accelerations.shape[1] < FEWEST or np.any(np.ptp(accelerations, axis=1) == 0.0):
        return None
    every, frequency = spectrum(accelerations), np.fft.rfftfreq(accelerations.shape[1], dt)
    power = np.stack([averaged_power(one) for one in every])
    noise = np.array([noise_power(one) for one in power])
    below = np.cumsum((power / power.sum(axis=1, keepdims=True)).mean(axis=0))
    below /= below[-1]
    counts = (power > _ABOVE * noise[:, None]).all(axis=0) & (below > _BELOW) & (below < 1.0 - _BEYOND)
    if np.count_nonzero(counts) < _FEWEST_LINES:
        counts = (below > 1.0 - _STRONGEST) & (below < _STRONGEST)
    if np.count_nonzero(counts) < _FEWEST_LINES:
        return None
    weight = 1.0 / np.sqrt(power.mean(axis=0)[counts])
    turning = np.asarray(2.0 * np.pi * frequency[counts], dtype=np.float64)
    return LevelSpectra(every[:, counts] * weight, turning, accelerations.shape[1], dt)


def spectrum(signals: Array) -> NDArray[np.complex128]:
    """Return the spectra (n, m) of signals (n, samples) without their means, faded at their ends."""
    samples = signals.shape[-1]
    fade = max(1, round(_FADED * samples))
    window = np.ones(samples)
    window[:fade] = 0.5 - 0.5 * np.cos(np.pi * np.arange(fade) / fade)
    window[samples - fade :] = window[:fade][::-1]
    return np.fft.rfft((signals - signals.mean(axis=-1, keepdims=True)) * window, axis=-1)


def noise_power(power: Array) -> float:
    """Return what a spectrum of power (m,) ends in, which is noise where the logger is faster than the motion."""
    return float(np.median(power[int(_HIGHEST * len(power)) :]))


def averaged_power(values: NDArray[np.complex128]) -> Array:
    """Return the power (m,) of a spectrum averaged over its neighbours, the wider the higher the frequency."""
    power = np.abs(values) ** 2
    sums = np.concatenate([[0.0], np.cumsum(power)])
    line = np.arange(len(power))
    low = np.maximum((line * (1.0 - _WIDTH)).astype(int) - _LINES, 0)
    high = np.minimum((line * (1.0 + _WIDTH)).astype(int) + _LINES + 1, len(power))
    return (sums[high] - sums[low]) / (high - low)
