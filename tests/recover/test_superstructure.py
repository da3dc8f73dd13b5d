"""A frame that is not as its file says is named, with its numbers; one that is as stated is not accused."""

from pathlib import Path

import pytest

import slipwise as sw
from recover.own_replay import campaign_of
from slipwise.model import base_model, use

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("stiffness", "damping", "corner"), [(0.85, 0.01, 100.0), pytest.param(1.3, 0.0, None, marks=pytest.mark.long)]
)
def test_a_frame_that_is_not_as_stated_is_named(
    tmp_path: Path, stiffness: float, damping: float, corner: float | None
) -> None:
    model = base_model("building").adding(use("superstructure", stiffness=stiffness, damping=damping))
    found = sw.diagnose(campaign_of(tmp_path / "softer", "building", corner, model=model))
    assert found.verdict.kind == "named" and found.verdict.effects == ("superstructure",), found.sentence
    values = found.candidates[0].parameters
    assert values["superstructure.stiffness"].value == pytest.approx(stiffness, rel=0.02)
    assert values["superstructure.damping"].value == pytest.approx(damping, abs=0.003)
