"""What one pad of many has, or has more of than the others, is named and measured pad by pad."""

from pathlib import Path

import pytest

import slipwise as sw
from recover.own_replay import campaign_of
from slipwise.model import base_model, use

pytestmark = pytest.mark.slow


@pytest.mark.long
def test_six_pads_of_unlike_friction_are_told_one_by_one(tmp_path: Path) -> None:
    levels = dict(zip("BCDEF", (0.06, -0.04, 0.0, 0.08, -0.05), strict=True))
    spread = use("pad_spread", along=0.0, **{f"level[{pad}]": level for pad, level in levels.items()})
    model = base_model("six_pads").adding(spread)
    found = sw.diagnose(campaign_of(tmp_path / "own", "six_pads", 100.0, model=model))
    assert found.verdict.effects == ("pad_spread",) and found.verdict.kind == "named", found.sentence
    for pad, level in levels.items():
        assert found.candidates[0].parameters[f"pad_spread.level[{pad}]"].value == pytest.approx(level, abs=0.003)


@pytest.mark.long
def test_a_patch_under_one_of_six_pads_is_found_there(tmp_path: Path) -> None:
    patch = use("position_patch", pad_a=0.0, place=0.006, width=0.005, **{"rise[E]": 0.25})
    model = base_model("six_pads").adding(patch)
    found = sw.diagnose(campaign_of(tmp_path / "own", "six_pads", 100.0, model=model))
    assert found.verdict.effects == ("position_patch",) and found.verdict.kind == "named", found.sentence
    for pad in "ABCDEF":
        expected = 0.25 if pad == "E" else 0.0
        value = found.candidates[0].parameters[f"position_patch.rise[{pad}]"].value
        assert value == pytest.approx(expected, abs=0.01)
