"""What a diagnosis says of the next test, of rivals, and of the ladder."""

from dataclasses import replace
from importlib.resources import files
from math import isnan
from pathlib import Path
from typing import Any, cast

import pytest

from slipwise.design.motions import Limits
from slipwise.design.next_test import next_test, rivals
from slipwise.diagnosis.diagnose import diagnose
from slipwise.errors import SimulationError
from slipwise.simulation.simulator import SimulationDiverged
from slipwise.view.pages.diagnosis_page import diagnosis_page

pytestmark = pytest.mark.long


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
    by = {p.motion: p for p in ranked.proposals}
    smaller = next(m for m in by if m not in (slow, far, fast))
    assert by[fast].separation > 1.0 > 0.1 > by[slow].separation
    assert smaller.startswith("sine:0.5Hz,0.2") and not by[smaller].refused
    assert ranked.proposals[-1].motion == far and "stroke" in by[far].refused
    assert all(p.probability >= ranked.chances[0] for p in ranked.proposals)


def test_three_rivals_are_told_apart_by_the_two_that_are_hardest_to_tell(found):
    best, rival = rivals(found)
    third = next(h for h in found.search.tried if h.names not in (best.names, rival.names) and len(h.terms) == 1)
    quake = ("quake:seed=2,peak=0.7g,f=4Hz,strong=3s",)

    def separation(*near):
        verdict = replace(found.verdict, kind="ambiguous", rivals=near)
        ranked = next_test(replace(found, verdict=verdict), library=quake)
        assert ranked.chances == (found.verdict.probability / (1 + len(near)),) * (1 + len(near))
        return ranked.proposals[0].separation

    assert separation(rival, third) <= min(separation(rival), separation(third))


def test_a_simulation_that_fails_is_no_motion_that_tells_nothing(found, monkeypatch):
    def diverged(*_, **__):
        raise SimulationDiverged(
            "the simulation was stopped at 1 s: the slip grew beyond 5 m. Try less", cast(Any, None)
        )

    monkeypatch.setattr("slipwise.design.next_test.replay", diverged)
    with pytest.raises(SimulationError, match="stopped at 1 s: the slip grew beyond 5 m"):
        next_test(found)


def test_the_ladder_and_the_page_of_a_diagnosis_tell_the_same_errors(found):
    ladder = found.ladder()
    assert ladder.steps[0].holdout_error == pytest.approx(found.base_error)
    assert ladder.steps[-1].holdout_error == pytest.approx(found.final_error)
    page = diagnosis_page(found, ladder)
    assert "run_in" in page
    assert page.count("<svg") >= 3
    assert "<script" not in page


def test_a_rung_that_was_not_replayed_has_no_error_of_a_replay(found):
    """Where nothing is named the base model is replayed: its error was shown as that of the search's last model."""
    named = replace(found, system={"base": 4.0, "final": 1.2})
    assert [r.system_holdout_error for r in named.ladder().steps] == [4.0, 1.2]
    unknown = replace(named, verdict=replace(found.verdict, effects=()), system={"base": 4.0, "final": 4.0})
    seen = [r.system_holdout_error for r in unknown.ladder().steps]
    assert seen[0] == 4.0 and isnan(seen[1])
