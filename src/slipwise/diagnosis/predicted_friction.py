"""What a model predicts of runs that no fit has seen: one slider's mean friction, with an interval.

A girder's balances judge it sample by sample. One slider's material may be far from any law of the catalogue, and then
what an engineer asks first is whether a load between two that were tested is predicted. Errors of the runs that were
fitted would flatter: three loads are met by any law of three numbers. Each is left out in turn instead, the others are
fitted, and what it is missed by is what a run not seen may be missed by (Stone 1974):

    F +- t sqrt[mean(e^2)]        e: by which each of the fitted runs is missed by a fit of the others
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import COVERAGE
from slipwise.estimation.least_squares import solve
from slipwise.estimation.run_data import FitRun

Array = NDArray[np.float64]
#: Where a fit of all runs but one ends [1].
_ENOUGH = 1.0


@dataclass(frozen=True)
class PredictedFriction:
    """Mean friction against the slip, over the samples at which a slider slides.

    Attributes:
        run: its name.
        measured: [N].
        value: what the model says [N].
        low: lower end of the 95 % interval [N].
        high: upper end [N].
    """

    run: str
    measured: float
    value: float
    low: float
    high: float

    @property
    def words(self) -> str:
        """Say it."""
        inside = "inside" if self.low <= self.measured <= self.high else "outside"
        said = f"{self.value:.3g} N ({self.low:.3g} to {self.high:.3g} N)"
        return f"{self.run}: mean friction {self.measured:.3g} N measured, {inside} what was predicted, {said}"


def predicted_friction(fit: BaseFit) -> tuple[PredictedFriction, ...]:
    """Foretell the held-out runs of one slider; nothing for a girder, or from a single run.

    Args:
        fit: of the model.
    """
    problem = fit.problem
    if problem.balanced or not problem.held_out or len(problem.fitted) < 2:
        return ()
    measured = np.array([_mean(run, run.force) for run in problem.runs])
    said = _said(problem.runs, fit.solution.residuals.pad_forces)
    misses = np.array([measured[i] - _said_without(fit, i) for i in problem.fitted])
    half = float(student.ppf(0.5 + COVERAGE / 2, len(misses)) * np.sqrt(np.mean(misses**2)))
    return tuple(
        PredictedFriction(
            problem.runs[i].name, float(measured[i]), float(said[i]), float(said[i]) - half, float(said[i]) + half
        )
        for i in problem.held_out
    )


def _said_without(fit: BaseFit, place: int) -> float:
    """Give what the model says of a run when it is fitted to the others [N]."""
    problem = copy(fit.problem)
    problem.runs = [replace(r, role="holdout") if i == place else r for i, r in enumerate(fit.problem.runs)]
    # from rated values: where all runs led, two of them may leave the third predicted by heart
    start = fit.solution.values | {f.key: f.start for f in fit.solution.free}
    found = solve(problem, start, fit.solution.free, enough=_ENOUGH)
    return float(_said(problem.runs, found.residuals.pad_forces)[place])


def _said(runs: Sequence[FitRun], forces: Sequence[Array]) -> Array:
    return np.array([_mean(run, force) for run, force in zip(runs, forces, strict=True)])


def _mean(run: FitRun, force: Array) -> float:
    """Give the mean of all pads' friction (n, p) against the slip [N]."""
    against = force.sum(axis=1) * np.sign(run.velocity)
    return float(np.mean(against[run.sliding])) if run.sliding.any() else 0.0
