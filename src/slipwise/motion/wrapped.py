"""One series written several values a line, alone or in pairs of time and value, told from a table of components."""

import numpy as np

from slipwise.arrays import Array
from slipwise.motion.number_rows import Rows
from slipwise.motion.time_column import rises_evenly

#: In reading order a wrapped series is at least this much smoother than down its columns [1].
_SMOOTHER = 0.8
#: A single line with fewer numbers is no record.
_SHORTEST = 8


def wrapped_series(rows: Rows) -> Array | None:
    """Return the series (n,) in reading order, None where the rows are no wrapped series.

    A single line or a short last line is a sign of it; without one, neighbours in a line must be closer than neighbours
    in a column.
    """
    count, width = len(rows.values), len(rows.values[0])
    if width < 3 or any(len(row) != width for row in rows.values[:-1]):
        return None
    series, last = rows.series(), len(rows.values[-1])
    if count == 1:
        return series if width >= _SHORTEST else None
    if last > width or rises_evenly(np.array([row[0] for row in rows.values])):
        return None
    if last < width:
        return series
    columns = series.reshape(count, width)[:-1]
    along = np.abs(np.diff(series)).mean()
    down = np.abs(np.diff(columns, axis=0)).mean() if len(columns) > 1 else 0.0
    return series if along < _SMOOTHER * down else None


def wrapped_pairs(rows: Rows) -> Array | None:
    """Return pairs of time and value (n, 2) that stand several to a line, as functions of finite-element programs do.

    None where every other number does not rise evenly in reading order.
    """
    width, series = len(rows.values[0]), rows.series()
    if width < 4 or width % 2 or series.size % 2 or not rises_evenly(series[::2]):
        return None
    return series.reshape(-1, 2)
