"""Intervals of fitted numbers that stay right when residuals are correlated: the sandwich with blocks of time.

    C = A^-1 (sum over blocks of s s') A^-1,    A = J'J,    s = sum of J_t' r_t over a block

Residuals of pads and balances at one instant share gauges, and neighbours share what the model lacks: a block holds
all relations over a stretch of time, of all runs of one motion, and only blocks are taken as independent. How long they
must be for that the correlation of the residuals tells; none is shorter than a cycle of the motion. The usual formula,
one variance for all rows, covers the truth in 15 to 40 % of the cases when residuals are correlated.

What a whole run shares is no block's scatter: pads and cards that reverse some hundredths of a millisecond early or
late, or more gently than the law says. Both, of each pad in each run, are nuisances of known size, and what they could
do to a number is added:

    C += sum of g g',    g = A^-1 J' (timing * dF/dt / sigma),    and with |dF/dt| along F in place of dF/dt

A gauge that lags, by a delay or a filter, stands on a card that may lag by itself: its timing is added too.

Source: White (1980), Newey and West (1987); blocks as clusters: Liang and Zeger (1986); docs/theory.md, section 3.3.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm
from scipy.stats import t as student

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.profile_likelihood import find_upper_limit, is_strength
from slipwise.jobs.parallel import on_every_core
from slipwise.noise.independent_samples import SHORTEST_BLOCK, measure_block_length
from slipwise.relations.noise import TIMING
from slipwise.relations.parameters import Free
from slipwise.short_repr import short_repr

Shared = tuple[Array, NDArray[np.int64]]
#: Fewer blocks than this many for each free number are no basis; blocks are then made shorter [1].
_BLOCKS_EACH = 3
#: How often an interval holds the truth [1].
COVERAGE = 0.95
#: Standard deviation of the timing that a pad and its cards share over a run: anywhere within +-`TIMING` [s].
_SHARED_TIMING = TIMING / np.sqrt(3.0)


@dataclass(frozen=True)
class Interval:
    """One fitted number.

    Attributes:
        key: "rig.mass", "shear_rate.rate" ...
        value: fitted [SI].
        low: lower end of the 95 % interval; NaN where the fit ended on a bound.
        high: upper end.
        rated: where the fit began.
        unit: SI unit.
        bound: "", or "lower" or "upper" when the fit ended there.
        limit: "", or "upper" for a strength that may be absent: `high` is what it is at most, with 95 %, from the
            profile of the likelihood, and `low` its lower bound.
    """

    key: str
    value: float
    low: float
    high: float
    rated: float
    unit: str
    bound: str
    limit: str = ""

    @property
    def figures(self) -> int:
        """Figures to write it with: four, or so many that its half width keeps two and does not shrink to nothing."""
        return count_figures(self.low, self.high)


@short_repr
@dataclass(frozen=True)
class Intervals:
    """All fitted numbers with what ties them together.

    Attributes:
        entries: one for each free number.
        keys: of the numbers inside their bounds, in the order of the matrices.
        covariance: (k, k) of these numbers [SI].
        correlation: (k, k) [1].
        blocks: stretches of time taken as independent.
    """

    entries: tuple[Interval, ...]
    keys: tuple[str, ...]
    covariance: Array
    correlation: Array
    blocks: int

    def strongest(self, count: int = 5) -> list[tuple[str, str, float]]:
        """Return the pairs of numbers that the data tell apart worst: (key, key, correlation)."""
        i, j = np.triu_indices(len(self.keys), 1)
        order = np.argsort(-np.abs(self.correlation[i, j]))[:count]
        return [(self.keys[i[o]], self.keys[j[o]], float(self.correlation[i[o], j[o]])) for o in order]


def count_figures(low: float, high: float) -> int:
    """Return the figures with which to write an interval: four, or so many that its half width keeps two."""
    half, size = 0.5 * (high - low), max(abs(low), abs(high))
    return max(4, int(np.ceil(np.log10(size / half))) + 2) if np.isfinite(half) and half > 0.0 else 4


def compute_halfwidth(error: float) -> float:
    """Return half the width of the interval of a number with this standard error, in its unit."""
    return error * float(norm.ppf(0.5 + COVERAGE / 2))


def compute_standard_error(low: float, high: float) -> float:
    """Return the standard error for which an interval stands, in its unit."""
    return 0.5 * (high - low) / compute_halfwidth(1.0)


def compute_intervals(base: BaseFit) -> Intervals:
    """Return the intervals of a base fit."""
    solution, rows = base.solution, _rows(base)
    found = _two_sided(base, *rows)
    low = [j for j, f in enumerate(solution.free) if is_strength(base, f) and not found.entries[j].low > f.low]
    limits = on_every_core(
        lambda i: _limited(base, found.entries, low[i], *rows),
        len(low),
        memory=solution.fit_memory,
    )
    limited = dict(zip(low, limits, strict=True))
    return replace(found, entries=tuple(limited.get(j, e) for j, e in enumerate(found.entries)))


def compute_two_sided_intervals(base: BaseFit) -> Intervals:
    """Return the intervals of a base fit, those of strengths that may be absent two-sided as all others."""
    return _two_sided(base, *_rows(base))


def _two_sided(base: BaseFit, left: Array, block: NDArray[np.int64], shared: Shared) -> Intervals:
    solution, objective = base.solution, base.objective
    found = compute_fit_intervals(solution.free, solution.values, solution.jacobian, left, block, shared)
    own_lag = {f"{t.label}.{t.effect.lag}" for t in objective.terms if t.effect.lag}
    ends = {f.key: (f.low, f.high) for f in solution.free}
    entries = (_widened_by_card_delay(e, *ends[e.key]) if e.key in own_lag else e for e in found.entries)
    return replace(found, entries=tuple(entries))


def _rows(base: BaseFit) -> tuple[Array, NDArray[np.int64], Shared]:
    """Return the residual (m,), the block of time of every row (m,), and what a run's timing does to it."""
    solution, objective = base.solution, base.objective
    rows: list[NDArray[np.int64]] = []
    start = 0
    offsets: dict[int, int] = {}
    length = _block_length(base)
    for group in objective.motions:  # runs of one motion repeat what the model lacks
        offsets |= dict.fromkeys(group, start)
        start += max(int(len(objective.run(i).time) * objective.run(i).dt / length) + 1 for i in group)
    for of in solution.residuals.blocks(runs=objective.fitted):
        of_sample = (np.arange(len(of.time)) * of.dt / length).astype(np.int64) + offsets[of.run]
        rows.append(np.repeat(of_sample, of.columns.shape[1]))
    left = solution.residuals.stacked(objective.fitted)
    return left, np.concatenate(rows), _shared(base, len(left))


