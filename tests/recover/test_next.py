"""What a diagnosis says of the next test, of rivals, and of the ladder that it climbed."""

from importlib.resources import files
from pathlib import Path

import pytest

from slipwise.diagnose import diagnose
from slipwise.ladder import ladder_of
from slipwise.next_test import Limits, next_test, rivals
from slipwise.view.diagnosis_page import diagnosis_page


@pytest.fixture(scope="module")
def found():
    return diagnose(Path(str(files("slipwise"))) / "demo_data")


def test_a_rival_is_no_mere_addition_to_the_best(found):
    best, rival = rivals(found)
    assert set(best.names) == {"run_in"}
    assert not set(best.names) <= set(rival.names)


def test_a_motion_that_slides_tells_rivals_apart_and_one_that_sticks_does_not(found):
    slow, fast, far = "sine:0.5Hz,0.03g,cycles=9", "quake:seed=2,peak=0.7g,f=4Hz,strong=3s", "sine:0.5Hz,0.5g,cycles=9"
    ranked = next_test(found, Limits(stroke=0.2), library=(slow, far, fast))
    assert [p.motion for p in ranked.proposals] == [fast, slow, far]
    first, second, refused = ranked.proposals
    assert first.separation > 1.0 > 0.1 > second.separation
    assert "stroke" in refused.refused
    assert all(p.probability >= ranked.now for p in ranked.proposals)


def test_the_ladder_and_the_page_of_a_diagnosis_tell_the_same_errors(found):
    climbed = ladder_of(found.search)
    assert climbed.rungs[0].holdout_error == pytest.approx(found.base_error)
    assert climbed.rungs[-1].holdout_error == pytest.approx(found.final_error)
    page = diagnosis_page(found, climbed)
    assert "run_in" in page
    assert page.count("<svg") >= 3
    assert "<script" not in page
