"""The end of a search: what is not worth being kept once it is weighed by its own law goes, what is worth it stays."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from hypotheses import base, left_by, searched
from slipwise.diagnosis import backward_elimination as module
from slipwise.diagnosis.backward_elimination import with_final_refit
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.search_state import Search
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.relations.parameters import Term


@pytest.mark.parametrize(("alone", "kept"), [(1.02, ("buffer_mismatch",)), (3.0, ("buffer_mismatch", "key_clearance"))])
def test_a_second_effect_stays_only_where_it_is_worth_it_as_reported(
    monkeypatch: pytest.MonkeyPatch, alone: float, kept: tuple[str, ...]
) -> None:
    """Before the noise near reversals is weighed anew, a clearance of nothing takes away a floor and a half."""
    of = base(pads=400.0)
    both = left_by("buffer_mismatch", "key_clearance", of=of, pads=6.0)
    singles = [left_by("buffer_mismatch", of=of, pads=8.0), left_by("key_clearance", of=of, pads=390.0)]
    weighed = {both.names: 1.0, ("buffer_mismatch",): alone, ("key_clearance",): 390.0}

    def refitted(found: Hypothesis) -> Hypothesis:
        return left_by(*found.terms, of=of, pads=weighed[found.names])

    def without(state: Search, found: Hypothesis, terms: Sequence[Term]) -> tuple[Search, ResidualSummary]:
        gone = {t.label for t in terms}
        return state, refitted(left_by(*(t for t in found.terms if t.label not in gone), of=of)).summary

    monkeypatch.setattr(module, "refit_for_report", refitted)
    monkeypatch.setattr(module, "without", without)
    ended = with_final_refit(replace(searched(of, both), tried=tuple(singles)))
    assert ended.final.names == ended.best.names == kept
