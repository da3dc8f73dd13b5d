"""How noisy is a channel: from the top of its spectrum, from differences, and from a quiet stretch.

A logger that adds white noise after its filter shows it at the top of the spectrum, where the filter leaves no signal.
Noise that went through the filter is missing there, and only a quiet stretch can show it: so both are looked at, and
where they disagree the larger one counts.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import periodogram

from slipwise.arrays import Array
from slipwise.signals.outliers import without_outliers

#: Part of the band below half the sampling rate that is taken as signal-free [1].
_TOP = (0.8, 0.98)
#: Standard deviations beyond which a value is none of the noise [1].
_ORDINARY = 6.0
#: Fewer quiet samples than this are no basis for a level.
_ENOUGH = 50


@dataclass(frozen=True)
class Noise:
    """Noise of one channel.

    Attributes:
        level: standard deviation of one sample, in the channel's unit.
        white: whether quiet stretch and top of the spectrum agree within a factor 1.3, so that neighbours are
            independent; None when there was no quiet stretch to compare.
        correlation: of neighbouring samples in the quiet stretch [1]; 0 where unknown.
        quantum: smallest step between different values, 0 when the channel is not quantised.
        basis: "quiet stretch", "top of the spectrum" or "differences".
    """

    level: float
    white: bool | None
    correlation: float
    quantum: float
    basis: str


def white_level(values: Array) -> float:
    """Return the standard deviation of white noise (one sample) from the top of the spectrum.

    The median of the periodogram over 0.8 to 0.98 of half the sampling rate, so that hum lines do not count; a single
    glitch is as strong at every frequency, and is bridged before.

    Args:
        values: (n,), n >= 32; fewer samples fall back to third differences.
    """
    finite = values[np.isfinite(values)]
    if len(finite) < 4:
        return 0.0
    if len(finite) < 128:
        # third differences: sum of squared binomials 1, 3, 3, 1 is 20 (Rice 1984, Gasser, Sroka, Jennen-Steinmetz 1986)
        return float(np.sqrt(np.mean(np.diff(finite, 3) ** 2) / 20.0))
    frequency, power = periodogram(without_outliers(finite), fs=2.0, window="hann", detrend="linear")
    top = power[(frequency > _TOP[0]) & (frequency < _TOP[1])]
    # one-sided density over a band of width 1; the median of an exponential variable is ln 2 times its mean
    return float(np.sqrt(np.median(top) / np.log(2.0)))


def difference_level(values: Array) -> float:
    """Return the standard deviation of white noise (one sample) from the usual size of third differences.

    sigma = median |d3| / (0.6745 sqrt(20)): a jump touches four differences and moves no median.

    Args:
        values: (n,); 0 for fewer than four.

    Source: Rice (1984), Annals of Statistics 12; sum of the squared binomials 1, 3, 3, 1: Gasser, Sroka,
    Jennen-Steinmetz (1986), Biometrika 73; median deviation: Hampel (1974).
    """
    finite = values[np.isfinite(values)]
    return float(np.median(np.abs(np.diff(finite, 3)))) / (0.6745 * np.sqrt(20.0)) if len(finite) >= 4 else 0.0


def ordinary(values: Array) -> NDArray[np.bool_]:
    """Tell which values (n,) scatter as most do: within six standard deviations that follow from the median deviation.

    Noise hardly ever goes beyond; where more than half of all values are equal, every one counts.
    """
    away = np.abs(values - np.median(values))
    usual = float(np.median(away)) / 0.6745
    return away <= _ORDINARY * usual if usual > 0.0 else np.ones(len(values), dtype=bool)


def quantum(values: Array) -> float:
    """Return the step of a quantised channel; 0 where values are as good as continuous."""
    levels, counts = np.unique(values[np.isfinite(values)][:20000], return_counts=True)
    steps = np.diff(levels)
    steps = steps[steps > 0.0]
    if len(steps) < 3:
        return 0.0
    # the smallest steps of text rounding or binary fractions scatter by rounding: take the median of the small ones
    smallest = float(np.median(steps[steps < 1.5 * steps.min()]))
    multiples = steps / smallest
    if counts.max() == 1 and multiples.max() < 1.5:
        return 0.0  # it rises evenly, as the slip of a pin on a disc: the steps are those of the motion
    share = np.mean(np.abs(multiples - np.round(multiples)) < 0.05)
    return smallest if share > 0.95 else 0.0


def noise(values: Array, quiet: NDArray[np.bool_] | None = None) -> Noise:
    """Estimate the noise of one channel.

    Args:
        values: (n,) of one run.
        quiet: (n,) samples during which nothing moved; None or fewer than 50 of them: not known.

    Source: docs/theory.md, section 3.1; quiet stretches are a lower bound where the table hums while it shakes.
    """
    top = white_level(values)
    step = quantum(values)
    if quiet is None or np.count_nonzero(quiet) < _ENOUGH:
        basis = "top of the spectrum" if len(values) >= 128 else "differences"
        return Noise(top, None, 0.0, step, basis)
    still = values[quiet]
    place = np.arange(len(still))
    line = np.polynomial.Polynomial.fit(place, still, 1)
    usual = ordinary(still - line(place))
    if not usual.all():
        still, place = still[usual], place[usual]
        line = np.polynomial.Polynomial.fit(place, still, 1)
    still = still - line(place)
    level = float(still.std(ddof=2))
    correlation = float(np.dot(still[1:], still[:-1]) / np.dot(still, still)) if level > 0.0 else 0.0
    white = bool(level < 1.3 * top) if top > 0.0 else level == 0.0
    return Noise(max(level, top), white, 0.0 if white else correlation, step, "quiet stretch")
