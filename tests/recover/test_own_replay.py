"""A rig's own replay with the noise of gauges lacks nothing, however many pads the rig has."""

from pathlib import Path

import pytest

import slipwise as sw
from recover.own_replay import campaign_of

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("rig", "corner", "rate"),
    [
        pytest.param("six_pads", 100.0, 500.0, marks=pytest.mark.long),
        pytest.param("three_pads", None, 2000.0, marks=pytest.mark.long),
        pytest.param("pendulum", 40.0, 100.0, marks=pytest.mark.long),
        *(pytest.param(rig, 100.0, 500.0, marks=pytest.mark.long) for rig in ("three_pads", "pendulum", "building")),
        *(pytest.param(rig, None, 500.0, marks=pytest.mark.long) for rig in ("bridge1", "three_pads", "pendulum")),
    ],
)
def test_a_rigs_own_replay_lacks_nothing(tmp_path: Path, rig: str, corner: float | None, rate: float) -> None:
    """Without a filter too, where nobody knows at which instant between two samples friction turned round.

    At 2 kHz samples are thinned out, and three pads lift: neither may be left beside the floor.
    """
    found = sw.diagnose(campaign_of(tmp_path / "own", rig, corner, rate=rate))
    assert found.verdict.kind == "complete", found.sentence
    if corner or rate > 1000.0:  # else what turns round gently between two samples is anybody's guess
        assert found.base_error < 1.5, found.relations


@pytest.mark.parametrize("rig", ["bridge1", pytest.param("building", marks=pytest.mark.long)])
def test_a_simulation_without_noise_lacks_nothing(tmp_path: Path, rig: str) -> None:
    found = sw.diagnose(campaign_of(tmp_path / "own", rig, None, runs=2, noisy=False))
    assert found.verdict.kind == "complete", found.sentence
