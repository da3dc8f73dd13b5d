"""What is predicted of a slider at a load between two that were tested."""

from pathlib import Path

import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.campaign import load_campaign
from slipwise.diagnosis.predicted_friction import PredictedFriction, predicted_friction
from slipwise.estimation.base_fit import fit_base
from unit.campaign.slider import write_at_loads

LOADS = {"one": 5.0, "two": 10.0, "three": 20.0, "between": 15.0}  # kN


def slider(folder: Path, power: float) -> PredictedFriction:
    """Foretell the run at 15 kN from those at 5, 10 and 20 kN; friction grows with a power of the load."""
    write_at_loads(folder, LOADS, power)
    (found,) = predicted_friction(fit_base(load_campaign(folder)))
    return found


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


def test_of_a_girder_nothing_is_predicted_by_its_mean() -> None:
    assert predicted_friction(fit_base(as_campaign(build_campaign(45048, effects=())))) == ()
