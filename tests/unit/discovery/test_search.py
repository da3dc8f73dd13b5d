"""Which forms of which curves are fitted: the likeliest, and some of a single state beside products of two."""

from types import SimpleNamespace

import numpy as np
import pytest

from slipwise.discovery import search


def test_likely_products_leave_room_for_forms_of_a_single_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two matches were held against each other number by number, which arrays refuse."""

    def candidate(name: str, evidence: float) -> SimpleNamespace:
        state, place = SimpleNamespace(name=name), SimpleNamespace(name="all")
        return SimpleNamespace(points=np.ones(3), share=0.9, evidence=evidence, states=(state,), port=place, gate=place)

    def matched(of: SimpleNamespace, _: object) -> list[SimpleNamespace]:
        forms = ("one",) if of.states[0].name == "single" else ("one", "two")
        return [SimpleNamespace(candidate=of, forms=forms, rank=of.evidence - 0.1 * k) for k in range(5)]

    monkeypatch.setattr(search, "matched", matched)
    monkeypatch.setattr(search, "_evidence", lambda match: match.rank)
    found = search._matches([candidate("first", 9.0), candidate("second", 8.0), candidate("single", 7.0)])
    assert [len(match.forms) for match in found] == [2] * 8 + [1] * 3
