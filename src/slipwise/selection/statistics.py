"""Products of residual, slopes and columns, relation by relation: all that a posterior asks of the samples."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn
from slipwise.short_repr import short_repr

#: Rows whose products are taken at once: memory.
_AT_ONCE = 20_000


@short_repr
@dataclass(frozen=True)
class Statistics:
    """Products by relation; base numbers stand before candidates' columns.

    Attributes:
        products: (r, k, k) of slopes and columns with each other.
        pulls: (r, k) of them with the residual.
        squares: (r,) of the residual.
        fitted: (r,) squares of what the fit leaves, its own effects included.
        rows: (r,) averaged rows of each relation.
        samples: (r,) judged samples before they were averaged.
        base: how many of the k are numbers that are fitted whatever is missing.
        of_base: (base,) which of these belong to the base model; the others are constants of effects that were added.
    """

    products: Array
    pulls: Array
    squares: Array
    fitted: Array
    rows: Array
    samples: Array
    base: int
    of_base: NDArray[np.bool_]


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
    of_fit = np.bincount(rows.relation, fitted**2, minlength=len(rows.relations)).astype(float)
    every = np.column_stack([slopes.astype(np.float32), *(c.column for c in columns)])
    width, count = every.shape[1], len(rows.relations)
    products, pulls = np.zeros((count, width, width)), np.zeros((count, width))
    squares, counted = np.zeros(count), np.zeros(count)
    for k in range(count):
        at = np.flatnonzero(rows.relation == k)
        counted[k] = len(at)
        for start in range(0, len(at), _AT_ONCE):
            part = at[start : start + _AT_ONCE]
            some, y = every[part].astype(float), left[part]
            products[k] += some.T @ some
            pulls[k] += some.T @ y
            squares[k] += float(y @ y)
    return Statistics(products, pulls, squares, of_fit, counted, rows.samples, slopes.shape[1], of_base)


def scale_columns(statistics: Statistics, factors: Array) -> Statistics:
    """Return the products with every candidate's column multiplied by a factor (K,)."""
    by = np.concatenate([np.ones(statistics.base), factors])
    return replace(statistics, products=statistics.products * np.outer(by, by), pulls=statistics.pulls * by)


def compute_left_by_base(statistics: Statistics) -> Array:
    """Return what a fit of the base numbers leaves of the products of columns, (r, K, K), a judged sample each."""
    base = statistics.base
    rig = np.flatnonzero(statistics.of_base)
    whole = statistics.products.sum(axis=0)
    own = whole[np.ix_(rig, rig)]
    own = own + np.diag(1e-9 * np.diag(own) + 1e-9)
    q = np.linalg.solve(own, whole[rig, base:])
    out = []
    for product, samples in zip(statistics.products, statistics.samples, strict=True):
        cross = product[base:][:, rig] @ q
        left = product[base:, base:] - cross - cross.T + q.T @ product[np.ix_(rig, rig)] @ q
        out.append(left / max(samples, 1.0))
    return np.array(out)
