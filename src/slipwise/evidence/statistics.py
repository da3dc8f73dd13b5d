"""Products of residual, slopes and columns, relation by relation: all that a posterior asks of the samples."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.short_repr import short_repr


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


def scale_columns(statistics: Statistics, factors: Array) -> Statistics:
    """Return the products with every candidate's column multiplied by a factor (K,)."""
    by = np.concatenate([np.ones(statistics.base), factors])
    return replace(statistics, products=statistics.products * np.outer(by, by), pulls=statistics.pulls * by)


def restrict(statistics: Statistics, relations: Sequence[int], columns: Sequence[int]) -> Statistics:
    """Return the products of some relations, and of some columns beside the numbers that are fitted, by their places.

    Args:
        statistics: products.
        relations: places of relations.
        columns: places of columns, the first one after the numbers that are fitted is 0.
    """
    every, at = [*range(statistics.base), *(statistics.base + k for k in columns)], list(relations)
    return replace(
        statistics,
        products=statistics.products[np.ix_(at, every, every)],
        pulls=statistics.pulls[np.ix_(at, every)],
        squares=statistics.squares[at],
        fitted=statistics.fitted[at],
        rows=statistics.rows[at],
        samples=statistics.samples[at],
    )


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