def _shared(base: BaseFit, count: int) -> Shared:
    """Return what a run's and pad's own timing of its reversals would do to the residuals."""
    objective, residuals = base.objective, base.solution.residuals
    moved, whose = np.zeros((2, count)), np.zeros(count, dtype=np.int64)
    timing = _SHARED_TIMING * objective.scales.time
    friction = ((rows, of) for rows, of in residuals.rows(objective.fitted) if of.relation == "pads")
    for place, (rows, of) in enumerate(friction):
        force = residuals.pad_forces[of.run]
        rate = np.gradient(force, of.dt, axis=0) / of.sigma
        rate = timing * np.where(of.mask, rate, 0.0)
        pads = rate.shape[1]
        moved[0, rows] = rate.ravel()
        moved[1, rows] = (np.abs(rate) * np.sign(force)).ravel()
        whose[rows] = np.tile(place * pads + np.arange(pads), len(rate))
    return moved, whose


def _widened_by_card_delay(entry: Interval, lowest: float, highest: float) -> Interval:
    """Widen a gauge's lag by that of its card: beside the effect the two are one number."""
    half = float(np.hypot(0.5 * (entry.high - entry.low), student.ppf(0.5 + COVERAGE / 2, np.inf) * _SHARED_TIMING))
    return replace(entry, low=max(entry.value - half, lowest), high=min(entry.value + half, highest))


def _limited(
    base: BaseFit, entries: Sequence[Interval], place: int, left: Array, block: NDArray[np.int64], shared: Shared
) -> Interval:
    """Return the one-sided interval of a strength whose two-sided one would reach below what can be."""
    free, slopes = base.solution.free[place], base.solution.jacobian
    inside = [k for k, e in enumerate(entries) if k == place or (not e.bound and np.any(slopes[:, k]))]
    here = inside.index(place)
    plain, robust, freedom = _variances(slopes, inside, left, block, shared)
    reach = float(student.ppf(COVERAGE, freedom))
    inflation = float(robust[here, here] / plain[here, here]) if plain[here, here] > 0.0 else 1.0
    guess = reach * float(np.sqrt(robust[here, here])) * free.scale or free.scale
    high = find_upper_limit(base, free, guess, reach**2 * inflation)
    return replace(entries[place], low=free.low, high=high, limit="upper")


