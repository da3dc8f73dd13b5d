"""The end of a search: what is immaterial once it is weighed by its own law goes, what is material stays."""

from types import SimpleNamespace
from typing import Any, cast

import pytest

from slipwise.diagnosis import backward_elimination as module
from slipwise.diagnosis.backward_elimination import as_it_is_reported
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.search_state import Search
from slipwise.effects import catalogue
from slipwise.estimation.parameters import Term
from slipwise.evidence.residual_summary import ResidualSummary

COUNT = 10_000


def _tried(names: tuple[str, ...], pads: float) -> Hypothesis:
    """A hypothesis with this mean squared residual in fitted and held-out runs alike."""
    account = ResidualSummary({"pads": pads * COUNT}, {"pads": pads * COUNT}, {"pads": (COUNT, COUNT)})
    solution = SimpleNamespace(free=(None,) * 3, cost=pads * COUNT)
    return Hypothesis(tuple(Term(catalogue()[n]) for n in names), cast(Any, None), cast(Any, solution), account)


@pytest.mark.parametrize(("alone", "left"), [(1.02, ("buffer_mismatch",)), (3.0, ("buffer_mismatch", "key_clearance"))])
def test_a_second_effect_stays_only_where_it_is_material_as_reported(
    monkeypatch: pytest.MonkeyPatch, alone: float, left: tuple[str, ...]
) -> None:
    """Before the noise near reversals is weighed anew, a clearance of nothing takes away a floor and a half."""
    base, both = _tried((), 400.0), _tried(("buffer_mismatch", "key_clearance"), 6.0)
    tried = [_tried(("buffer_mismatch",), 8.0), _tried(("key_clearance",), 390.0)]
    state = Search(cast(Any, None), {}, [], tried, (base, both))
    weighed = {both.names: 1.0, ("buffer_mismatch",): alone}  # the other leaves so much that nobody asks
    monkeypatch.setattr(module, "as_reported", lambda found: _tried(found.names, weighed[found.names]))
    ended = as_it_is_reported(state)
    assert ended.final.names == ended.best.names == left
