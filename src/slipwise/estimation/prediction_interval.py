"""Is the mean friction of a run that no fit has seen predicted, within what one run differs from another?

A fit's own interval is about its numbers; a run of another day, pressure or speed differs by more. How much is seen by
what each fitted run is missed by (Stone 1974), and for one further run

    F +- t(0.975, n) sqrt[mean(e^2)],        e: measured less predicted mean friction of each of n fitted runs

Of one slider each run is left out in turn and the others are fitted: three loads are met by any law of three numbers,
and what a fit leaves of them would flatter. A girder's runs are thousands of samples of several balances against some
twenty numbers, so that what the fit leaves of a run is what a run is missed by.

Source: Stone (1974), Journal of the Royal Statistical Society B 36:111-147; Hahn & Meeker, Statistical Intervals, 1991.
"""

from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import COVERAGE
from slipwise.estimation.least_squares import solve
from slipwise.relations.run_data import FitRun

#: Fitted runs below which nothing is known of how runs differ.
_LEAST_RUNS = 2
#: Where a fit of all runs but one ends [1].
_ENOUGH = 1.0


@dataclass(frozen=True)
class PredictedFriction:
    """Mean friction of one pad against the slip, over the samples at which it slides, in one run.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        measured: [N].
        value: predicted by the fitted law [N].
        low: lower end of the 95 % prediction interval of a held-out run [N]; NaN for a fitted run, or where fewer than
            two runs were fitted.
        high: upper end [N].
    """

    run: str
    role: str
    measured: float
    value: float
    low: float
    high: float

    @property
    def inside(self) -> bool | None:
        """Whether the measured value lies in the interval; None where there is none."""
        return None if np.isnan(self.low) else bool(self.low <= self.measured <= self.high)

    @property
    def words(self) -> str:
        """Say it, in kN where it is more than one."""
        unit, size = ("kN", 1e3) if abs(self.measured) >= 1e3 else ("N", 1.0)
        measured, value, low, high = (f"{x / size:.3g}" for x in (self.measured, self.value, self.low, self.high))
        found = f"{self.run}: mean friction {measured} {unit} measured"
        if self.inside is None:
            return f"{found}, {value} {unit} predicted, interval unknown"
        where = "inside" if self.inside else "outside"
        return f"{found}, {where} what was predicted, {value} {unit} ({low} to {high} {unit})"


def predict_friction(fit: BaseFit) -> tuple[PredictedFriction, ...]:
    """Return measured and predicted mean friction of every run that slides; nothing where no friction was measured.

    Args:
        fit: of any model.
    """
    objective = fit.objective
    if not objective.forces_measured:
        return ()
    measured = [_mean(run, run.force) for run in objective.runs]
    predicted = [_mean(*both) for both in zip(objective.runs, fit.solution.residuals.pad_forces, strict=True)]
    slid = [i for i in objective.fitted if np.isfinite(measured[i])]
    half = float("nan")
    if objective.held_out and len(slid) >= _LEAST_RUNS:
        alone = not objective.balanced
        misses = [measured[i] - (_predicted_without(fit, i) if alone else predicted[i]) for i in slid]
        half = float(student.ppf(0.5 + COVERAGE / 2.0, len(misses)) * np.sqrt(np.mean(np.square(misses))))
    return tuple(
        PredictedFriction(
            run.name,
            run.role,
            measured[i],
            predicted[i],
            *((predicted[i] - half, predicted[i] + half) if run.role == "holdout" else (float("nan"),) * 2),
        )
        for i, run in enumerate(objective.runs)
        if np.isfinite(measured[i])
    )


def _predicted_without(fit: BaseFit, place: int) -> float:
    """Return the mean friction of a run when the law is fitted to the others [N]."""
    objective = fit.objective.with_held_out(place)
    # from rated values: where all runs led, two of them may predict the third exactly (overfit)
    start = fit.solution.values | {f.key: f.start for f in fit.solution.free}
    found = solve(objective, start, fit.solution.free, enough=_ENOUGH)
    return _mean(objective.run(place), found.residuals.pad_forces[place])


def _mean(run: FitRun, force: Array) -> float:
    """Return the mean of one pad's friction (n, p) against the slip while it slides [N]; NaN where it never does."""
    kept = run.sliding & (run.velocity != 0.0)
    return float(np.mean(force[kept] * np.sign(run.velocity[kept])[:, None])) if kept.any() else float("nan")
