"""The joint system of a fit: base numbers, every candidate of the catalogue as dirt or more, and one curve.

    r = y + J d + X u + Z c + e,    u ~ N(0, v),    c ~ N(0, t^2 C)

as in `evidence.posterior`, with the same averaged rows, columns, tolerances, dirt and coarsening. A candidate that
matters has the variance of its width added to that of dirt, which is the same as a further column. The heights c of a
curve go smoothly from knot to knot. All is integrated out in one Cholesky factor: what is left is the evidence of a
curve beside what stands there with it.

Source: as of `evidence.posterior`; curves as Gaussian processes: Rasmussen, Williams (2006), sections 2.7 and 5.4.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from slipwise.arrays import Array
from slipwise.evidence.posterior import make_normal_system
from slipwise.evidence.prior import ColumnGroups, Prior, compute_log_odds, group_columns, list_trifles
from slipwise.evidence.statistics import Statistics
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.statistics import sum_products
from slipwise.short_repr import short_repr

#: Knots over which a curve's heights stay alike, that are tried.
_SMOOTH = (1.0, 4.0, 16.0)
#: Variances of its heights that are tried, over that of their mean error: from so much to so much, so many.
_SIZES = np.logspace(-1.0, 6.0, 15)


@short_repr
@dataclass(frozen=True)
class CurveSystem:
    """Products of everything but curves, by relation and by block: a motion, or a stretch of a single one.

    Attributes:
        rows: how residuals are averaged.
        left: (q,) averaged residual without the effects of the model.
        every: (q, k) slopes of the base numbers, then columns of candidates.
        keys: (b,) of the base numbers.
        columns: of the candidates.
        tolerances: of base numbers, as of `compute_posterior`.
        apart: labels of terms that cannot be in one model, in both orders.
        block: (q,) number of the block of each row.
        products: (r, t, k, k).
        pulls: (r, t, k) of the residual.
        squares: (r, t) of the residual.
        counts: (r,) rows.
    """

    rows: AveragedRows
    left: Array
    every: NDArray[np.float32]
    keys: tuple[str, ...]
    columns: tuple[CandidateColumn, ...]
    tolerances: Mapping[int, tuple[float, float]]
    apart: Collection[tuple[str, str]]
    block: NDArray[np.int64]
    products: Array
    pulls: Array
    squares: Array
    counts: Array

    @property
    def base(self) -> int:
        """How many of the columns are slopes of base numbers."""
        return len(self.keys)

    @cached_property
    def groups(self) -> ColumnGroups:
        """Which columns make which form of which candidate."""
        return group_columns(self.columns)

    @cached_property
    def odds(self) -> Array:
        """Logarithm of the prior of each form against none (F,)."""
        return compute_log_odds(self.groups, self.columns)

    @cached_property
    def trifles(self) -> Array:
        """Variance of every candidate's column where it is a trifle (K,) [limits^2]."""
        return list_trifles(self.columns) ** 2

    @cached_property
    def summed(self) -> tuple[Array, Array, Array]:
        """Products, pulls and squares of all blocks together."""
        return self.products.sum(axis=1), self.pulls.sum(axis=1), self.squares.sum(axis=1)

    @cached_property
    def statistics(self) -> Statistics:
        """The same products as a posterior without curves asks for them."""
        products, pulls, squares = self.summed
        of_base = np.ones(self.base, bool)
        return Statistics(products, pulls, squares, squares, self.counts, self.counts, self.base, of_base)

    @cached_property
    def spread(self) -> Array:
        """By how many rows one independent sample stands (r,): the coarsening."""
        return Prior().compute_coarsening(self.counts)

    def weights(self, level: Array) -> Array:
        """Return the weight of a squared row of each relation (r,) where so much is left of it [noise variance]."""
        return 1.0 / (level * self.spread)


def make_curve_system(
    rows: AveragedRows,
    left: Array,
    slopes: Array,
    keys: Sequence[str],
    columns: Sequence[CandidateColumn],
    tolerances: Mapping[int, tuple[float, float]],
    apart: Collection[tuple[str, str]],
    block: NDArray[np.int64],
) -> CurveSystem:
    """Take the products; arguments as the attributes, slopes (q, b)."""
    every = np.column_stack([slopes.astype(np.float32), *(c.column for c in columns)])
    relations, blocks = len(rows.relations), int(block.max()) + 1
    sums = sum_products(every, left, rows.relation * blocks + block, relations * blocks)
    products, pulls, squares = (each.reshape(relations, blocks, *each.shape[1:]) for each in sums)
    counts = np.maximum(np.bincount(rows.relation, minlength=relations).astype(float), 1.0)
    return CurveSystem(
        rows, left, every, tuple(keys), tuple(columns), tolerances, apart, block, products, pulls, squares, counts
    )


def leave_out(system: CurveSystem, labels: Collection[str]) -> CurveSystem:
    """Return the system without the candidates of these labels."""
    columns = [c for c in system.columns if c.label not in labels]
    slopes = system.every[:, : system.base].astype(np.float64)
    return make_curve_system(
        system.rows, system.left, slopes, system.keys, columns, system.tolerances, system.apart, system.block
    )


@short_repr
@dataclass(frozen=True)
class CurveProducts:
    """Products of a curve's m columns, in the relation that it acts on, by block.

    Attributes:
        relation: number of the relation.
        shape: per state the number of heights.
        cross: (t, k, m) with everything else.
        own: (t, m, m).
        pull: (t, m) with the residual.
    """

    relation: int
    shape: tuple[int, ...]
    cross: Array
    own: Array
    pull: Array

    @cached_property
    def summed(self) -> tuple[Array, Array, Array]:
        """The same of all blocks together."""
        return self.cross.sum(axis=0), self.own.sum(axis=0), self.pull.sum(axis=0)


