"""What is predicted of a slider at a load between two that were tested."""

from pathlib import Path

import pytest

from measured import fit_base
from slipwise.campaign import load_campaign
from slipwise.estimation.prediction_interval import PredictedFriction, predict_friction
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign
from unit.campaign.slider import write_at_loads

LOADS = {"one": 5.0, "two": 10.0, "three": 20.0, "between": 15.0}  # kN


def slider(folder: Path, power: float) -> PredictedFriction:
    """Predict the run at 15 kN from those at 5, 10 and 20 kN; friction grows with a power of the load."""
    write_at_loads(folder, LOADS, power)
    return predict_friction(fit_base(load_campaign(folder)))[-1]


@pytest.mark.parametrize("power", [1.0, 0.5])
def test_a_load_between_is_predicted_inside_the_interval(tmp_path: Path, power: float) -> None:
    found = slider(tmp_path, power)
    assert found.run == "between"
    assert found.measured == pytest.approx(1000.0 * 1.5**power, rel=0.02)
    assert found.low < found.measured < found.high, found.words
    assert "inside what was predicted" in found.words


def test_a_law_that_fits_predicts_more_closely_than_one_that_does_not(tmp_path: Path) -> None:
    spans = []
    for power in (1.0, 0.2):
        folder = tmp_path / str(power)
        folder.mkdir()
        found = slider(folder, power)
        spans.append((found.high - found.low) / found.value)
    assert spans[0] < 0.1 < spans[1]


@pytest.mark.slow
def test_a_girder_s_held_out_runs_are_inside_what_its_fitted_runs_are_missed_by() -> None:
    found = predict_friction(fit_base(as_campaign(build_campaign(45048, effects=()))))
    assert all(run.inside is (None if run.role != "holdout" else True) for run in found)
    assert all(run.high - run.low < 0.05 * run.value for run in found if run.role == "holdout")


def test_one_fitted_run_says_nothing_of_how_runs_differ(tmp_path: Path) -> None:
    write_at_loads(tmp_path, {"one": 5.0, "between": 15.0}, 1.0)
    assert predict_friction(fit_base(load_campaign(tmp_path)))[-1].inside is None
