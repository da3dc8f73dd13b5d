"""What a command does to a model is a step of the session: placed, fitted, told before and after, and undone."""

from types import SimpleNamespace

import pytest

from session_campaign import MISSING
from slipwise.errors import SettingError, UnknownNameError
from slipwise.relations.parameters import Term
from slipwise.session import model_change
from slipwise.session.findings import explained
from slipwise.session.model_change import add, remove


@pytest.fixture
def back(fitted):
    """The fitted session; whatever a test does is taken back."""
    history, reference, findings = fitted.history, fitted.reference, dict(fitted.findings)
    yield fitted
    fitted.history, fitted.reference, fitted.findings = history, reference, findings


@pytest.mark.slow
def test_an_effect_is_added_and_removed_as_steps_of_the_session(back):
    steps = len(back.history.states)
    changed = add(MISSING, back)
    assert changed.before["pads"] > 3.0 and changed.after["pads"] < 1.15
    assert changed.model[MISSING].values == back.model[MISSING].values and back.state.fitted
    assert len(back.history.states) > steps
    gone = remove(MISSING, back)
    assert gone.before["pads"] == changed.after["pads"] and gone.after["pads"] > 3.0
    back.undo()
    assert not back.state.fitted and MISSING not in back.state.labels
    back.undo()
    assert MISSING in back.state.labels


@pytest.mark.slow
def test_a_fault_of_a_gauge_goes_to_the_channel_where_it_explains_most(back):
    changed = add("channel_gain", back)
    assert changed.words.startswith("channel_gain[") and back.state.labels[-1].startswith("channel_gain[")


def test_what_cannot_be_added_or_removed_is_said_before_anything_is_fitted(back, monkeypatch):
    monkeypatch.setattr(back, "fit", lambda progress: pytest.fail("fitted"))
    with pytest.raises(UnknownNameError):
        add("run_inn", back)
    with pytest.raises(SettingError, match="breakaway"):
        remove("breakaway", back)


def test_what_a_diagnosis_names_is_put_in_fitted_and_kept_as_its_finding(back, monkeypatch):
    monkeypatch.setattr(back, "fit", lambda progress: progress("", 1.0))
    said = {"effects": [MISSING], "suggestion": [
        {"effect": MISSING, "targets": [""], "group": "", "values": back.effect(MISSING).typical()}]}  # fmt: skip
    monkeypatch.setattr(model_change, "explained", lambda found, of: said)
    changed = add(SimpleNamespace(added=(MISSING,)), back)
    assert changed.words == f"{MISSING} added, as suggested" and MISSING in back.state.labels
    assert back.findings["explain"] == said


def test_a_diagnosis_that_names_nothing_adds_nothing(back):
    with pytest.raises(SettingError, match="names no effect"):
        add(SimpleNamespace(added=()), back)


@pytest.mark.parametrize(
    ("kind", "named", "minor", "offered"),
    [("complete", (), (MISSING,), [MISSING]), ("complete", (), (), []), ("unknown", (), (MISSING,), []),
     ("named", (MISSING,), (), [MISSING])],
)  # fmt: skip
def test_where_nothing_matters_what_is_minor_is_offered(back, kind, named, minor, offered):
    effect = back.effect(MISSING)
    term = Term(effect)
    values = {f"{term.label}.{n}": v for n, v in effect.typical().items()}
    solution = SimpleNamespace(values=values)
    found = SimpleNamespace(
        verdict=SimpleNamespace(kind=kind, effects=named, minor=minor),
        search=SimpleNamespace(best=SimpleNamespace(terms=(term,), solution=solution)),
        final=SimpleNamespace(solution=solution),
        as_json=dict,
    )
    assert [part["effect"] for part in explained(found, ("breakaway",))["suggestion"]] == offered
