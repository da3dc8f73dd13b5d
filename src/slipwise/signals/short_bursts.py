"""Short bursts that stand far outside everything else a channel shows: what no gauge of its bandwidth can have read.

A gauge that follows a motion shows the way up to a peak and down from it, and a channel that reaches a peak once comes
near it at other times. A glitch of a logger does neither: it is there from one sample to the next, gone as suddenly,
and the rest of the channel knows nothing like it.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, minimum_filter1d

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: A burst has at most so many samples, and a record to be searched at least so many.
LONGEST, _LEAST = 20, 64
#: The range that is grown from holds this share of the samples [1]: bursts are fewer than what is left out.
_INNER = 0.9
#: A burst stands out of its surroundings by more than this many ranges of all other samples, and begins and ends with
#: a step of at least so many [1]. Sampled impacts, peaks of earthquakes and bending girders reach 1.25 with steps of
#: less than 0.6.
_HEIGHT, _STEP = 1.2, 0.8
#: The steepest step up and the steepest step down are at least this share of the burst's height [1]: a half wave that
#: was sampled has several steps.
_ABRUPT = 0.2


def short_bursts(values: Array) -> Mask:
    """Find bursts of up to 20 samples that stand out by more than the range of all other samples.

    Args:
        values: (n,) of one channel; values that are missing are passed over.

    Returns:
        (n,) true in a burst; false everywhere in fewer than 64 samples, and where all other samples are equal.
    """
    there = np.isfinite(values)
    found = np.zeros(len(values), dtype=bool)
    if np.count_nonzero(there) < _LEAST:
        return found
    found[there] = _bursts(values[there])
    return found


def _bursts(values: Array) -> Mask:
    beyond = 2 * LONGEST + 1
    ends = (float(np.median(values[:beyond])), float(np.median(values[-beyond:])))
    longer = np.pad(values, beyond, constant_values=(ends,))  # so that a burst at an end stands out too
    height = _height(longer)[beyond:-beyond]
    low, high = (float(q) for q in np.quantile(values, (0.5 - 0.5 * _INNER, 0.5 + 0.5 * _INNER)))
    span = -1.0
    while high - low > span:  # the range grows by all that stands no higher than it allows, until nothing is added
        span = high - low
        ordinary = values[height <= _HEIGHT * span]
        low, high = min(low, float(ordinary.min(initial=low))), max(high, float(ordinary.max(initial=high)))
    kept = np.zeros(len(values), dtype=bool)
    if span == 0.0:
        return kept
    for start, end in stretches(height > _HEIGHT * span):
        with_neighbours = longer[start + beyond - 1 : end + beyond + 1]
        if end - start <= LONGEST and _is_abrupt(with_neighbours, _STEP * span):
            kept[start:end] = True
    return kept


def _height(values: Array) -> Array:
    """Give how far each sample stands above or below all that lasts longer than a burst, (n,): its two top-hats."""
    size = LONGEST + 1
    opened = maximum_filter1d(minimum_filter1d(values, size), size)
    closed = minimum_filter1d(maximum_filter1d(values, size), size)
    return np.maximum(values - opened, closed - values)


def _is_abrupt(values: Array, step: float) -> bool:
    """Tell whether a burst, with the sample before and after it (k,), begins and ends with such a step, as no wave."""
    steps = np.diff(values)
    steepest = min(float(steps.max()), float(-steps.min()))
    return bool(min(abs(steps[0]), abs(steps[-1])) >= step and steepest >= _ABRUPT * float(np.ptp(values)))


def stretches(mask: Mask) -> list[tuple[int, int]]:
    """Give first sample and the one after the last of every stretch of true samples."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    return [(int(start), int(end)) for start, end in zip(edges[::2], edges[1::2], strict=True)]
