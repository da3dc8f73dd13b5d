"""Samples that are left out of estimates: too small a glitch to be named, but it would move a noise level or a lag.

A mean square or a correlation follows one sample in ten thousand that is large enough. So what stands out of its
neighbours by several times what 99 % of a channel's samples do is bridged before anything is estimated; the quantile
does not follow a few such samples. Nothing is named for it, for a sharp peak of friction may look alike: at most one
sample in a hundred, and of sound records one in several thousand, is bridged.

Source: trimming by a quantile of the data: Huber, Ronchetti, Robust Statistics, 2009, section 1.2.
"""

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.signals.short_bursts import LEAST, LONGEST, bridge_samples, height

#: Share of a channel's samples whose height is usual [1].
_USUAL = 0.99
#: Longest burst that is looked for [samples], and how many times higher than usual it is. Of sound channels of four
#: simulated campaigns the first two take up to 16 samples in ten thousand, of friction alone, the last none.
_FORMS = ((2, 4.0), (5, 8.0), (LONGEST, 6.0))


def outliers(values: Array) -> Mask:
    """Tell which samples of a channel (n,) stand out of their neighbours several times more than usual.

    Args:
        values: (n,); values that are missing are passed over.

    Returns:
        (n,) true at an outlier; false everywhere in fewer than 64 samples.
    """
    there = np.isfinite(values)
    found = np.zeros(len(values), dtype=bool)
    if np.count_nonzero(there) < LEAST:
        return found
    padded = np.pad(values[there], LONGEST, mode="edge")
    for longest, factor in _FORMS:
        above = height(padded, longest)[LONGEST:-LONGEST]
        usual = float(np.quantile(above, _USUAL))
        if usual > 0.0:
            found[there] |= above > factor * usual
    return found


def without_outliers(values: Array) -> Array:
    """Return the values (n,) with outliers bridged."""
    bad = outliers(values)
    return bridge_samples(values, bad) if bad.any() else values
