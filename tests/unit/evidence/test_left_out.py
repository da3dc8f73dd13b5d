"""Leaving a motion out by one Gauss-Newton step is a refit without it, where the model is linear."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base
from slipwise.estimation.objective import Objective, make_objective
from slipwise.evidence.left_out import LinearFit, leave_motions_out


@pytest.fixture(scope="module")
def objective() -> Objective:
    return base(held_out=False).objective


def linear(objective: Objective, numbers: int) -> LinearFit:
    """A straight-line model of random slopes, fitted to noise."""
    rng = np.random.default_rng(3)
    count = len(objective.layout.stacked(objective.fitted))
    slopes, wanted = rng.normal(size=(count, numbers)), rng.normal(size=count)
    wide = np.full(numbers, 1e9)
    residual = wanted - slopes @ np.linalg.lstsq(slopes, wanted, rcond=None)[0]
    return LinearFit(residual, slopes, -wide, wide, numbers)


def test_it_is_what_a_refit_without_the_motion_leaves_of_it(objective: Objective) -> None:
    fit = linear(objective, 5)
    predicted = leave_motions_out(objective, fit)
    first = np.zeros(len(fit.residual), dtype=bool)
    for here, block in objective.layout.rows(objective.fitted):
        first[here] = block.run == objective.fitted[0]
    step = np.linalg.lstsq(fit.slopes[~first], -fit.residual[~first], rcond=None)[0]
    expected = fit.residual[first] + fit.slopes[first] @ step
    assert predicted[first] == pytest.approx(expected, abs=1e-3)


def test_a_number_that_only_one_motion_tells_keeps_its_value_without_it(objective: Objective) -> None:
    fit = linear(objective, 3)
    only = np.zeros_like(fit.slopes)
    only[: objective.runs[objective.fitted[0]].judged["pads"].size, 0] = 1.0  # the pads of the first run
    alone = replace(fit, slopes=only[:, :1], low=fit.low[:1], high=fit.high[:1])
    assert np.isfinite(leave_motions_out(objective, alone)).all()
    assert np.abs(leave_motions_out(objective, alone) - alone.residual).max() < 1.0


def test_a_repeat_is_left_out_with_the_run_that_it_repeats(objective: Objective) -> None:
    runs = [*objective.runs, replace(objective.runs[1], role="repeat")]
    again = make_objective(runs, objective.specimen, objective.terms)
    assert again.measurements.motions == [[0], [1, 2]]


def test_runs_that_are_given_twice_are_left_out_together_whatever_their_role(objective: Objective) -> None:
    again = make_objective([*objective.runs, *objective.runs], objective.specimen, objective.terms)
    fit = linear(again, 5)
    predicted = leave_motions_out(again, fit)
    out = np.zeros(len(fit.residual), dtype=bool)
    for here, block in again.layout.rows(again.fitted):
        out[here] = block.run in (0, 2)
    step = np.linalg.lstsq(fit.slopes[~out], -fit.residual[~out], rcond=None)[0]
    assert predicted[out] == pytest.approx(fit.residual[out] + fit.slopes[out] @ step, abs=1e-3)


def test_of_one_motion_stretches_of_time_are_left_out() -> None:
    single = base().objective  # the other run is held out
    fit = linear(single, 4)
    predicted = leave_motions_out(single, fit)
    assert single.measurements.motions == [[0]]
    assert not np.array_equal(predicted, fit.residual)
    assert float(predicted @ predicted) > float(fit.residual @ fit.residual)
