"""The curve of a residual over states: its heights by least squares, their errors, and how much it explains.

Every block of samples, a motion or a stretch of one, keeps normal equations of its own: a curve of the other blocks is
held against it without a pass over the samples. Everything that a form can do is judged here as well: f at the knots
gives the column that f would be.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array

from slipwise.arrays import Array
from slipwise.residual_map.splines import SplineBasis
from slipwise.short_repr import short_repr

#: Ridge that keeps places without samples at zero, as a share of the largest diagonal [1].
_RIDGE = 1e-6


@short_repr
@dataclass(frozen=True)
class ResidualCurve:
    """A curve over one state, or over two, that a residual asks for.

    Attributes:
        splines: of which it is made, K of them.
        normal: per block (K, K).
        drive: per block (K,).
        whole: squared residual per block.
        count: (K,) samples at each spline.
        scatter: (K,) mean square, about the curve, of the residual at each spline; infinite for a single sample.
    """

    splines: SplineBasis
    normal: Array
    drive: Array
    whole: Array
    count: NDArray[np.int64]
    scatter: Array

    @property
    def knots(self) -> tuple[Array, ...]:
        """Per state the places of its knots."""
        return self.splines.knots

    @property
    def gain(self) -> float:
        """Drop of the squared residual [1]."""
        return float(self.drive.sum(axis=0) @ self.heights())

    def heights(self) -> Array:
        """Return the heights of the curve (K,), in residuals over what it is multiplied by."""
        return _solve(self.normal.sum(axis=0), self.drive.sum(axis=0))

    def errors(self, per_independent: float = 1.0) -> Array:
        """Return the standard errors of the heights (K,), by the scatter of the residual about the curve.

        Args:
            per_independent: samples for one independent one [1].
        """
        inverse = np.linalg.inv(_with_ridge(self.normal.sum(axis=0)))
        return np.sqrt(np.maximum(np.diag(inverse), 0.0) * self.scatter * per_independent)

    def errors_about_mean(self) -> Array:
        """Return the standard errors of the heights about their mean (K,): what moves all of them alike leaves these.

        A base number that makes up for a constant leaves the mean open, and the shape as sure as it is.
        """
        inverse = np.linalg.inv(_with_ridge(self.normal.sum(axis=0)))
        scattered = np.sqrt(np.outer(self.scatter, self.scatter)) * inverse
        finite = np.where(np.isfinite(scattered), scattered, 0.0)
        about = np.eye(len(finite)) - 1.0 / len(finite)
        return np.sqrt(np.maximum(np.diag(about @ finite @ about.T), 0.0))

    def carried_over(self) -> float:
        """Return the drop of the squared residual of each block by the curve that the others ask for, added up [1]."""
        normal, drive = self.normal.sum(axis=0), self.drive.sum(axis=0)
        out = 0.0
        for part, force in zip(self.normal, self.drive, strict=True):
            curve = _solve(normal - part, drive - force)
            out += float(2.0 * force @ curve - curve @ part @ curve)
        return out

    def gain_of(self, heights: Array) -> tuple[Array, Array]:
        """Return gains (g,) and strengths (g,) of curves of given heights at the knots, (g, K)."""
        normal, drive = self.normal.sum(axis=0), self.drive.sum(axis=0)
        along = heights @ drive
        size = np.einsum("gk,kl,gl->g", heights, normal, heights)
        safe = np.maximum(size, 1e-12 * float(np.max(np.diag(normal))))
        return along**2 / safe, along / safe


def fit_curve(
    splines: SplineBasis,
    states: Sequence[Array],
    factor: Array,
    residual: Array,
    block: NDArray[np.int64] | None = None,
) -> ResidualCurve:
    """Fit a curve over states to a residual.

    Args:
        splines: of which the curve is made.
        states: each (m,).
        factor: (m,) what the curve is multiplied by to be the residual.
        residual: (m,).
        block: (m,) the block of each sample; all are one where not given.
    """
    columns: Any = csr_array(diags_array(factor) @ splines.columns(states))
    block = np.zeros(len(residual), dtype=np.int64) if block is None else block
    normal, drive, whole = [], [], []
    for number in np.unique(block):
        here = block == number
        part, left = columns[here], residual[here]
        normal.append((part.T @ part).toarray())
        drive.append(part.T @ left)
        whole.append(float(left @ left))
    heights = _solve(np.sum(normal, axis=0), np.sum(drive, axis=0))
    left = residual - columns @ heights
    weight = columns.power(2)
    count = np.bincount(columns.indices[columns.data != 0.0], minlength=columns.shape[1])
    mean = (weight.T @ left**2) / np.maximum(weight.sum(axis=0), 1e-300)
    scatter = np.where(count > 1, mean * count / np.maximum(count - 1, 1), np.inf)
    return ResidualCurve(splines, np.stack(normal), np.stack(drive), np.array(whole), count, scatter)


def _solve(normal: Array, drive: Array) -> Array:
    return np.asarray(np.linalg.solve(_with_ridge(normal), drive), dtype=np.float64)


def _with_ridge(normal: Array) -> Array:
    return normal + _RIDGE * (float(np.max(np.diag(normal))) or 1.0) * np.eye(len(normal))
