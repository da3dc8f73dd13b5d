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
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: Lags over which the correlation is summed, in integrated correlation times S/2 (Sokal) [1].
_WINDOW = 5.0
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
    memory, count = np.zeros(1), np.zeros(1)
    for part in parts:
        wide = part if part.ndim == 2 else part[:, None]
        rows, size = len(wide), 2 * len(wide)
        longest = max(len(memory), rows)
        memory = np.pad(memory, (0, longest - len(memory)))
        count = np.pad(count, (0, longest - len(count)))
        memory[:rows] += _products(wide, size)[:rows]
        count[:rows] += _products((wide != 0.0).astype(float), size)[:rows]
    correlation = memory / np.maximum(count, 1.0)
    if correlation[0] <= 0.0:
        return 1.0
    sums = 2.0 * np.cumsum(correlation) / correlation[0] - 1.0
    enough = np.flatnonzero(np.arange(len(sums)) >= 0.5 * _WINDOW * sums)
    return max(float(sums[enough[0] if len(enough) else -1]), 1.0)


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