def compute_fit_intervals(
    free: Sequence[Free],
    values: Mapping[str, float],
    jacobian: Array,
    residual: Array,
    block: NDArray[np.int64],
    shared: Shared | None = None,
) -> Intervals:
    """Return the intervals of a least-squares fit.

    Args:
        free: what was fitted, k numbers.
        values: where the fit ended.
        jacobian: (m, k) of the residuals, per unit of each number's scale.
        residual: (m,) in units of the noise; rows that were masked are zero.
        block: (m,) number of the block of time that each row belongs to.
        shared: (q, m) what q kinds of nuisances of unit size would do to the residuals, and (m,) which nuisance of each
            kind a row belongs to.
    """
    ends = [find_bound(f, values[f.key]) for f in free]
    inside = [j for j, end in enumerate(ends) if not end and np.any(jacobian[:, j])]
    scale = np.array([free[j].scale for j in inside])
    _, robust, freedom = _variances(jacobian, inside, residual, block, shared)
    covariance = robust * np.outer(scale, scale)
    blocks = freedom + len(inside)
    deviation = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    reach = float(student.ppf(0.5 + COVERAGE / 2, freedom)) * deviation
    entries = []
    for j, (f, end) in enumerate(zip(free, ends, strict=True)):
        value = values[f.key]
        half = float(reach[inside.index(j)]) if j in inside else float("nan")
        low, high = value - half, value + half
        entries.append(Interval(f.key, value, max(low, f.low), min(high, f.high), f.start, f.unit, end))
    outer = np.outer(deviation, deviation)
    correlation = np.divide(covariance, outer, out=np.zeros_like(covariance), where=outer > 0.0)
    return Intervals(tuple(entries), tuple(free[j].key for j in inside), covariance, correlation, blocks)


def _variances(
    jacobian: Array, inside: Sequence[int], residual: Array, block: NDArray[np.int64], shared: Shared | None
) -> tuple[Array, Array, int]:
    """Return the covariance (k, k) under white noise of unit size, the sandwich, and the degrees of freedom.

    Only the numbers inside count. Their columns are not put into an array of their own, which would be as large again.
    """
    counted = np.bincount(block, weights=(residual != 0.0).astype(float))
    blocks = int(np.count_nonzero(counted))
    scores = _sums(jacobian, inside, residual, block)
    normal = (jacobian.T @ jacobian)[np.ix_(inside, inside)]
    bread = np.asarray(np.linalg.pinv(normal, rcond=1e-12, hermitian=True), dtype=np.float64)
    freedom = max(blocks - len(inside), 2)  # each fitted number takes one block's freedom
    meat = scores.T @ scores * (blocks / freedom)
    if shared is not None:
        pulled = np.concatenate([_sums(jacobian, inside, kind, shared[1]) for kind in shared[0]])
        meat = meat + pulled.T @ pulled
    return bread, bread @ meat @ bread, freedom


def _sums(jacobian: Array, inside: Sequence[int], values: Array, label: NDArray[np.int64]) -> Array:
    """Add up the columns inside of the Jacobian (m, n) times values (m,) over the rows of each label, (labels, k)."""
    # number by number: the product of all is as long as the runs together, for each of them
    out = np.zeros((int(label.max(initial=-1)) + 1, len(inside)))
    for number, column in enumerate(inside):
        out[:, number] = np.bincount(label, weights=jacobian[:, column] * values)
    return out


def find_bound(free: Free, value: float) -> str:
    """Return the bound on which a fitted number has ended: "lower", "upper" or ""."""
    if value - free.low < 1e-6 * free.scale:
        return "lower"
    return "upper" if free.high - value < 1e-6 * free.scale else ""


def _block_length(base: BaseFit) -> float:
    """Return how long a block must be for blocks to be as good as independent [s]."""
    objective, left = base.objective, base.solution.residuals
    longest = max(
        measure_block_length([b.value for b in left.blocks(r, objective.fitted)]) for r in objective.relations
    )
    independent = max(objective.fitted_runs[0].dt * longest, SHORTEST_BLOCK * objective.scales.time)
    seconds = sum(float(run.time[-1] - run.time[0]) for run in objective.fitted_runs)
    return min(independent, seconds / (_BLOCKS_EACH * max(len(base.free), 1)))
