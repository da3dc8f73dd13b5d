"""The products that a posterior asks for, of averaged rows."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.evidence.statistics import Statistics
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn, FloatArray

#: Rows whose products are taken at once: memory.
_AT_ONCE = 20_000


def compute_statistics(
    rows: AveragedRows,
    left: Array,
    fitted: Array,
    slopes: Array,
    of_base: NDArray[np.bool_],
    columns: Sequence[CandidateColumn],
) -> Statistics:
    """Return the products.

    Args:
        rows: how residuals are averaged.
        left: (q,) averaged residual, without what the model's own effects explain.
        fitted: (q,) averaged residual of the fit.
        slopes: (q, b) averaged slopes of the base numbers.
        of_base: (b,) which of these belong to the base model.
        columns: of candidates, each (q,).
    """
    count = len(rows.relations)
    of_fit = np.bincount(rows.relation, fitted**2, minlength=count).astype(float)
    every = np.column_stack([slopes.astype(np.float32), *(c.column for c in columns)])
    counted = np.bincount(rows.relation, minlength=count).astype(float)
    sums = sum_products(every, left, rows.relation, count)
    return Statistics(*sums, of_fit, counted, rows.samples, slopes.shape[1], of_base)


def sum_products(every: FloatArray, left: Array, group: NDArray[np.int64], count: int) -> tuple[Array, Array, Array]:
    """Return products of columns (g, k, k), of columns with a residual (g, k), and its squares (g,), group by group.

    Args:
        every: (q, k) columns.
        left: (q,) residual.
        group: (q,) number of each row's group.
        count: how many groups there are.
    """
    width = every.shape[1]
    products, pulls, squares = np.zeros((count, width, width)), np.zeros((count, width)), np.zeros(count)
    for k in range(count):
        at = np.flatnonzero(group == k)
        for start in range(0, len(at), _AT_ONCE):
            part = at[start : start + _AT_ONCE]
            some, y = every[part].astype(float), left[part]
            products[k] += some.T @ some
            pulls[k] += some.T @ y
            squares[k] += float(y @ y)
    return products, pulls, squares
