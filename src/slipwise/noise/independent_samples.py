"""How many independent samples a series holds: its samples over the sum of their correlation over all lags.

    n_eff = n / S,    S = 1 + 2 (rho_1 + ... + rho_K),    K the first lag with K >= 5 S/2

The variance of a mean of n samples is that of n_eff independent ones: white noise has S = 1, first-order noise
(1 + rho)/(1 - rho), and a record that is sampled k times finer, which tells nothing new, k times the S of before. One
definition for leads, intervals, blocks of time and cells of a comparison.

Source: Bayley, Hammersley (1946), Journal of the Royal Statistical Society Supplement 8:184-197 (the sum); Sokal
(1997), Monte Carlo Methods in Statistical Mechanics, section 3 (the window: longer sums add noise only).
"""

from collections.abc import Sequence

import numpy as np

from slipwise.arrays import Array

#: Lags over which the correlation is summed, in integrated correlation times S/2 (Sokal) [1].
_WINDOW = 5.0
#: Correlations below this many of their own errors, 1/sqrt(n), are none [1]. The longest lag that is looked at in a
#: rest: what drifts for longer is no noise of a gauge.
_SURE, _FEW_LAGS = 3.0, 12
#: Blocks of time are so many correlation times long: what reaches over their ends is then 5 % of their variance [1].
_BLOCK = 10.0
#: Shortest block of time on a rig of ordinary size, see `campaign.scales` [s]: what a model lacks comes back with every
#: cycle of the motion, smaller than the noise, so that no correlation of samples shows it.
SHORTEST_BLOCK = 0.5


def sum_correlations(parts: Sequence[Array]) -> float:
    """Return S, the samples of a series for one independent one [1]; 1 for white noise, and where nothing is known.

    Args:
        parts: (n,) or (n, p) stretches of zero mean, columns side by side in time; exactly zero where not to be judged.
    """
    correlation = _correlate(parts)
    sums = 2.0 * np.cumsum(correlation) - 1.0
    enough = np.flatnonzero(np.arange(len(sums)) >= 0.5 * _WINDOW * sums)
    return max(float(sums[enough[0] if len(enough) else -1]), 1.0)


def sum_sure_correlations(parts: Sequence[Array]) -> float:
    """Return S of a few hundred samples: over the lags before the first whose correlation is not surely above zero.

    The window of `sum_correlations` takes in three lags of white noise, whose errors are a fifth of S with 300 samples.

    Args:
        parts: as of `sum_correlations`.
    """
    count = sum(int(np.count_nonzero(part)) for part in parts)
    few = _correlate(parts)[1 : _FEW_LAGS + 1]
    unsure = np.flatnonzero(few < _SURE / np.sqrt(max(count, 1)))
    return 1.0 + 2.0 * float(np.sum(few[: unsure[0]] if len(unsure) else few))


def _correlate(parts: Sequence[Array]) -> Array:
    """Return the correlation of samples k apart, (k,), 1 at k = 0; of nothing but zeros that of white noise."""
    memory, count = np.zeros(1), np.zeros(1)
    for part in parts:
        wide = part if part.ndim == 2 else part[:, None]
        rows, size = len(wide), 2 * len(wide)
        longest = max(len(memory), rows)
        memory = np.pad(memory, (0, longest - len(memory)))
        count = np.pad(count, (0, longest - len(count)))
        memory[:rows] += _products(wide, size)[:rows]
        count[:rows] += _products((wide != 0.0).astype(float), size)[:rows]
    covariance = memory / np.maximum(count, 1.0)
    return covariance / covariance[0] if covariance[0] > 0.0 else np.ones(1)


def measure_block_length(parts: Sequence[Array]) -> int:
    """Return the samples of a block of time so long that blocks of a series are as good as independent.

    Args:
        parts: as of `sum_correlations`.
    """
    return int(np.ceil(_BLOCK * sum_correlations(parts)))


def _products(wide: Array, size: int) -> Array:
    """Return the sums of products of samples k apart, (size,), over all columns."""
    power = np.abs(np.fft.rfft(wide, size, axis=0)) ** 2
    return np.fft.irfft(power, size, axis=0).sum(axis=1)
