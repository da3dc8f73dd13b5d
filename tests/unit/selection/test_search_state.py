"""Hypotheses are refitted side by side; only those that are worth it are fitted to the end."""

import pytest

from hypotheses import base, left_by, searched
from measured import fit_base
from slipwise.selection import search_state as module
from slipwise.selection.candidates import list_candidates
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis
from slipwise.selection.search_state import Search, left_with, try_all
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


def test_what_was_fitted_before_is_not_fitted_again_and_the_state_stays_as_it_is() -> None:
    found = left_by("heating", of=base())
    state = searched(base(), found)
    assert left_with(state, found.terms, found) == (state, found)


@pytest.mark.long
def test_only_the_promising_are_fitted_to_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("slipwise.jobs.parallel._cores", lambda: 1)  # or children would count their own
    ended: list[tuple[str, ...]] = []

    def polished(found: Hypothesis) -> Hypothesis:
        ended.append(found.names)
        return found

    monkeypatch.setattr(module, "polish", polished)
    base = fit_base(as_campaign(build_campaign(7005, effects=("run_in",), size="medium")))
    terms = {t.label: t for t in list_candidates(base)[0]}
    asked = [([terms[name]], {name: terms[name].effect.typical()}) for name in ("run_in", "pad_spread", "heating")]
    begun = Search(base, {}, [], (), (make_base_hypothesis(base),))
    state, every = try_all(begun, asked)
    assert begun.tried == () and len(state.tried) == len(asked)
    assert [h.names for h in every[:2]] == ended and every[0].names == ("run_in",)
    ended.clear()
    state, some = try_all(state, asked, promising=lambda h: h.names != ("run_in",))
    assert ended == [every[1].names]
    assert [h.names for h in some] == [h.names for h in every] and len(state.tried) == 2 * len(asked)
    assert some[0].solution.cost == every[0].solution.cost
