"""How many samples stand for one independent one: the sum of a series' correlation over all lags.

    n / n_eff = 1 + 2 sum rho_k,        k up to the first lag at which rho has died away

The variance of a mean of n samples is var n_eff^-1. One definition for the floor's noise and for the cells of a
comparison; parameter intervals need none, they count independent blocks of time.

Source: Bayley & Hammersley (1946), Journal of the Royal Statistical Society Supplement 8:184-197; the sum is cut where
its terms are noise, Geyer (1992), Statistical Science 7:473-483.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: A correlation below this has died away [1].
_GONE = 0.02


def correlation_sum(parts: Sequence[Array]) -> float:
    """Return the samples of a series for one independent one [1]; 1 for white noise, and where nothing is known.

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
    correlation = correlation / correlation[0]
    gone = np.flatnonzero(correlation < _GONE)
    return 1.0 + 2.0 * float(correlation[1 : int(gone[0]) if len(gone) else len(correlation)].sum())


def _products(wide: Array, size: int) -> Array:
    """Return the sums of products of samples k apart, (size,), over all columns."""
    power = np.abs(np.fft.rfft(wide, size, axis=0)) ** 2
    return np.fft.irfft(power, size, axis=0).sum(axis=1)
