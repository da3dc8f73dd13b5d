"""Which law is told is decided on the fitted runs; the held-out ones can only take back what is said of it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from types import SimpleNamespace

import pytest

from hypotheses import base, decided, diagnosed, left_by, searched
from slipwise.discovery import discover as module
from slipwise.discovery.discover import discover
from slipwise.discovery.result import Discovery

#: Mean squared residual of the pads that the start leaves [noise variance].
LEFT = 200.0


@dataclass(frozen=True)
class Told:
    """A law without rivals; its name says from which start it was found."""

    name: str
    tied: tuple[str, ...] = ()
    rivals: tuple[str, ...] = ()
    other_states: bool = False


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Discovery]:
    """Discover where the law leaves so much in the pads, of the fitted and of the held-out runs."""
    of = base(pads=LEFT)
    state = replace(searched(of, left_by("heating", of=of, pads=LEFT)), linearisation=SimpleNamespace())
    diagnosis = diagnosed(state, replace(decided(state), kind="unknown", effects=()))

    def result(fitted: float, held_out: float) -> Discovery:
        law = left_by("heating", of=diagnosis.final, pads=fitted, held_out={"pads": held_out})
        port, gate = SimpleNamespace(relation="pads", name="adds to mu"), SimpleNamespace(name="all")
        states = (SimpleNamespace(name="speed"),)
        candidate = SimpleNamespace(share=0.99, evidence=9.0, port=port, gate=gate, beside={}, states=states)
        match = SimpleNamespace(candidate=candidate, free=(), forms=("form",))
        placed = SimpleNamespace(match=match, lag=0.0, label="law")
        objective = SimpleNamespace(plain=law.objective, every=None, fitted=diagnosis.final.objective.fitted)
        fits = iter([(Fit(placed, objective, law.solution),), ()])
        start = diagnosis.final.objective, diagnosis.final.solution

        def find(*_: object) -> SimpleNamespace:
            return SimpleNamespace(candidates=(candidate,), fitted=next(fits))

        def moved(_: object, objective: object, solution: object) -> SimpleNamespace:
            return SimpleNamespace(objective=objective, solution=solution, system=None)

        monkeypatch.setattr(module, "make_ground", lambda *_: moved(0, objective, start[1]))
        monkeypatch.setattr(module, "find_law", find)
        monkeypatch.setattr(module, "different", list)
        monkeypatch.setattr(module, "without_law", lambda *_: start)
        monkeypatch.setattr(module, "move_ground", moved)
        monkeypatch.setattr(module, "add_missing", lambda _: None)
        monkeypatch.setattr(module, "exchange_beside", lambda ground: ground)
        monkeypatch.setattr(module, "fit_without_laws", lambda _: start)
        monkeypatch.setattr(module, "compute_dirt", lambda _: {})
        monkeypatch.setattr(module, "with_slopes", lambda _, solution: solution)
        monkeypatch.setattr(module, "compute_law_intervals", lambda *_: {})
        monkeypatch.setattr(module, "summarise_law", lambda fit, *_: Told(fit.law.label))
        monkeypatch.setattr(module, "_cannot_judge", lambda _: [])
        return discover(diagnosis.final.campaign, diagnosis=diagnosis)

    return result


@dataclass(frozen=True)
class Fit:
    law: SimpleNamespace
    objective: SimpleNamespace
    solution: object


def test_held_out_runs_take_back_that_it_is_a_law(told: Callable[..., Discovery]) -> None:
    assert told(1.0, 1.0).evidence == "law"
    taken_back = told(1.0, 9.0)
    assert taken_back.evidence == "state" and taken_back.relations["pads"][1] == pytest.approx(3.0)


def test_held_out_runs_do_not_raise_what_the_fitted_ones_say(told: Callable[..., Discovery]) -> None:
    """The law explains 99 % and leaves 1.5 floors on the fitted runs: the form is open."""
    assert told(2.25, 1.0).evidence == "state"


def test_the_share_is_that_of_the_fitted_runs(told: Callable[..., Discovery]) -> None:
    assert told(2.25, 9.0).share == pytest.approx(1.0 - 1.25 / (LEFT - 1.0), abs=1e-6)
