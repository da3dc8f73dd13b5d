"""Verdicts are scored by exact names, and sizes by the interval that was given."""

from typing import Any

import pytest

from slipwise_benchmarks.score import rates, right
from slipwise_benchmarks.sizes import planted, sizes


def _truth(*missing: str, size: float = 5.0, details: dict[str, Any] | None = None) -> dict[str, Any]:
    settings = {"pad_stiffness": 2.5e8}
    return {"missing": list(missing), "size_after_fit": size, "details": details or {}, "settings": settings}


def _said(verdict: str, *effects: str, parameters: dict[str, Any] | None = None) -> dict[str, Any]:
    candidates = [{"parameters": parameters}] if parameters else []
    said = {"verdict": verdict, "effects": list(effects), "probability": 0.9, "final_error": 1.0}
    return {**said, "candidates": candidates}


def test_a_pair_that_no_gauge_parts_is_right_beside_whatever_else_is_named():
    truth = _truth("buffer_damping", "channel_sign")
    assert right(truth, _said("ambiguous", "buffer_damping", "guide_drag", "channel_sign"))
    assert not right(truth, _said("ambiguous", "buffer_damping", "guide_drag"))
    assert not right(truth, _said("ambiguous", "buffer_damping", "guide_drag", "heating"))
    assert right(_truth("guide_drag"), _said("ambiguous", "buffer_damping", "guide_drag"))
    assert not right(_truth("heating"), _said("ambiguous", "buffer_damping", "guide_drag"))


def test_a_model_that_lacks_less_than_noise_may_be_called_complete():
    assert right(_truth("heating", size=1.1), _said("complete"))
    assert not right(_truth("heating", size=1.3), _said("complete"))


def test_a_member_of_a_pair_that_alone_drowns_in_noise_need_not_be_named():
    truth = {**_truth("pressure_law", "clock_skew"), "alone": {"pressure_law": 1.1, "clock_skew": 5.0}}
    assert right(truth, _said("instrument", "clock_skew"))
    assert right(truth, _said("instrument", "clock_skew", "pressure_law"))
    assert not right(truth, _said("named", "pressure_law"))
    assert not right(truth, _said("instrument", "clock_skew", "heating"))
    both = {**truth, "alone": {"pressure_law": 1.3, "clock_skew": 5.0}}
    assert not right(both, _said("instrument", "clock_skew"))


def test_a_planted_size_is_told_in_the_numbers_of_the_catalogue():
    hardening = {"hardening": 0.1, "hardening_power": 2.0, "form": "power of the excursion"}
    assert planted(_truth(details={"buffer_hardening": hardening})) == {
        "buffer_hardening.gain": pytest.approx(0.1 * 1.5**2)
    }
    first = {"form": "first order", "size": 20.0}
    assert planted(_truth(details={"channel_filter": first}))["channel_filter.lag"] == pytest.approx(7.96e-3, rel=1e-3)
    assert planted(_truth(details={"run_in": {"form": "hyperbolic in distance", "wear": 0.1}})) == {}
    spread = {"pad_factor": (1.05, 0.95, 1.05, 0.95), "form": "factor on each pad"}
    sizes_of = planted(_truth(details={"pad_spread": spread}))
    assert max(abs(v) for v in sizes_of.values()) == pytest.approx(0.05)


def test_sizes_are_held_against_the_interval_of_what_was_rightly_named():
    truth = _truth("channel_delay", details={"channel_delay": {"form": "", "size": 2e-3}})
    given = {"channel_delay[pad_*_Fx].delay": {"value": 2.1e-3, "low": 1.9e-3, "high": 2.3e-3}}
    results = [
        {"name": "a", "truth": truth, "said": _said("instrument", "channel_delay", parameters=given)},
        {"name": "b", "truth": truth, "said": _said("instrument", "channel_filter", parameters=given)},
    ]
    assert [(row["campaign"], row["inside"]) for row in sizes(results)] == [("a", True)]
    assert rates(results)["rightly named, final error at most 1.15 floors"] == [1, 1]
