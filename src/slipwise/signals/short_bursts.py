"""Short bursts that stand far outside everything else a channel shows: what no gauge of its bandwidth can have read.

A gauge that follows a motion shows the way up to a peak and down from it, and a channel that reaches a peak once comes
near it at other times. A glitch of a logger does neither: it is there from one sample to the next, gone as suddenly,
and the rest of the channel knows nothing like it. Two scales tell it, both of all other samples: their range for
bursts of up to 20, and for one or two samples the largest by which any others stand out of their neighbours.
"""

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from slipwise.arrays import Array, Mask

#: A burst has at most so many samples, and a record to be searched at least so many.
LONGEST, LEAST = 20, 64
#: The range that is grown from holds this share of the samples [1]: bursts are fewer than what is left out.
_INNER = 0.9
#: A burst stands out of its surroundings by more than this many ranges of all other samples, and begins and ends with
#: a step of at least so many [1]. Sampled impacts, peaks of earthquakes and bending girders reach 1.25 with steps of
#: less than 0.6.
_HEIGHT, _STEP = 1.2, 0.8
#: The largest step is at least this share of the burst's height [1]: a pulse of a motion takes several samples.
_ABRUPT = 0.4
#: A spike has at most so many samples, and stands out by that many times more than any other spike of the channel [1].
#: The largest spike of measured and simulated channels is at most 3 times the next.
_SPIKE, _ALONE = 2, 4.0
#: Good samples to either side of a burst that its bridge is fitted to.
_BESIDE = 12
#: Neighbouring second differences of noise have opposite signs more often than this [1]; a smooth motion without noise
#: may show a single cusp.
_NOISE = 0.5


def short_bursts(values: Array) -> Mask:
    """Find bursts of up to 20 samples that stand out by more than the range of all other samples.

    Args:
        values: (n,) of one channel; values that are missing are passed over.

    Returns:
        (n,) true in a burst; false everywhere in fewer than 64 samples, and where all other samples are equal.
    """
    there = np.isfinite(values)
    found = np.zeros(len(values), dtype=bool)
    if np.count_nonzero(there) < LEAST:
        return found
    known = values[there]
    burst = _bursts(known)
    for _ in range(_SPIKE + 1):  # beside a spike a sample on a slope seems to stand out too: the largest goes first
        spike = _spikes(_across(known, burst))
        if not spike.any():
            break
        burst |= spike
    found[there] = burst
    return found


def _across(values: Array, bad: Mask) -> Array:
    """Return the values with straight lines across bad samples, (n,)."""
    place = np.arange(len(values))
    return np.interp(place, place[~bad], values[~bad])


def _bursts(values: Array) -> Mask:
    beyond = 2 * LONGEST + 1
    ends = (float(np.median(values[:beyond])), float(np.median(values[-beyond:])))
    longer = np.pad(values, beyond, constant_values=(ends,))  # so that a burst at an end stands out too
    above = height(longer, LONGEST)[beyond:-beyond]
    low, high = (float(q) for q in np.quantile(values, (0.5 - 0.5 * _INNER, 0.5 + 0.5 * _INNER)))
    span = -1.0
    while high - low > span:  # the range grows by all that stands no higher than it allows, until nothing is added
        span = high - low
        ordinary = values[above <= _HEIGHT * span]
        low, high = min(low, float(ordinary.min(initial=low))), max(high, float(ordinary.max(initial=high)))
    kept = np.zeros(len(values), dtype=bool)
    if span == 0.0:
        return kept
    outside = (values < low) | (values > high)  # what lies between two bursts seems to stand out the other way
    for start, end in stretches((above > _HEIGHT * span) & outside):
        with_neighbours = longer[start + beyond - 1 : end + beyond + 1]
        if end - start <= LONGEST and _is_abrupt(with_neighbours, _STEP * span):
            kept[start:end] = True
    return kept


def _spikes(values: Array) -> Mask:
    """Find samples that stand out of their neighbours far more than noise lets any other do, of a pair the larger."""
    above = height(np.pad(values, LONGEST, mode="edge"), _SPIKE)[LONGEST:-LONGEST]
    bend = np.convolve(values, (-0.5, 1.0, -0.5), mode="valid")
    if np.mean(bend[1:] * bend[:-1] < 0.0) <= _NOISE:
        return np.zeros(len(values), dtype=bool)
    # on a slope nothing stands out: there second differences show the noise
    largest = max(float(np.quantile(above, _INNER)), float(np.quantile(np.abs(bend), _INNER)))
    before = -1.0
    while largest > before:
        before = largest
        largest = float(above[above <= _ALONE * largest].max(initial=largest))
    spikes = np.zeros(len(values), dtype=bool)
    steps = np.pad(np.abs(np.diff(values)), 2)  # from sample i - 2 to the next at i
    for start, end in stretches(above > _ALONE * largest):
        # a pulse is as steep beside its top, and a motion that turns back at once beside its corner
        beside = max(steps[start], steps[end + 2])
        top = start + int(np.argmax(above[start:end]))
        spikes[top] = above[top] > _ALONE * beside
    return spikes


def height(values: Array, longest: int) -> Array:
    """Return how far each sample stands above or below all that lasts longer than so many, (n,): its two top-hats."""
    size = longest + 1
    back = -1 if size % 2 == 0 else 0  # a window of even length is not centred: the second one makes up for the first
    opened = maximum_filter1d(minimum_filter1d(values, size), size, origin=back)
    closed = minimum_filter1d(maximum_filter1d(values, size), size, origin=back)
    return np.maximum(values - opened, closed - values)


def _is_abrupt(values: Array, step: float) -> bool:
    """Return whether a burst, with the samples beside it (k,), begins and ends with such a step, unlike a wave."""
    steps = np.diff(values)
    return bool(min(abs(steps[0]), abs(steps[-1])) >= step and np.abs(steps).max() >= _ABRUPT * np.ptp(values))


def stretches(mask: Mask) -> list[tuple[int, int]]:
    """Return first sample and the one after the last of every stretch of true samples."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    return [(int(start), int(end)) for start, end in zip(edges[::2], edges[1::2], strict=True)]


def bridge_samples(values: Array, bad: Mask) -> Array:
    """Return the values (n,) with each bad stretch on the cubic that fits its neighbours; at an end on the next one."""
    good = np.flatnonzero(~bad & np.isfinite(values))
    out = np.where(bad, np.interp(np.arange(len(values)), good, values[good]), values)
    for start, end in stretches(bad):
        at = int(np.searchsorted(good, start))
        before, after = good[max(at - _BESIDE, 0) : at], good[at : at + _BESIDE]
        if min(len(before), len(after)) < _BESIDE:
            continue
        beside = np.concatenate([before, after])
        middle = 0.5 * (start + end - 1)
        cubic = np.polynomial.polynomial.polyfit(beside - middle, values[beside], 3)
        out[start:end] = np.polynomial.polynomial.polyval(np.arange(start, end) - middle, cubic)
    return out
