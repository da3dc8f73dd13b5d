"""The page of the bench shows what there is: who is taken for whom, what is wrong, and how much is done."""

from typing import Any

import pytest

from slipwise.view.figures.style import styled
from slipwise_benchmarks.page import _GROUPS, bench_page, pictures
from slipwise_benchmarks.pictures import confusion_figure, hidden_name, said_name
from slipwise_benchmarks.score import rates


def _result(name: str, missing: tuple[str, ...], verdict: str, *effects: str, size: float = 5.0) -> dict[str, Any]:
    truth = {"missing": list(missing), "size_after_fit": size, "settings": {}, "details": {}}
    said = {"verdict": verdict, "effects": list(effects), "probability": 0.95, "seconds": 30.0, "candidates": []}
    if effects:
        said |= {"base_error": 4.0, "final_error": 1.02}
    return {"name": name, "truth": truth, "said": said}


@pytest.fixture
def results() -> list[dict[str, Any]]:
    delay = _result("b6", ("channel_delay",), "instrument", "channel_delay")
    delay["truth"]["details"] = {"channel_delay": {"form": "", "size": 2e-3}}
    interval = {"value": 2.5e-3, "low": 2.4e-3, "high": 2.6e-3}
    delay["said"]["candidates"] = [{"parameters": {"channel_delay[pad_*_Fx].delay": interval}}]
    failed = {"verdict": "failed: InputError: no sliding", "effects": [], "probability": 0.0, "seconds": 1.0}
    return [
        _result("b0", (), "complete"),
        _result("b1", ("heating",), "named", "run_in"),
        _result("b2", ("heating",), "named", "heating"),
        _result("b3", ("run_in", "guide_drag"), "named", "guide_drag", "run_in"),
        _result("b4", ("unknown",), "unknown"),
        {**_result("b5", ("slide_tilt",), "complete"), "said": failed},
        delay,
        _result("b7", ("guide_drag",), "ambiguous", "guide_drag", "buffer_damping"),
    ]


def _words(axes: Any) -> list[str]:
    return [text.get_text() for text in axes.texts]


def test_one_thing_has_one_name_whoever_says_it(results):
    same = [r for r in results if r["name"] in ("b0", "b2", "b3", "b4")]
    assert all(hidden_name(r["truth"]) == said_name(r["said"]) for r in same)
    assert said_name(results[5]["said"]) == "failed" and said_name(results[7]["said"]) == "buffer_damping or guide_drag"


def test_only_what_was_taken_for_something_else_has_a_row(results):
    with styled():
        above, below = confusion_figure(results).axes
    rows = [label.get_text() for label in above.get_yticklabels()]
    assert rows == ["guide_drag", "heating", "slide_tilt"]
    assert [text for text in _words(above) if "of" in text] == ["1 of 1", "1 of 2", "0 of 1"]
    assert set(above.get_xticklabels()[i].get_text() for i in (1, 2, 3)) == {
        "buffer_damping\nor guide_drag", "run_in", "failed",
    }  # fmt: skip
    assert [w.split(":")[0] for w in _words(below)] == [
        "nothing", "channel_delay", "guide_drag + run_in", "outside the catalogue",
    ]  # fmt: skip


def test_a_bench_without_a_mistake_says_so(results):
    with styled():
        above, _ = confusion_figure(results[:1]).axes
    assert _words(above) == ["Nothing was taken for anything else."]


def test_every_rate_has_a_row(results):
    shares = rates(results)["exactly right"]
    assert set(shares) <= set(_GROUPS)


def test_the_page_lists_what_is_wrong_and_what_lies_outside(results):
    with styled():
        drawn = pictures(results)
        text = bench_page(results, 8, drawn)
    assert set(drawn) == {"confusion", "calibration", "error_ratios"} and text.count("<svg") == 3
    assert "6 of 8 verdicts are exactly right" in text and "So far" not in text
    wrong = text.split('<section id="wrong-verdicts">')[1]
    assert "b1" in wrong and "failed: InputError: no sliding" in wrong and "b2" not in wrong
    assert "channel_delay.delay" in text.split('<section id="sizes-outside')[1].split("</section>")[0]
    assert "<script" not in text


@pytest.mark.parametrize("count", [1, 6])
def test_a_run_that_was_stopped_is_shown_as_far_as_it_came(results, count):
    with styled():
        text = bench_page(results[:count], 300, pictures(results[:count]))
    assert f"So far {count} of 300 are done" in text
