"""A column of times: it must rise evenly, and its step is the record's."""

from collections.abc import Callable

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError

#: Clocks of phones and loggers waver by less than this share of a step; a larger gap is a missing sample [1].
_WAVERS = 0.2


def even_step(time: Array, rounding: float, at: Callable[[int], str]) -> tuple[float, bool]:
    """Return the step of times that rise evenly, in their unit, and whether the clock wavers.

    Args:
        time: (n,).
        rounding: what the last digit of the times as written is worth; 0 where they are no text.
        at: gives the place of a row, for messages.

    Raises:
        InputError: fewer than 2, or times that run backwards, repeat, or are not even; the message names the row.
    """
    if len(time) < 2:
        raise InputError(f"{at(0)}: {len(time)} row is no record; at least 2 are needed")
    steps = np.diff(time)
    for wrong, words in ((steps < 0, "runs backwards"), (steps == 0, "repeats")):
        if wrong.any():
            i = int(np.flatnonzero(wrong)[0])
            raise InputError(f"{at(i + 1)}: the time {words}: {time[i + 1]:g} after {time[i]:g}; repair the file")
    # Times are rounded as written: an even record may be off by one unit of the last digit, not by more.
    usual = float(np.median(steps))
    off = np.abs(steps - usual)
    uneven = off > max(0.01 * usual, min(1.01 * rounding, 0.4 * usual))
    gap = off > max(_WAVERS * usual, min(1.01 * rounding, 0.4 * usual))
    if gap.any():
        i = int(np.flatnonzero(gap)[0])
        raise InputError(
            f"{at(i + 1)}: the samples are not evenly spaced: a step of {steps[i]:g} where {usual:g} is usual; samples "
            "are missing, or the record must be resampled first"
        )
    return float((time[-1] - time[0]) / (len(time) - 1)), bool(uneven.any())


def last_digit(text: str) -> float:
    """Return the worth of the last digit of a number as written: 0.01 for "12,30"."""
    mantissa, _, exponent = text.lower().replace(",", ".").replace("d", "e").partition("e")
    return 10.0 ** (-len(mantissa.partition(".")[2]) + max(-300, min(300, int(exponent or 0))))


def rises_evenly(first: Array) -> bool:
    """Return whether a column (n,) may be one of times: it rises by nearly the same step at every row."""
    steps = np.diff(first)
    return bool(len(steps) > 2 and (steps > 0).all() and steps.max() < 1.5 * np.median(steps))


def counts_rows(first: Array) -> bool:
    """Return whether a column (n,) numbers the rows: whole numbers that rise by one from 0 or 1."""
    return len(first) > 2 and first[0] in (0.0, 1.0) and bool((np.diff(first) == 1.0).all())
