"""Intervals of a law's constants that hold: the widest of three answers to how far the data leave them open.

    the sandwich of the fit        what stretches of time scatter, see `estimation.intervals`
    the joint posterior            what every candidate of the catalogue as dirt can do for the law, samples counted as
                                   few: a model's own small errors are systematic
    the jackknife over runs        what leaving out one motion, or a part of one, changes

Source: Miller, Dunson (2019), JASA 114 (coarsened posterior); Busing, Meijer, van der Leeden (1999), Statistics and
Computing 9 (delete-m jackknife); docs/theory.md, section 3.5.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

from slipwise.arrays import Array
from slipwise.discovery.curve_search import weigh_catalogue
from slipwise.discovery.curve_system import CurveSystem
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import COVERAGE, Interval, compute_halfwidth, compute_two_sided_intervals

#: Parts of the record that are left out by turns, at least: motions, or parts of motions of equal length.
_PARTS = 6


def compute_law_intervals(fit: BaseFit, system: CurveSystem | None) -> dict[str, Interval]:
    """Return key -> interval of every number of a fit with laws.

    Args:
        fit: its solution that with the laws, with slopes of its own.
        system: the joint system at that fit; None where there is none.
    """
    deviations = _posterior_deviations(fit, system) if system is not None else {}
    jackknifed = _jackknife(fit)
    out: dict[str, Interval] = {}
    ends = {f.key: (f.low, f.high) for f in fit.solution.free}
    for entry in compute_two_sided_intervals(fit).entries:
        half = np.nanmax([0.5 * (entry.high - entry.low), deviations.get(entry.key, 0.0), jackknifed[entry.key]])
        low, high = entry.value - half, entry.value + half
        known = {"low": max(low, ends[entry.key][0]), "high": min(high, ends[entry.key][1])}
        out[entry.key] = entry if entry.bound else replace(entry, **known)
    return out


def _posterior_deviations(fit: BaseFit, system: CurveSystem) -> Mapping[str, float]:
    """Return key -> half width of the interval of the joint posterior, with the catalogue as dirt."""
    scales = {f.key: f.scale for f in fit.solution.free}
    spread = np.sqrt(np.maximum(np.diag(weigh_catalogue(system).solved.covariance()), 0.0))
    return {k: compute_halfwidth(float(spread[j]) * scales[k]) for j, k in enumerate(system.keys) if k in scales}


def _jackknife(fit: BaseFit) -> dict[str, float]:
    """Return key -> half width by what one Gauss-Newton step does without each part of the record in turn."""
    solution = fit.solution
    part, ends = _parts(fit), set(solution.at_bounds)
    inside = [j for j, f in enumerate(solution.free) if f.key not in ends]
    slopes = solution.jacobian[:, inside]
    left = solution.residuals.stacked(fit.objective.fitted)
    normal, drive = slopes.T @ slopes, slopes.T @ left
    moved = []
    for number in np.unique(part):
        here = part == number
        own = slopes[here]
        less = np.linalg.pinv(normal - own.T @ own, rcond=1e-10, hermitian=True)
        moved.append(-less @ (drive - own.T @ left[here]))
    moves = np.array(moved)
    count = len(moves)
    variance = (count - 1) / count * np.sum((moves - moves.mean(axis=0)) ** 2, axis=0)
    half = float(student.ppf(0.5 + COVERAGE / 2, count - 1)) * np.sqrt(variance)
    widths = dict.fromkeys((f.key for f in solution.free), 0.0)
    return widths | {solution.free[j].key: float(half[k] * solution.free[j].scale) for k, j in enumerate(inside)}


def _parts(fit: BaseFit) -> NDArray[np.int64]:
    """Return the part of the record that each stacked row belongs to: runs of one motion are left out together."""
    objective = fit.objective
    motions = objective.motions
    each = max(1, -(-_PARTS // len(motions)))
    number = {place: k for k, group in enumerate(motions) for place in group}
    rows: list[Array] = []
    for of in fit.solution.residuals.blocks(runs=objective.fitted):
        stretch = np.minimum(np.arange(len(of.time)) * each // len(of.time), each - 1)
        rows.append(np.repeat(number[of.run] * each + stretch, of.columns.shape[1]))
    return np.concatenate(rows).astype(np.int64)
