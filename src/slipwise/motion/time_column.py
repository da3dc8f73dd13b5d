"""A column of times: it must rise evenly, and its step is the record's."""

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.number_rows import split_row
from slipwise.motion.rows import Rows
from slipwise.motion.source_file import SourceFile
from slipwise.units import parse_unit


def column_step(rows: Rows, values: NDArray[np.float64], unit: str, source: SourceFile) -> float:
    """Give the step of the first column [s], after checking it.

    Args:
        rows: the rows, for the places.
        values: the same as a table (n, columns).
        unit: of the first column.
        source: the file.

    Raises:
        InputError: times that run backwards, repeat, or are not even.
        UnitError: the column's unit is none of time.
    """
    name = rows.names[0] if rows.names else "1"
    factor = parse_unit(unit, "s", f"column {name!r} of {source.name}")
    time = values[:, 0]
    if len(time) < 2:
        raise InputError(f"{source.name}: {len(time)} row is no record; at least 2 are needed")
    return factor * even_step(time, rows, source)


def even_step(time: NDArray[np.float64], rows: Rows, source: SourceFile) -> float:
    """Give the step of times that rise evenly.

    Raises:
        InputError: they do not; the message names the line.
    """
    steps = np.diff(time)
    for wrong, words in ((steps < 0, "runs backwards"), (steps == 0, "repeats")):
        if wrong.any():
            i = int(np.flatnonzero(wrong)[0])
            raise InputError(
                f"{source.at(rows.places[i + 1])}: the time {words}: {time[i + 1]:g} after {time[i]:g}; repair the file"
            )
    dt = float((time[-1] - time[0]) / (len(time) - 1))
    # Times are rounded as written: an even record may be off by one unit of the last digit, not by more.
    rounding = _last_digit(source.lines[rows.places[-1]])
    usual = float(np.median(steps))
    uneven = np.abs(steps - usual) > max(0.01 * usual, min(1.01 * rounding, 0.4 * usual))
    if uneven.any():
        i = int(np.flatnonzero(uneven)[0])
        raise InputError(
            f"{source.at(rows.places[i + 1])}: the samples are not evenly spaced: a step of {steps[i]:g} where "
            f"{usual:g} is usual; samples are missing, or the record must be resampled first"
        )
    return dt


def _last_digit(line: str) -> float:
    """Give the worth of the last digit of a line's first field."""
    text = split_row(line)[0].lower().replace(",", ".").replace("d", "e")
    mantissa, _, exponent = text.partition("e")
    return 10.0 ** (-len(mantissa.partition(".")[2]) + _clipped(exponent))


def _clipped(exponent: str) -> int:
    """Give a written exponent, within what a float can hold."""
    return max(-300, min(300, int(exponent or 0)))
