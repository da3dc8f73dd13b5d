"""A rival whose state lags by less than a sample is no rival: it has the same state."""

from types import SimpleNamespace
from typing import Any

import pytest

from slipwise.discovery.law_summary import _lags_by_nothing, parity_of


def fitted(state: str, lag: float = 0.0) -> Any:
    """A law over one state, fitted to samples of 2 ms."""
    candidate = SimpleNamespace(states=(SimpleNamespace(name=state),))
    objective = SimpleNamespace(plain=SimpleNamespace(fitted_runs=[SimpleNamespace(dt=0.002)]), fitted=[0])
    values = {"time_constant": lag} if lag else {}
    return SimpleNamespace(
        law=SimpleNamespace(match=SimpleNamespace(candidate=candidate), lag=lag), objective=objective, values=values
    )


@pytest.mark.parametrize(
    ("state", "lag", "same"),
    [("lagged_load", 0.001, True), ("lagged_load", 0.02, False), ("load", 0.0, False), ("speed", 0.0, False)],
)
def test_a_lag_below_a_sample_makes_no_other_state(state: str, lag: float, same: bool) -> None:
    assert _lags_by_nothing(fitted(state, lag), fitted("load")) is same


@pytest.mark.parametrize(
    ("port", "states", "parity"),
    [
        ("odd", ["speed"], "odd"),
        ("odd", ["outward"], "even"),
        ("odd", ["speed", "outward"], "even"),
        ("even", ["slip"], "even"),
    ],
)
def test_what_goes_with_outward_turns_the_parity(port: str, states: list[str], parity: str) -> None:
    candidate: Any = SimpleNamespace(
        port=SimpleNamespace(parity=port), states=[SimpleNamespace(name=s) for s in states]
    )
    assert parity_of(candidate) == parity