def take_curve_products(system: CurveSystem, relation: str, columns: Array, shape: tuple[int, ...]) -> CurveProducts:
    """Return the products of the columns (q of the relation, m) of a curve."""
    number = system.rows.relations.index(relation)
    at = np.flatnonzero(system.rows.relation == number)
    every, left, block = system.every[at], system.left[at], system.block[at]
    cross, own, pull = [], [], []
    for t in range(system.products.shape[1]):
        here = block == t
        part = columns[here]
        cross.append((every[here].T @ part.astype(np.float32)).astype(float))
        own.append(part.T @ part)
        pull.append(part.T @ left[here])
    return CurveProducts(number, shape, np.stack(cross), np.stack(own), np.stack(pull))


@short_repr
@dataclass(frozen=True)
class Solved:
    """The system with everything integrated out.

    Attributes:
        evidence: logarithm of the marginal likelihood, up to a constant of the system [nats].
        means: (k,) of base numbers and candidates.
        heights: (m,) of the curve; empty without one.
        left: (r,) squared rows that are left at the means.
        factor: Cholesky factor of the precision, scaled.
        scales: (k + m,) by which it was scaled.
    """

    evidence: float
    means: Array
    heights: Array
    left: Array
    factor: tuple[Array, bool]
    scales: Array

    def covariance(self) -> Array:
        """Return the covariance of base numbers and candidates (k, k)."""
        size = len(self.means)
        ends = np.diag(self.scales)[:, :size]
        return (self.scales[:, None] * cho_solve(self.factor, ends))[:size]


def solve_system(
    system: CurveSystem, variance: Array, level: Array, curve: CurveProducts | None = None, root: Array | None = None
) -> Solved:
    """Integrate everything out.

    Args:
        system: the products.
        variance: (K,) of every candidate's column [limits^2].
        level: (r,) what is left of every relation [noise variance].
        curve: that stands beside them, if any.
        root: (m, m) root of the covariance of its heights.
    """
    products, pulls, squares = system.summed
    weights = system.weights(level)
    normal = make_normal_system(system.statistics, system.tolerances, level, np.sqrt(variance))
    whole, pull = normal.regular, normal.pull
    known = sum((off / deviation) ** 2 for off, deviation in system.tolerances.values())
    if curve is not None and root is not None:
        cross, own, drive = curve.summed
        weight = weights[curve.relation]
        beside = weight * cross @ root
        inner = weight * root.T @ own @ root + np.eye(root.shape[1])
        whole = np.block([[whole, beside], [beside.T, inner]])
        pull = np.concatenate([pull, -weight * root.T @ drive])
    scales = 1.0 / np.sqrt(np.diag(whole))
    factor = cho_factor(whole * np.outer(scales, scales) + 1e-12 * np.eye(len(scales)), lower=True)
    means = scales * cho_solve(factor, scales * pull)
    determinant = 2.0 * float(np.sum(np.log(np.diag(factor[0]))) - np.sum(np.log(scales)))
    evidence = 0.5 * (float(pull @ means) - determinant - float(np.sum(np.log(variance))) - known)
    independent = system.counts / system.spread
    evidence -= 0.5 * float(independent @ np.log(level) + weights @ squares)
    fixed, heights = means[: len(system.every.T)], np.zeros(0)
    left = squares + 2.0 * pulls @ fixed + np.einsum("i,kij,j->k", fixed, products, fixed)
    if curve is not None and root is not None:
        cross, own, drive = curve.summed
        heights = root @ means[len(fixed) :]
        left[curve.relation] += float(2.0 * heights @ (drive + cross.T @ fixed) + heights @ own @ heights)
    return Solved(evidence, fixed, heights, left, factor, scales)


def level_of(system: CurveSystem, left: Array) -> Array:
    """Return what is left of every relation (r,), at least the prior's floor [noise variance]."""
    return np.maximum(left / system.counts, Prior().floor)


def choose_root(system: CurveSystem, bare: Solved, level: Array, curve: CurveProducts) -> tuple[Array, float]:
    """Return the root of the likeliest covariance of a curve's heights, and what the curve adds to the evidence.

    Args:
        system: the products.
        bare: solved without the curve.
        level: at which.
        curve: its products.
    """
    normal, drive = left_of_curve(system, bare, level, curve)
    best = (np.zeros((len(drive), 0)), -np.inf)
    for length in _SMOOTH:
        root = np.ones((1, 1))
        for count in curve.shape:
            apart = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
            root = np.kron(root, np.linalg.cholesky(np.exp(-apart / length) + 1e-9 * np.eye(count)))
        curvatures, axes = np.linalg.eigh(root.T @ normal @ root)
        curvatures = np.maximum(curvatures, 0.0)
        along = (axes.T @ (root.T @ drive)) ** 2
        usual = float(np.mean(curvatures))
        if usual <= 0.0:
            continue
        for size in _SIZES / usual:
            worth = 0.5 * float(np.sum(size * along / (1.0 + size * curvatures) - np.log1p(size * curvatures)))
            if worth > best[1]:
                best = np.sqrt(size) * root, worth
    return best


def left_of_curve(system: CurveSystem, bare: Solved, level: Array, curve: CurveProducts) -> tuple[Array, Array]:
    """Return normal equations (m, m), (m,) of a curve's heights with everything else integrated out."""
    weight = system.weights(level)[curve.relation]
    cross, own, drive = curve.summed
    scaled = bare.scales[:, None] * (weight * cross)
    normal = weight * own - scaled.T @ cho_solve(bare.factor, scaled)
    return normal, -weight * (drive + cross.T @ bare.means)
