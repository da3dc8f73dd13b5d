"""Among fits that explain nearly as much: one gauge's best law, and of several gauges the one that leaves the mass."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

from slipwise.diagnosis.choice import best_of
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.effects import catalogue
from slipwise.estimation.parameters import Term
from slipwise.evidence.residual_summary import ResidualSummary

COUNT, RATED = 10_000, 10_000.0


def _tried(name: str, group: str, level: float, mass: float) -> Hypothesis:
    """A hypothesis with this mean squared residual, and what mass its fit gave the girder."""
    total = {"pads": level * COUNT}
    account = ResidualSummary(total, dict(total), {"pads": (COUNT, COUNT)})
    problem = SimpleNamespace(specimen=SimpleNamespace(mass=RATED))
    solution = SimpleNamespace(values={"rig.mass": mass})
    terms = (Term(catalogue()[name], (group,), group),) if name else ()
    return Hypothesis(terms, cast(Any, problem), cast(Any, solution), account)


def test_a_gauge_keeps_its_best_law_though_another_is_nearer_to_the_rated_mass() -> None:
    base = _tried("", "", 700.0, RATED)
    right = _tried("channel_filter", "slip_x", 1.0, 1.001 * RATED)
    other_order = _tried("channel_filter", "slip_x", 1.5, RATED)
    assert best_of(base, [other_order, right]) is right


def test_of_gauges_that_tie_the_one_that_leaves_the_girder_its_mass_is_taken() -> None:
    base = _tried("", "", 700.0, RATED)
    heavy = _tried("channel_gain", "pad_*_N", 1.0, 1.04 * RATED)
    rated = _tried("channel_gain", "pad_*_Fx", 1.1, RATED)
    far = _tried("channel_gain", "girder_ax", 30.0, RATED)
    assert best_of(base, [heavy, rated, far]) is rated
    assert best_of(base, [far, base]) is far


def test_what_is_worth_nothing_is_not_chosen() -> None:
    assert best_of(_tried("", "", 1.0, RATED), [_tried("heating", "", 0.99, RATED)]) is None


def test_what_spoils_other_runs_more_than_it_helps_is_not_chosen() -> None:
    """Slip whose lost samples had moved it: every law that helped the pads a little spoilt other balances far more."""
    base, law = _tried("", "", 3.0, RATED), _tried("heating", "", 1.0, RATED)
    counts = {name: (COUNT, COUNT) for name in ("pads", "girder")}
    before, after = ({"pads": pads * COUNT, "girder": girder * COUNT} for pads, girder in ((3.0, 1.0), (1.0, 9.0)))
    base = replace(base, summary=ResidualSummary(before, dict(before), counts))
    assert best_of(base, [replace(law, summary=ResidualSummary(after, dict(after), counts))]) is None


def test_a_law_of_very_little_is_not_chosen_where_a_gauge_explains_more() -> None:
    base, law = _tried("", "", 1.07, RATED), _tried("buffer_height", "", 1.0, RATED)
    assert best_of(base, [law, _tried("channel_gain", "pad_*_N", 1.02, RATED)]) is law
    assert best_of(base, [law, _tried("channel_gain", "pad_*_N", 0.99, RATED)]) is None
