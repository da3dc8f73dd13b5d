"""Which law is told is decided on the fitted runs; the held-out ones can only take back what is said of it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace

import pytest

from hypotheses import base, decided, diagnosed, left_by, searched
from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery import discover as module
from slipwise.discovery.discover import discover
from slipwise.discovery.result import Discovery
from slipwise.discovery.search import Found
from slipwise.estimation.base_fit import BaseFit

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
def unknown() -> tuple[Diagnosis, BaseFit]:
    """A diagnosis that names nothing, and the fit with what its search had added: the two starts."""
    of = base(pads=LEFT)
    state = searched(of, left_by("heating", of=of, pads=LEFT))
    found = diagnosed(state, replace(decided(state), kind="unknown", effects=()))
    return found, replace(of, solution=replace(of.solution, values=dict(of.solution.values)))


@pytest.fixture
def told(unknown: tuple[Diagnosis, BaseFit], monkeypatch: pytest.MonkeyPatch) -> Callable[..., Discovery]:
    """Discover where the law of each start leaves so much in the pads, of the fitted and of the held-out runs."""
    diagnosis, second = unknown

    def result(*laws: tuple[float, float]) -> Discovery:
        starts = {"first": diagnosis.final, "second": second}
        fits: Mapping[int, tuple[str, tuple[float, float]]] = {
            id(start.solution): (name, left) for (name, start), left in zip(starts.items(), laws, strict=True)
        }

        def found(_: object, solution: object, *__: object) -> Found:
            if id(solution) not in fits:
                return Found((), ())
            name, (fitted, held_out) = fits[id(solution)]
            law = left_by("heating", of=diagnosis.final, pads=fitted, held_out={"pads": held_out})
            candidate = SimpleNamespace(
                share=0.99, port=SimpleNamespace(relation="pads"), gate=SimpleNamespace(name="all")
            )
            match = SimpleNamespace(candidate=candidate, free=(), forms=("form",))
            placed = SimpleNamespace(match=match, lag=0.0, label=name)
            objective = SimpleNamespace(objective=law.objective, every=None, fitted=diagnosis.final.objective.fitted)
            return Found((), (Fit(placed, objective, law.solution),))  # pyright: ignore[reportArgumentType]

        monkeypatch.setattr(module, "find_law", found)
        monkeypatch.setattr(module, "different", list)
        monkeypatch.setattr(module, "make_fit", lambda *_: second)
        monkeypatch.setattr(module, "with_slopes", lambda _, solution: solution)
        monkeypatch.setattr(module, "pad_instants", lambda *_: None)
        monkeypatch.setattr(module, "compute_intervals", lambda _: SimpleNamespace(entries=()))
        monkeypatch.setattr(module, "summarise_law", lambda fit, *_: Told(fit.law.label))
        monkeypatch.setattr(module, "_cannot_judge", lambda _: [])
        return discover(diagnosis.final.campaign, diagnosis=diagnosis)

    return result


@dataclass(frozen=True)
class Fit:
    law: SimpleNamespace
    objective: SimpleNamespace
    solution: object


def share(left: float) -> float:
    return 1.0 - (left - 1.0) / (LEFT - 1.0)


def test_held_out_runs_do_not_choose_between_two_starts(told: Callable[..., Discovery]) -> None:
    """The first start leaves noise; the second leaves more, and happens to do better where nothing was fitted."""
    found = told((1.0, 9.0), (1.3, 1.0))
    assert found.share == pytest.approx(share(1.0), abs=1e-6)
    assert found.relations["pads"][1] == pytest.approx(3.0)


def test_held_out_runs_take_back_that_it_is_a_law(told: Callable[..., Discovery]) -> None:
    assert told((1.0, 1.0), (1.3, 1.0)).evidence == "law"
    assert told((1.0, 9.0), (1.3, 1.0)).evidence == "state"


def test_held_out_runs_do_not_raise_what_the_fitted_ones_say(told: Callable[..., Discovery]) -> None:
    """Both starts explain 99 % and leave 1.5 floors on the fitted runs: the form is open."""
    assert told((2.25, 1.0), (2.25, 1.0)).evidence == "state"


def test_of_two_starts_that_say_as_much_the_one_that_explains_more_is_told(told: Callable[..., Discovery]) -> None:
    found = told((2.5, 1.0), (2.25, 9.0))
    assert found.share == pytest.approx(share(2.25), abs=1e-6)
