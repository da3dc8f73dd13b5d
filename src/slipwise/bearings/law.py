"""Friction as the fitted law has it at the measured motion, and as other likely numbers of it would have it.

Likely numbers are drawn from the fit: a multivariate t of the fitted values, their covariance and the fit's degrees of
freedom. Forces follow them along their slopes at the fitted values, as the covariance does. What the load cells' noise
adds to a law that is fed with measured loads, F/N times that noise, is drawn too, sample by sample.

Source: Gelman et al., Bayesian Data Analysis, 3rd ed. (2013), section 4.1, for drawing from the normal approximation.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import COVERAGE, Intervals, compute_intervals
from slipwise.estimation.least_squares import STEP, with_slopes
from slipwise.estimation.objective import Objective, make_objective
from slipwise.relations.run_data import fit_runs
from slipwise.short_repr import short_repr

#: Draws, and the seed that makes them the same in every report.
_DRAWS, _SEED = 400, 1


@short_repr
@dataclass(frozen=True)
class LawForces:
    """Friction of the pads of one run by the fitted law.

    Attributes:
        pads: names.
        time: (n,) [s].
        force: (n, p, 1 + d) along x: at the fitted numbers, then at each draw [N].
    """

    pads: tuple[str, ...]
    time: Array
    force: Array


def predict_forces(base: BaseFit, uncut: Campaign, invalid: InvalidSamples) -> Mapping[str, LawForces]:
    """Return the forces of every run, by its name.

    Args:
        base: the fit.
        uncut: all samples of the runs, of which the fit may have seen stretches.
        invalid: run -> channel -> samples (n,) of these at which it is no measurement.
    """
    # a fit ends with slopes of a step before; along numbers that one load cannot tell apart they must be its own
    found = compute_intervals(replace(base, solution=with_slopes(base.objective, base.solution)))
    objective = _on_whole_runs(base, uncut, invalid)
    values = base.solution.values
    here = objective.residuals(values).pad_forces
    nearby, draws = objective.near(values), _draw(found)
    changes: list[Array] = [np.zeros((*force.shape, len(draws))) for force in here]
    for column, key in enumerate(found.keys):
        free = next(f for f in base.free if f.key == key)
        step = STEP * free.scale
        step = -step if values[key] + step > free.high else step
        moved = nearby.residuals({**values, key: values[key] + step}).pad_forces
        for change, there, force in zip(changes, moved, here, strict=True):
            change += ((there - force) / step)[..., None] * draws[:, column]
    rng = np.random.default_rng(_SEED + 1)
    for run, change, force in zip(objective.runs, changes, here, strict=True):
        noise = np.divide(force * run.gauge_noise[1], run.load, out=np.zeros_like(force), where=run.load > 0.0)
        change += noise[..., None] * rng.standard_normal(change.shape)
    return {
        run.name: LawForces(run.pads, run.time, np.concatenate([force[..., None], force[..., None] + change], axis=2))
        for run, force, change in zip(objective.runs, here, changes, strict=True)
    }


def interval(drawn: Array) -> tuple[float, float]:
    """Return the ends of the 95 % interval of a quantity: quantiles of its draws (d,), the first one left out."""
    known = drawn[1:][np.isfinite(drawn[1:])]
    if len(known) < 0.5 * len(drawn):
        return float("nan"), float("nan")
    low, high = np.quantile(known, [0.5 - 0.5 * COVERAGE, 0.5 + 0.5 * COVERAGE])
    return float(low), float(high)


def _draw(found: Intervals) -> Array:
    """Return how far likely numbers are from the fitted ones, (d, k) [SI]."""
    rng = np.random.default_rng(_SEED)
    freedom = max(found.blocks - len(found.keys), 2)
    root = np.linalg.cholesky(_definite(found.correlation))
    normal = rng.standard_normal((_DRAWS, len(found.keys))) @ root.T
    spread = np.sqrt(freedom / rng.chisquare(freedom, _DRAWS))[:, None]
    return normal * spread * np.sqrt(np.maximum(np.diag(found.covariance), 0.0))


def _definite(correlation: Array) -> Array:
    """Return a correlation (k, k) that has a root: numbers that the data cannot tell apart leave it a little short."""
    size, ways = np.linalg.eigh(0.5 * (correlation + correlation.T))
    return (ways * np.maximum(size, 1e-12)) @ ways.T


def _on_whole_runs(base: BaseFit, uncut: Campaign, invalid: InvalidSamples) -> Objective:
    """Return the objective of the fit on all samples of the runs; the fit's own where it has seen them all."""
    lengths = [len(run.record) for run in base.campaign.runs]
    if lengths == [len(run.record) for run in uncut.runs]:
        return base.objective
    one = base.objective.run(0)
    runs = fit_runs(replace(base.campaign, runs=uncut.runs), invalid)
    whole = [replace(run, fine=one.fine, noise=one.noise) for run in runs]
    objective = make_objective(whole, base.objective.specimen, base.objective.terms)
    objective = objective.with_yaw() if base.objective.yaw else objective
    return objective.weigh(base.solution.values)
