"""Is the mean friction of a run that no fit has seen predicted, within what one run differs from another?

A fit's own interval is about its numbers; a run of another day, pressure or speed differs by more. How much, the fitted
runs show: ratio r = measured / predicted of each, and for one further run (prediction interval of a normal sample)

    said [mean(r) +- t(0.975, n - 1) std(r) sqrt(1 + 1/n)].

Source: Hahn & Meeker (1991), Statistical Intervals, section 4.7.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import COVERAGE

Array = NDArray[np.float64]
#: Fitted runs below which their scatter is unknown.
_LEAST_RUNS = 2


@dataclass(frozen=True)
class PredictedFriction:
    """Mean friction of one pad while sliding, in one run.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        measured: along the motion [N].
        said: by the fitted law [N].
        low: lower end of the 95 % interval for a run that was not fitted [N]; NaN for a fitted run, or where fewer than
            two runs were fitted.
        high: upper end [N].
    """

    run: str
    role: str
    measured: float
    said: float
    low: float
    high: float

    @property
    def inside(self) -> bool | None:
        """Whether the measured value lies in the interval; None where there is none."""
        return None if np.isnan(self.low) else bool(self.low <= self.measured <= self.high)


def predicted_friction(base: BaseFit) -> tuple[PredictedFriction, ...]:
    """Give measured and predicted mean friction of every run that slides.

    Args:
        base: a fit.
    """
    problem = base.problem
    means: list[tuple[float, ...] | None] = []
    for run, said in zip(problem.runs, base.solution.residuals.pad_forces, strict=True):
        kept = run.sliding & (run.velocity != 0.0)
        along = np.sign(run.velocity[kept])[:, None]
        both = (float(np.mean(f[kept] * along)) for f in (run.force, said)) if kept.any() else ()
        means.append(tuple(both) or None)
    scatter = [m[0] / m[1] for i in problem.fitted if (m := means[i]) is not None and m[1] != 0.0]
    out = []
    for i, run in enumerate(problem.runs):
        mean = means[i]
        if mean is None:
            continue
        ends = _ends(mean[1], scatter) if i in problem.held_out else (float("nan"), float("nan"))
        out.append(PredictedFriction(run.name, run.role, mean[0], mean[1], *ends))
    return tuple(out)


def _ends(said: float, ratios: Sequence[float]) -> tuple[float, float]:
    count = len(ratios)
    if count < _LEAST_RUNS:
        return float("nan"), float("nan")
    reach = float(student.ppf(0.5 + COVERAGE / 2.0, count - 1) * np.std(ratios, ddof=1) * np.sqrt(1.0 + 1.0 / count))
    middle = float(np.mean(ratios))
    low, high = sorted((said * (middle - reach), said * (middle + reach)))
    return low, high
