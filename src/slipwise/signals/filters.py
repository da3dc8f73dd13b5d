"""The logger's low-pass filter, described by what a laboratory knows of it, and applied to predictions alike."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.errors import SettingError, unknown_name
from slipwise.signals.ends import in_frequency

PHASES: tuple[str, ...] = ("zero", "causal", "aligned")


@dataclass(frozen=True)
class LowPass:
    """A Butterworth filter, as it acts before sampling.

    Attributes:
        frequency: where one pass lets 1/sqrt(2) through [Hz].
        order: of one pass.
        phase: "zero": forward and backward, so the gain counts twice and nothing is late; "causal": once, with its
            lag; "aligned": once, with the lag taken out again.
    """

    frequency: float
    order: int = 4
    phase: str = "zero"

    def __post_init__(self) -> None:
        """Refuse a filter that cannot be.

        Raises:
            SettingError: frequency or order out of bounds.
            UnknownNameError: no such phase.
        """
        if not 0.0 < self.frequency < np.inf:
            raise SettingError(f"a low-pass filter at {self.frequency:g} Hz cannot be; give a frequency above zero")
        if not 1 <= self.order <= 16:
            raise SettingError(f"a low-pass filter of order {self.order} cannot be; possible: 1 to 16")
        if self.phase not in PHASES:
            raise unknown_name("phase of a low-pass filter", self.phase, PHASES)

    @property
    def lag(self) -> float:
        """Delay of slow signals [s]: sum over the poles of 1 / (2 pi fc) * real part of -1/p."""
        if self.phase != "causal":
            return 0.0
        angles = np.pi * (2.0 * np.arange(1, self.order + 1) - 1.0) / (2.0 * self.order)
        return float(np.sum(np.sin(angles)) / (2.0 * np.pi * self.frequency))


def response(lowpass: LowPass, frequency: Array) -> NDArray[np.complex128]:
    """Return the filter's response H(f), (m,) complex.

    One pass: H = prod_k 1 / (1 - i f / (fc p_k)) with the Butterworth poles p_k = exp(i pi (2k + n - 1) / (2n)),
    so |H|^2 = 1 / (1 + (f/fc)^(2n)).

    Args:
        lowpass: the filter.
        frequency: (m,) [Hz].

    Source: Oppenheim, Schafer, Discrete-Time Signal Processing, Butterworth filters. The analogue form is meant:
        the filter acts before the sampling, so the bilinear transform's warping near half the rate would be wrong.
    """
    ratio = np.asarray(frequency, dtype=float) / lowpass.frequency
    gain = 1.0 / (1.0 + ratio ** (2 * lowpass.order))
    if lowpass.phase == "zero":
        return gain.astype(complex)
    if lowpass.phase == "aligned":
        return np.sqrt(gain).astype(complex)
    orders = np.arange(1, lowpass.order + 1)
    poles = np.exp(1j * np.pi * (2.0 * orders + lowpass.order - 1.0) / (2.0 * lowpass.order))
    return np.prod(1.0 / (1.0 - 1j * ratio[:, None] / poles[None, :]), axis=1)


def lowpass(values: Array, dt: float, by: LowPass | None) -> Array:
    """Filter a signal as the logger did; a signal that it did not filter comes back as it is.

    Args:
        values: (n,).
        dt: sampling step [s].
        by: the filter, or None.
    """
    if by is None:
        return values
    return in_frequency(values, dt, lambda f: _kept_response(by, len(f), float(f[1])), _memory(by, dt))


@lru_cache(maxsize=32)
def _kept_response(by: LowPass, count: int, step: float) -> NDArray[np.complex128]:
    """Return the response at multiples of a frequency [Hz]; many channels pass the same filter one after another."""
    return response(by, step * np.arange(count, dtype=np.float64))


def align(values: Array, dt: float, by: LowPass | None) -> tuple[Array, LowPass | None]:
    """Take a causal filter's lag out of a measured signal, by phase alone: amplitudes and noise stay.

    Args:
        values: (n,).
        dt: sampling step [s].
        by: the filter that the signal went through, or None.

    Returns:
        The signal (n,), and the filter that it now looks as if it had gone through.
    """
    if by is None or by.phase != "causal":
        return values, by
    return in_frequency(values, dt, lambda f: _without_lag(by, f), _memory(by, dt)), replace(by, phase="aligned")


def folded(by: LowPass, frequency: Array, rate: float) -> NDArray[np.complex128]:
    """Return what a causal filter leaves of each frequency in samples whose lag `align` has taken out, (m,) complex.

    What is faster than half the rate is seen at another frequency, and the lag of that one is taken out of it: of the
    turn of friction behind 150 Hz of second order, sampled at 500 Hz, that is more than the noise.

    Args:
        by: the filter, as `align` gives it.
        frequency: (m,) [Hz].
        rate: of the samples [Hz].
    """
    once = replace(by, phase="causal")
    return response(once, frequency) * _without_lag(once, frequency - rate * np.round(frequency / rate))


def _without_lag(by: LowPass, frequency: Array) -> NDArray[np.complex128]:
    return np.exp(-1j * np.angle(response(by, frequency)))


def _memory(by: LowPass, dt: float) -> int:
    """Samples after which the filter has forgotten: ten periods of its frequency, and some for a high order."""
    return int(np.ceil((10 + 2 * by.order) / (by.frequency * dt)))
