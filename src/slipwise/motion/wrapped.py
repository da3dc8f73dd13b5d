"""One series written several values a line, as Fortran and OpenSees do, told from a table of several components."""

import numpy as np
from numpy.typing import NDArray

from slipwise.motion.rows import Rows

#: In reading order a wrapped series is at least this much smoother than down its columns [1].
_SMOOTHER = 0.8


def wrapped_series(rows: Rows) -> NDArray[np.float64] | None:
    """Give the series (n,) in reading order, None where the rows are no wrapped series.

    A short last line is a sign of it; without one, neighbours in a line must be closer than neighbours in a column.
    """
    count, width = len(rows.values), len(rows.values[0])
    if rows.names or count < 2 or width < 3 or any(len(row) != width for row in rows.values[:-1]):
        return None
    series, last = rows.series(), len(rows.values[-1])
    if last > width or rises_evenly(np.array([row[0] for row in rows.values])):
        return None
    above = rows.values[:-1]
    columns = above if isinstance(above, np.ndarray) else np.stack(above)
    if last < width:
        return series
    along = np.abs(np.diff(series)).mean()
    down = np.abs(np.diff(columns, axis=0)).mean() if len(columns) > 1 else 0.0
    return series if along < _SMOOTHER * down else None


def rises_evenly(first: NDArray[np.float64]) -> bool:
    """Tell whether a column (n,) may be one of times: it rises by nearly the same step at every row."""
    steps = np.diff(first)
    return bool(len(steps) > 2 and (steps > 0).all() and steps.max() < 1.5 * np.median(steps))
