"""Why an effect was not named: what it leaves in the place of what was, where, and what cannot be asked."""

from dataclasses import replace
from pathlib import Path

import pytest

from hypotheses import base, diagnosed, findings_of, left_by, searched
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.verdict import Verdict
from slipwise.errors import UnknownNameError
from slipwise.view.figures.style import styled
from slipwise.view.figures.why_not_figure import why_not_figure
from slipwise.view.pages.diagnosis_page import diagnosis_page
from slipwise.view.words.why_not_words import why_not_words
from slipwise_benchmarks.bearing import make_bearing


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A slider on a spring, of which one law is missing."""
    folder = tmp_path_factory.mktemp("spring")
    make_bearing(folder, "spring", 54301)
    return diagnose(folder)


def test_what_is_asked_about_is_fitted_in_the_place_of_what_was_named(found: Diagnosis) -> None:
    asked = next(s.term.effect.name for s in found.search.alone if s.term.effect.name not in found.verdict.effects)
    [why] = found.with_why_not(asked).why_not
    assert why.replaced in found.verdict.effects
    assert why.worst["named"] < why.worst["instead"], "what was named leaves less"
    assert why.behind > 0.0
    assert {e.run for e in why.errors} == {run.name for run in found.search.base.objective.runs}
    words = why_not_words(why)
    assert words[0].startswith(f"{asked} in the place of {why.replaced} leaves ")
    content = found.with_why_not(asked).as_json()["why_not"][0]
    assert content["effect"] == asked and content["worst"]["named"] == pytest.approx(why.worst["named"], rel=1e-3)


def test_an_instant_that_contradicts_is_told_with_its_state_and_drawn(found: Diagnosis) -> None:
    asked = next(s.term.effect.name for s in found.search.alone if s.term.effect.name not in found.verdict.effects)
    with_it = found.with_why_not(asked)
    [why] = with_it.why_not
    assert why.instants, "what was named explains what the other leaves"
    worst = why.instants[0]
    assert worst.instead > worst.named and worst.start < worst.end
    with styled():
        figure = why_not_figure(why)
    assert figure is not None and len(figure.axes) == 2
    assert f"Why not {asked}?" in diagnosis_page(with_it)


def test_what_was_named_and_what_cannot_be_tested_get_a_reason(found: Diagnosis) -> None:
    name = found.verdict.effects[0]
    cannot, reason = next(iter((n, r) for n, r in found.search.cannot.items() if n in ("girder_bending", "heating")))
    named, untested = found.with_why_not(name, cannot).why_not
    assert named.reason == "it was named" and reason in untested.reason
    assert why_not_words(untested) == [f"{cannot}: this campaign cannot test it: {reason}."]


def test_a_name_that_is_none_is_refused_with_what_is_near(found: Diagnosis) -> None:
    with pytest.raises(UnknownNameError, match="did you mean presliding"):
        found.with_why_not("pre_sliding")


def test_a_rival_that_was_refitted_opens_on_a_click_and_needs_no_further_fit() -> None:
    of = base(pads=9.0)
    best, other = left_by("heating", of=of), left_by("run_in", of=of, pads=4.0)
    state = searched(of, best, other)
    verdict = Verdict("named", ("heating",), (), 0.9, "none", 1.0, None, (), tuple(findings_of(state)))
    found = replace(diagnosed(state, verdict), system={})
    [why] = found.explain_rivals()
    assert (why.effect, why.replaced) == ("run_in", "heating")
    assert why.worst["instead"] == pytest.approx(2.0, rel=0.1)
    page = diagnosis_page(found)
    assert "<summary>Why not run_in?</summary>" in page
    assert "run_in in the place of heating leaves" in page


def test_where_several_are_named_as_a_tie_none_of_them_is_asked_about() -> None:
    of = base(pads=9.0)
    state = searched(of, left_by("heating", of=of), left_by("run_in", of=of))
    verdict = Verdict("ambiguous", ("heating", "run_in"), (), 0.5, "none", 1.0, None, state.tried[1:], ())
    assert diagnosed(state, verdict).explain_rivals() == []


def test_a_slider_has_limits_and_a_page_of_them(found: Diagnosis, tmp_path: Path) -> None:
    content = found.as_json()
    assert set(content["limits"]).isdisjoint(content["effects"]) and content["limits"]
    assert set(content["may_be_missed"]) <= set(content["limits"])
    assert "How large what was not named can be" in diagnosis_page(found)
