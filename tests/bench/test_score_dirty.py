"""Verdicts on dirty campaigns are scored by what matters, what is there, and what is not."""

from typing import Any

import pytest

from slipwise_benchmarks.score_dirty import (
    absent_named,
    complete_right,
    first_right,
    importances,
    log_loss,
    rates,
    right,
)


def _truth(first: list[dict[str, Any]] | None = None, **of_limit: float) -> dict[str, Any]:
    """A negative size stands for what matters and hides in the base parameters."""
    effects = {}
    for name, size in of_limit.items():
        importance = {"peak_slip": 0.01 * abs(size), "energy": 0.0, "largest_load": 0.0, "channels": {}}
        status = "material" if abs(size) > 1.0 else "minor"
        entry = {"status": status, "visible": size > 0.0, "of_limit": abs(size), "importance": importance}
        effects[name] = entry
    matters = [name for name, entry in effects.items() if entry["status"] == "material"]
    return {
        "missing": [name for name in matters if of_limit[name] > 0.0],
        "hidden_in_base": [name for name in matters if of_limit[name] < 0.0],
        "effects": effects,
        "first": first or [],
        "group": "one or two",
    }


def _said(verdict: str, *effects: str, **more: Any) -> dict[str, Any]:
    return {"verdict": verdict, "effects": list(effects), "probability": 0.9, **more}


def test_all_that_matters_must_be_named_and_nothing_that_is_absent():
    truth = _truth(run_in=5.0, heating=2.0, slide_tilt=0.2)
    assert right(truth, _said("named", "heating", "run_in", minor=["slide_tilt"]))
    assert not right(truth, _said("named", "run_in"))
    assert not right(truth, _said("named", "run_in", "heating", "guide_drag"))
    assert not right(truth, _said("complete"))
    assert not right(truth, _said("failed: ValueError"))


@pytest.mark.parametrize(("size", "may"), [(0.4, False), (0.6, True), (0.99, True)])
def test_what_nearly_matters_may_be_named_and_need_not_be(size, may):
    truth = _truth(run_in=5.0, slide_tilt=size)
    assert right(truth, _said("named", "run_in"))
    assert right(truth, _said("named", "run_in", "slide_tilt")) == may


def test_what_hides_in_base_parameters_may_be_named_and_need_not_be():
    truth = _truth(buffer_hardening=-3.0)
    assert right(truth, _said("complete")) and right(truth, _said("named", "buffer_hardening"))
    assert not right(truth, _said("named", "buffer_damping"))


def test_a_pair_that_no_gauge_parts_is_right_when_the_right_one_is_in_it():
    truth = _truth(buffer_damping=4.0, run_in=3.0)
    both = _said("ambiguous", "buffer_damping", "guide_drag", "run_in")
    assert right(truth, both) and not absent_named(truth, both)
    assert not right(truth, _said("ambiguous", "buffer_damping", "guide_drag"))
    assert not right(truth, _said("ambiguous", "buffer_damping", "buffer_hysteresis", "run_in"))
    assert not right(truth, _said("named", "guide_drag", "run_in"))


def test_a_law_outside_the_catalogue_is_said_beside_what_is_inside():
    alone, beside = _truth(unknown=6.0), _truth(unknown=6.0, run_in=3.0)
    assert right(alone, _said("unknown"))
    assert not right(alone, _said("named", "run_in"))
    assert right(beside, _said("named", "run_in", leftover="unknown"))
    assert not right(beside, _said("named", "run_in", leftover="none"))
    assert not right(_truth(run_in=3.0), _said("unknown"))


def test_a_right_family_of_another_form_is_right():
    said = _said("named", "run_in", leftover="unknown")
    assert right(_truth(run_in=3.0), said) and not absent_named(_truth(run_in=3.0), said)


def test_absent_names_count_among_minor_ones_too():
    truth = _truth(run_in=5.0, slide_tilt=0.01)
    assert not absent_named(truth, _said("named", "run_in", minor=["slide_tilt", "pad_compliance"]))
    assert absent_named(truth, _said("named", "run_in", minor=["table_pitch"])) == {"table_pitch"}
    assert absent_named(truth, _said("unknown")) == {"unknown"}


def test_complete_is_asked_for_where_nothing_matters():
    truth = _truth(slide_tilt=0.3)
    assert complete_right(truth, _said("complete")) and not complete_right(truth, _said("named", "slide_tilt"))
    result = {"name": "a", "truth": truth, "said": _said("complete")}
    assert rates([result])["nothing material: called complete"] == [1, 1]


def test_first_things_are_found_with_their_channels_and_no_others():
    late = {"kind": "late", "channels": ["pad_A_N", "pad_A_Fx"]}
    truth = _truth([late])
    assert first_right(truth, _said("complete", first=[{"kind": "late", "channels": ["pad_A_Fx", "pad_A_N"]}]))
    assert first_right(truth, _said("complete", first=[{"kind": "late", "channels": [c]} for c in late["channels"]]))
    assert not first_right(truth, _said("complete", first=[{"kind": "late", "channels": ["pad_A_N"]}]))
    assert not first_right(truth, _said("complete", first=[late, {"kind": "wrong_rig", "channels": []}]))
    assert not first_right(truth, _said("complete"))
    assert right(truth, _said("instrument", "channel_delay"))


def test_importance_is_held_against_the_true_change():
    given = {"peak_slip": [0.05, 0.04, 0.06], "energy": [0.1, 0.05, 0.2], "largest_load": [0.0, -0.01, 0.01]}
    said = _said("named", "run_in", importance={"run_in": given, "heating": given})
    rows = importances([{"name": "a", "truth": _truth(run_in=5.0), "said": said}])
    assert [(row["effect"], row["figure"], row["inside"]) for row in rows] == [
        ("run_in", "peak_slip", True),
        ("run_in", "energy", False),
        ("run_in", "largest_load", True),
    ]


def test_log_loss_is_that_of_the_probability_of_what_came_out():
    good = {"name": "a", "truth": _truth(run_in=5.0), "said": _said("named", "run_in")}
    bad = {"name": "b", "truth": _truth(run_in=5.0), "said": _said("complete")}
    assert log_loss([good]) == pytest.approx(0.105, abs=1e-3)
    assert log_loss([bad]) == pytest.approx(2.303, abs=1e-3)
