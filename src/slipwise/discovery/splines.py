"""Curves of straight pieces over one state or a plane of two, fitted to a residual field through normal equations.

Everything that a form can do is judged on the spline first: f at its knots gives the column that f would be.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.discovery.residual_field import ResidualField

Array = NDArray[np.float64]
#: Ridge that keeps knots without samples where their neighbours are, as a share of the largest diagonal [1].
_RIDGE = 1e-6


@dataclass(frozen=True)
class Spline:
    """Normal equations of a curve over one state, or over two.

    Attributes:
        knots: per state the places of its knots.
        normal: per motion (K, K), K the product of their numbers.
        drive: per motion (K,).
        whole: squared residual per motion.
    """

    knots: tuple[Array, ...]
    normal: Array
    drive: Array
    whole: Array

    @property
    def gain(self) -> float:
        """Drop of the squared residual [1]."""
        return float(self.drive.sum(axis=0) @ self.curve())

    def curve(self) -> Array:
        """Heights at the knots (K,)."""
        return _solved(self.normal.sum(axis=0), self.drive.sum(axis=0))

    def band(self) -> Array:
        """Standard deviations of the heights (K,), by the noise alone."""
        normal = self.normal.sum(axis=0)
        ridge = _RIDGE * float(np.max(np.diag(normal))) * np.eye(len(normal))
        return np.sqrt(np.maximum(np.diag(np.linalg.inv(normal + ridge)), 0.0))

    def carried_over(self) -> float:
        """Drop of the squared residual of each motion by the curve that the others ask for, added up [1]."""
        normal, drive = self.normal.sum(axis=0), self.drive.sum(axis=0)
        out = 0.0
        for part, force in zip(self.normal, self.drive, strict=True):
            curve = _solved(normal - part, drive - force)
            out += float(2.0 * force @ curve - curve @ part @ curve)
        return out

    def gain_of(self, heights: Array) -> tuple[Array, Array]:
        """Return gains (g,) and strengths (g,) of curves of given heights at the knots, (g, K)."""
        normal, drive = self.normal.sum(axis=0), self.drive.sum(axis=0)
        along = heights @ drive
        size = np.einsum("gk,kl,gl->g", heights, normal, heights)
        safe = np.maximum(size, 1e-12 * float(np.max(np.diag(normal))))
        return along**2 / safe, along / safe


def _solved(normal: Array, drive: Array) -> Array:
    ridge = _RIDGE * (float(np.max(np.diag(normal))) or 1.0) * np.eye(len(normal))
    return np.asarray(np.linalg.solve(normal + ridge, drive), dtype=np.float64)


def knots_of(values: Array, count: int) -> Array:
    """Return knots at equal shares of the samples and, by turns, of the range: (k,) rising, k at most `count`."""
    low, high = float(values.min()), float(values.max())  # what grows fast is largest where it is rare
    shares = np.quantile(values, np.linspace(0.0, 1.0, (count + 1) // 2))
    knots = np.unique(np.concatenate([shares, np.linspace(low, high, count - len(shares) + 2)]))
    apart = np.concatenate([[True], np.diff(knots) > 1e-3 * max(high - low, 1e-300)])
    return knots[apart]


def hats(values: Array, knots: Array) -> Array:
    """Return the hat functions (m, k) of values (m,); constant beyond the ends of the knots."""
    if len(knots) == 1:
        return np.ones((len(values), 1))
    inside = np.clip(values, knots[0], knots[-1])
    place = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, len(knots) - 2)
    share = (inside - knots[place]) / (knots[place + 1] - knots[place])
    out = np.zeros((len(values), len(knots)))
    rows = np.arange(len(values))
    out[rows, place] = 1.0 - share
    out[rows, place + 1] = share
    return out


def columns(states: Sequence[Array], knots: Sequence[Array]) -> Array:
    """Return the hat functions (m, K) of states (m,) over one state, or over the plane of two."""
    out = hats(states[0], knots[0])
    if len(states) == 1:
        return out
    return np.einsum("mi,mj->mij", out, hats(states[1], knots[1])).reshape(len(out), -1)


def spline(field: ResidualField, carrier: Array, states: tuple[Array, ...], counts: tuple[int, ...]) -> Spline:
    """Make the normal equations of a curve over states.

    Args:
        field: the residual.
        carrier: (m,) what the curve is multiplied by, in the relation's unit.
        states: each (m,).
        counts: of knots of each.
    """
    knots = tuple(knots_of(s, count) for s, count in zip(states, counts, strict=True))
    clean = field.projected(columns(states, knots) * (carrier / field.sigma)[:, None])
    groups = np.unique(field.group)
    parts = [clean[field.group == g] for g in groups]
    left = [field.residual[field.group == g] for g in groups]
    return Spline(
        knots,
        np.stack([p.T @ p for p in parts]),
        np.stack([p.T @ r for p, r in zip(parts, left, strict=True)]),
        np.array([float(r @ r) for r in left]),
    )
