"""Mean friction of an unseen run, and how far one run may be from another."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.prediction_interval import predicted_friction


def with_friction(ratios: list[float], held_out: float) -> BaseFit:
    """A fit of runs whose measured friction is 100 N times a ratio while they slide, and whose law says 100 N."""
    made = base()
    run = made.problem.runs[0]
    predicted = 100.0 * np.sign(run.velocity)[:, None] * np.ones(4)
    roles = [*("fit" for _ in ratios), "holdout"]
    runs = [
        replace(run, name=f"run{i}", role=role, force=ratio * predicted)
        for i, (role, ratio) in enumerate(zip(roles, [*ratios, held_out], strict=True))
    ]
    residuals = replace(made.solution.residuals, pad_forces=[predicted] * len(runs))
    solution = replace(made.solution, residuals=residuals)
    return replace(made, problem=replace(made.problem, runs=runs), solution=solution)


def test_an_unseen_run_like_the_others_is_predicted():
    last = predicted_friction(with_friction([0.98, 1.0, 1.02], 1.01))[-1]
    assert (last.measured, last.said) == (pytest.approx(101.0), pytest.approx(100.0))
    # t(0.975, 2) = 4.303, scatter 0.02, one further run: 4.303 * 0.02 * sqrt(1 + 1/3)
    assert last.high - last.low == pytest.approx(200.0 * 4.3027 * 0.02 * np.sqrt(4.0 / 3.0), rel=1e-4)
    assert last.inside


def test_an_unseen_run_far_from_the_others_is_not():
    assert predicted_friction(with_friction([0.98, 1.0, 1.02], 1.3))[-1].inside is False


def test_one_fitted_run_says_nothing_of_scatter():
    assert predicted_friction(with_friction([1.0], 1.3))[-1].inside is None
