"""Discovered laws are scored by state, port, parity, form and constants, and by what is claimed too much."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from slipwise_benchmarks.law import Law
from slipwise_benchmarks.laws import LAWS
from slipwise_benchmarks.score_constants import constant_rows, matched
from slipwise_benchmarks.score_discover import (
    explained,
    form_first,
    form_listed,
    form_near,
    law_right,
    port_right,
    rates,
    split,
    state_right,
    where_right,
    wrong,
    wrongly_claimed,
)
from slipwise_benchmarks.settings import PAD_AREA, rated

STORED = Path(__file__).parent / "stored_discoveries.json"


def _truth(name: str, beside: tuple[str, ...] = (), dirty: bool = False) -> dict[str, Any]:
    law: Law | None = LAWS[name] if name else None
    base = rated("bridge1")
    said = law.truth(base.changed(**law.change(np.random.default_rng(3), 1.0))) if law else None
    return {"law": said, "beside": list(beside), "dirty": dirty}


def _said(truth: dict[str, Any], evidence: str = "law", after: float = 1.05, **changes: Any) -> dict[str, Any]:
    true = truth["law"]
    constants = {
        name: {**one, "low": one["value"] - 0.1 * abs(one["value"]), "high": one["value"] + 0.1 * abs(one["value"])}
        for name, one in true["constants"].items()
    }
    law = {"name": "found", "states": true["state"], "tied": [], "constants": constants, "share": 0.98}
    law |= {name: true[name] for name in ("port", "where", "parity", "form")}
    return {"evidence": evidence, "laws": [law | changes], "held_out": {"before": 8.0, "after": after}, "file": None}


def _nothing(evidence: str = "nothing") -> dict[str, Any]:
    return {"evidence": evidence, "laws": [], "held_out": None, "file": None}


def _result(truth: dict[str, Any], said: dict[str, Any]) -> dict[str, Any]:
    return {"name": "l1", "truth": truth, "said": said}


@pytest.mark.parametrize("name", [name for name, law in LAWS.items() if not law.absent])
def test_the_truth_itself_is_a_right_answer(name):
    truth = _truth(name)
    said = _said(truth)
    assert law_right(truth, said) and where_right(truth, said) and form_first(truth, said)
    rows = constant_rows([_result(truth, said)])
    assert rows if truth["law"]["form"] != "power" else {row["constant"] for row in rows} >= {"exponent"}
    assert all(row["within"] and row["inside"] for row in rows)


def test_a_pair_of_states_has_no_order_and_half_of_it_is_wrong():
    truth = _truth("hot and fast")
    assert state_right(truth, _said(truth, states=["speed", "heat"]))
    assert not state_right(truth, _said(truth, states=["speed"])) and not state_right(truth, _nothing())


def test_port_and_parity_have_to_be_right_together_but_for_a_law_that_has_no_parity():
    truth, both_ways = _truth("washboard"), _truth("grooves")
    assert not port_right(truth, _said(truth, port="adds to mu"))
    assert not port_right(truth, _said(truth, parity="even"))
    assert port_right(both_ways, _said(both_ways, parity="even"))


def test_forms_that_tie_are_listed_but_no_more_than_three():
    truth = _truth("speed bump")
    tied = _said(truth, form="lorentz", tied=["bump", "step"])
    assert form_listed(truth, tied) and form_near(truth, tied) and not form_first(truth, tied)
    assert not form_listed(truth, _said(truth, form="lorentz", tied=["step", "bump", "exp"]))
    assert not form_near(truth, _said(truth, form="sine")) and not form_near(truth, _said(truth))


def test_what_is_explained_is_counted_above_the_noise():
    assert explained({"held_out": {"before": 5.0, "after": 1.0}}) == 1.0
    assert explained({"held_out": {"before": 5.0, "after": 0.97}}) == 1.0
    assert explained({"held_out": {"before": 5.0, "after": 5.0}}) == 0.0
    assert explained({"held_out": {"before": 1.0, "after": 1.0}}) is None and explained(_nothing()) is None


def test_a_law_is_wrong_where_there_is_none_or_where_no_state_drives_it():
    law = _said(_truth("washboard"))
    complete, beside, absent = _truth(""), _truth("", ("run_in",)), _truth("time of day")
    assert all(wrongly_claimed(truth, law) for truth in (complete, beside, absent))
    quiet = rates([_result(truth, _nothing("unknown")) for truth in (complete, beside, absent)])
    loud = rates([_result(truth, law) for truth in (complete, beside, absent)])
    for name in ("on a complete campaign", "where only a known effect is", "though no state drives it"):
        assert quiet[f"law claimed {name}"] == [0, 1] and loud[f"law claimed {name}"] == [1, 1]
    assert loud["wrong law claimed"] == [3, 3]


def test_a_hint_at_a_state_is_no_claim_of_a_law():
    truth = _truth("washboard")
    hint = _said(truth, evidence="state", form="linear")
    counted = rates([_result(truth, hint)])
    assert counted["driving state right"] == [1, 1] and counted["law claimed"] == [0, 1]
    assert counted["wrong law claimed"] == [0, 1]


def test_a_second_law_is_one_too_many():
    truth = _truth("washboard")
    said = _said(truth)
    said["laws"] *= 2
    assert rates([_result(truth, said)])["further law that is not there"] == [1, 1]


def test_constants_are_found_by_other_names_units_and_conventions():
    given = {
        "amplitude": {"value": 0.03, "low": 0.029, "high": 0.031, "unit": "1"},
        "v_0": {"value": 140.0, "low": 139.0, "high": 141.0, "unit": "mm/s"},
        "width": {"value": 0.04, "low": 0.039, "high": 0.041, "unit": "m/s"},
    }
    true = _truth("speed bump")["law"]["constants"]
    found = matched(true, given)
    assert found["size"]["value"] == 0.03 and found["width"]["value"] == 0.04
    assert found["place"] == pytest.approx({"value": 0.14, "low": 0.139, "high": 0.141})
    pressure = {"threshold": {"value": 19.0, "low": None, "high": None, "unit": "MPa"}}
    load = matched(_truth("load threshold")["law"]["constants"], pressure)
    assert load == {"place": {"value": pytest.approx(19.0e6 * PAD_AREA)}}
    assert matched(true, {"v_0": given["v_0"]}) == {}  # it may be the place or the width
    truth = _truth("speed bump")
    true = truth["law"]["constants"]["width"]["value"]
    narrow = {"sigma": {"value": true / np.sqrt(2.0), "low": 0.0, "high": 1.0, "unit": "m/s"}}
    (row,) = constant_rows([_result(truth, _said(truth, constants=narrow))])
    assert row["within"] and row["value"] == pytest.approx(true)


def test_a_constant_off_by_more_than_a_tenth_or_outside_its_interval_is_told():
    truth = _truth("fresh reversal")
    true = truth["law"]["constants"]["scale"]["value"]
    off = {"time": {"value": 1.2 * true, "low": 0.9 * true, "high": 1.5 * true, "unit": "s"}}
    sure = {"time": {"value": 1.05 * true, "low": 1.02 * true, "high": 1.08 * true, "unit": "s"}}
    rows = constant_rows([_result(truth, _said(truth, constants=constants)) for constants in (off, sure)])
    assert [(row["within"], row["inside"]) for row in rows] == [(False, True), (True, False)]


def test_half_a_turn_more_is_a_wave_of_the_other_sign():
    truth = _truth("washboard")
    said = _said(truth)
    size, phase = (said["laws"][0]["constants"][name] for name in ("size", "phase"))
    for key in ("value", "low", "high"):
        size[key], phase[key] = -size[key], phase[key] + 3.0 * np.pi
    assert all(row["within"] for row in constant_rows([_result(truth, said)]))


def test_numbers_as_they_come_from_a_search_are_counted_as_those_that_were_read_back():
    """The scores of a bench that ran to its end were lost: numpy's integers are nothing that JSON knows."""
    truth = _truth("speed bump")
    said = _said(truth, after=np.float64(1.05))
    for one in said["laws"][0]["constants"].values():
        one |= {key: np.float64(one[key]) for key in ("value", "low", "high")}
    results = [_result(truth, said)]
    json.dumps([rates(results), constant_rows(results)])
    assert rates(results)["held-out error at most 1.25 floors"] == [1, 1]


def test_stored_discoveries_are_scored_as_they_were_meant():
    results = json.loads(STORED.read_text(encoding="utf-8"))
    counted = rates(results)
    assert counted["driving state right"] == [3, 4] and counted["law claimed and right"] == [2, 4]
    assert counted["law claimed on a complete campaign"] == [0, 1]
    assert counted["law claimed though no state drives it"] == [1, 1]
    assert {row["campaign"] for row in wrong(results)} == {"state alone", "wrong state", "driver absent"}
    assert split(results)["dirty"] == [1, 2]
