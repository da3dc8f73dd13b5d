"""Laws that explain as much as each other are held against each other; one that stands alone is not."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from slipwise.design import law_contest as module


def law(form: str, *states: str, port: str = "adds to mu") -> Any:
    return SimpleNamespace(form=form, states=states, port=port, equation=f"mu += {form}", alternatives=())


def answered(monkeypatch: pytest.MonkeyPatch, evidence: str, *laws: Any) -> Any:
    if laws:
        laws[0].alternatives = laws[1:]
    told = SimpleNamespace(evidence=evidence, laws=laws)
    monkeypatch.setattr(module, "discover", lambda campaign, diagnosis: told)
    monkeypatch.setattr(module, "_fitted", lambda found, told, law, name, folder: (name, law))
    found: Any = SimpleNamespace(final=SimpleNamespace(campaign=None))
    return module.law_contest(found, Path(), 3)


def test_a_tie_is_held_against_the_leader_alike_likely_each_named_by_form_and_state(monkeypatch) -> None:
    contest = answered(monkeypatch, "state", law("step", "slip"), law("hinge x step", "slip", "load"))
    assert [name for name, _ in contest.hypotheses] == ["step_of_slip", "hinge_x_step_of_slip_and_load"]
    assert contest.chances == (0.5, 0.5)
    assert contest.words == "step_of_slip: mu += step. hinge_x_step_of_slip_and_load: mu += hinge x step."


def test_laws_alike_in_form_and_state_get_a_number_and_no_more_than_asked_for_are_held(monkeypatch) -> None:
    contest = answered(monkeypatch, "organised", *(law("step", "load") for _ in range(4)))
    assert [name for name, _ in contest.hypotheses] == ["step_of_load", "step_of_load_2", "step_of_load_3"]


@pytest.mark.parametrize("evidence", ["unknown", "nothing"])
def test_where_no_law_is_told_there_is_none_to_tell_apart(monkeypatch, evidence: str) -> None:
    assert answered(monkeypatch, evidence) is None


def test_a_law_that_stands_alone_or_whose_rival_no_effect_can_be_has_nothing_to_be_told_from(monkeypatch) -> None:
    assert answered(monkeypatch, "law", law("step", "slip")) is None
    assert answered(monkeypatch, "state", law("step", "slip"), law("step", "load", port="load")) is None
