"""B-splines over one state, or over the plane of two: bins (degree 0) or straight pieces (degree 1)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import csr_array

from slipwise.arrays import Array
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class SplineBasis:
    """B-splines over the knots of one state, or the products of those of two.

    Attributes:
        knots: per state the rising places of its knots [SI]: the edges of bins, or the corners of straight pieces.
        degree: 0 for curves that are constant in each bin, 1 for those of straight pieces.
    """

    knots: tuple[Array, ...]
    degree: int

    @property
    def shape(self) -> tuple[int, ...]:
        """Per state the number of heights that a curve has."""
        return tuple(len(k) - 1 + self.degree for k in self.knots)

    def columns(self, states: Sequence[Array]) -> csr_array:
        """Return the B-splines (m, K) at states, (m,) each; beyond its knots a curve goes on as it ends."""
        out, *others = (_columns(s, k, self.degree) for s, k in zip(states, self.knots, strict=True))
        for other in others:
            out = _products(out, other)
        return out

    def evaluate(self, heights: Array, states: Sequence[Array]) -> Array:
        """Return the curve of these heights (K,) at states, (m,) each."""
        return np.asarray(self.columns(states) @ heights, dtype=np.float64)


def _columns(values: Array, knots: Array, degree: int) -> csr_array:
    if len(knots) == 1:
        return csr_array(np.ones((len(values), 1)))
    ends = np.concatenate([knots[:1].repeat(degree), knots, knots[-1:].repeat(degree)])
    return BSpline.design_matrix(np.clip(values, knots[0], knots[-1]), ends, degree)


def _products(one: Any, other: Any) -> csr_array:
    """Return the products of every column of one (m, a) with every column of the other (m, b), (m, a b)."""
    rows, width = one.shape[0], other.shape[1]
    values = np.einsum("mi,mj->mij", one.data.reshape(rows, -1), other.data.reshape(rows, -1))
    places = width * one.indices.reshape(rows, -1, 1) + other.indices.reshape(rows, 1, -1)
    starts = np.arange(rows + 1) * values[0].size
    return csr_array((values.ravel(), places.ravel(), starts), shape=(rows, one.shape[1] * width))


def choose_knots(values: Array, count: int) -> Array:
    """Return knots at equal shares of the samples and, by turns, of the range: (k,) rising, k at most `count`."""
    low, high = float(values.min()), float(values.max())  # what grows fast is largest where it is rare
    shares = np.quantile(values, np.linspace(0.0, 1.0, (count + 1) // 2))
    knots = np.unique(np.concatenate([shares, np.linspace(low, high, count - len(shares) + 2)]))
    apart = np.concatenate([[True], np.diff(knots) > 1e-3 * max(high - low, 1e-300)])
    return knots[apart]


def choose_equal_bins(values: Array, count: int, *, split: bool = False) -> Array:
    """Return the edges (k,) of at most `count` bins with equal numbers of samples.

    Args:
        values: (m,) of the samples.
        count: of bins.
        split: whether zero is an edge as well, where both signs are there.
    """
    edges = np.quantile(values, np.linspace(0.0, 1.0, count + 1))
    if split and edges[0] < 0.0 < edges[-1]:
        edges = np.append(edges, 0.0)
    return np.unique(edges)
