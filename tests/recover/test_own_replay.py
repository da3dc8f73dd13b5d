"""A rig's own replay with the noise of gauges lacks nothing, however many pads the rig has."""

from pathlib import Path

import pytest

import slipwise as sw
from recover.own_replay import campaign_of

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("rig", "corner"),
    [
        ("three_pads", 100.0),
        ("six_pads", 100.0),
        *(pytest.param(rig, 100.0, marks=pytest.mark.long) for rig in ("pendulum", "building")),
        *(pytest.param(rig, None, marks=pytest.mark.long) for rig in ("bridge1", "three_pads", "pendulum")),
    ],
)
def test_a_rigs_own_replay_lacks_nothing(tmp_path: Path, rig: str, corner: float | None) -> None:
    """Without a filter too, where nobody knows at which instant between two samples friction turned round."""
    found = sw.diagnose(campaign_of(tmp_path / "own", rig, corner))
    assert found.verdict.kind == "complete", found.sentence
