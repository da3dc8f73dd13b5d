"""Sentences beside a verdict: whether runs confirm it, what is there but small, and which error a number is."""

from dataclasses import replace

import pytest

from hypotheses import base, diagnosed, left_by, searched
from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.verdict import Verdict
from slipwise.view.words.diagnosis_words import (
    cannot_tell_words,
    confirmed_words,
    error_name,
    floors,
    four_answers,
    law_words,
    limits_words,
    minor_words,
    percent,
)


def _found(*names: str, held_out: bool = True, unseen: float = 1.0, material: dict | None = None) -> Diagnosis:
    of = base(held_out=held_out, pads=20.0)
    whole = left_by(*names, of=of, held_out={"pads": unseen})
    return diagnosed(searched(of, whole), material=material)


def test_what_held_out_runs_confirm_is_called_confirmed():
    assert confirmed_words(_found("heating")) == "Confirmed on runs that no fit has seen: sine_holdout_2."


def test_what_does_not_carry_over_is_said():
    assert "does not carry over to sine_holdout_2" in confirmed_words(_found("heating", unseen=25.0))


def test_the_error_over_all_samples_is_told_where_stretches_were_judged():
    found = replace(_found("heating"), all_samples={"pads": (6.21, 1.04), "girder": (1.0, 1.0)})
    assert confirmed_words(found).endswith(" Over all their samples, pad friction errs by 6.21 -> 1.04 floors.")


def test_without_held_out_runs_nothing_is_called_confirmed_or_held_out():
    found = _found("heating", held_out=False)
    assert confirmed_words(found).startswith("Not confirmed: no run outside the fit")
    assert (error_name(found), error_name(_found("heating"))) == ("error of fitted runs", "held-out error")


def test_runs_that_cannot_show_it_are_said_not_to():
    assert "cannot show" in confirmed_words(replace(_found("heating"), confirmed=None))


@pytest.mark.parametrize("effects", [(), ("dropped_samples",)])
def test_where_no_effect_was_fitted_there_is_nothing_to_confirm(effects: tuple[str, ...]) -> None:
    kind = "instrument" if effects else "complete"
    verdict = Verdict(kind, effects, (), 0.9, "none", 1.0, None, (), ())
    assert confirmed_words(diagnosed(searched(base()), verdict)) == ""


def test_what_is_minor_is_told_with_what_becomes_of_it():
    assert minor_words(_found("heating")) == ""
    beside = minor_words(_found("heating", "table_pitch", material={"table_pitch": 0.5}))
    assert beside.startswith("There, but most likely immaterial: table_pitch; it is in the fitted model.")
    alone = minor_words(_found("heating", "table_pitch", material={"heating": 0.2, "table_pitch": 0.5}))
    assert "table_pitch, heating; the model may do without" in alone


def test_the_limits_are_those_of_the_campaign():
    found = _found("heating")
    campaign = replace(found.final.campaign, materiality=Materiality(channel=0.035, response=0.1, gauge=0.005))
    words = limits_words(replace(found, final=replace(found.final, campaign=campaign)))
    assert [share in words for share in ("3.5 %", "10 %", "0.5 %")] == [True, True, True]


def test_an_error_that_nobody_knows_is_no_number():
    assert [floors(e) for e in (float("nan"), 3.8234, 1.0, 4321.0)] == ["unknown", "3.82", "1.00", "4321"]


@pytest.mark.parametrize(("share", "words"), [(0.12, "12 %"), (0.0996, "10 %"), (0.05, "5 %"), (0.0012, "0.12 %")])
def test_shares_have_two_figures(share: float, words: str) -> None:
    assert percent(share) == words


def test_what_much_is_left_of_is_not_confirmed_though_its_error_falls() -> None:
    of = base(pads=1e4)
    found = diagnosed(searched(of, left_by("heating", of=of, pads=100.0, held_out={"pads": 100.0})))
    words = confirmed_words(found)
    assert words.startswith("Not confirmed: on sine_holdout_2, which no fit has seen, 10.00 noise floors, 10 % of")


def test_what_stood_for_a_part_of_the_law_is_said_not_to_be_needed_with_it() -> None:
    """`add` of a gauge's gain was advised where the law explains everything without it."""
    found = _found("heating", "table_pitch")
    law = {"words": "A law: of the speed.", "beside": ["table_pitch"]}
    said = law_words(replace(found, law=law))
    assert said == "A law: of the speed. With it, heating is not needed. `slipwise discover` writes it as an effect."
    assert "not needed" not in law_words(replace(found, law={**law, "beside": ["heating", "table_pitch"]}))
    assert law_words(found) == "" and dict(four_answers(replace(found, law=law)))["What next?"] == said


def test_effects_that_lack_the_same_are_told_in_one_line() -> None:
    found = replace(_found("heating"), cannot_tell=("a: needs one: two", "b: other", "c: needs one: two"))
    assert cannot_tell_words(found) == ["a, c: needs one: two", "b: other"]
