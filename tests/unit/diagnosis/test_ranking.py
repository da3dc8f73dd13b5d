"""Among fits that explain nearly as much: one gauge's best law, and of several gauges the one that leaves the mass."""

from hypotheses import base, left_by, on
from slipwise.diagnosis.hypothesis import Hypothesis, make_base_hypothesis
from slipwise.diagnosis.ranking import best_of
from slipwise.estimation.base_fit import BaseFit


def with_mass(share: float, fault: str, group: str, of: BaseFit, pads: float) -> Hypothesis:
    """A fault of gauges beside which the fit gave the girder this share of its rated mass."""
    return left_by(on(fault, group), of=of, pads=pads, values={"rig.mass": share * of.objective.specimen.mass})


def test_a_gauge_keeps_its_best_law_though_another_is_nearer_to_the_rated_mass() -> None:
    of = base(pads=700.0)
    right = with_mass(1.001, "channel_filter", "slip_x", of, 1.0)
    other_order = with_mass(1.0, "channel_filter", "slip_x", of, 1.5)
    assert best_of(make_base_hypothesis(of), [other_order, right]) is right


def test_of_gauges_that_tie_the_one_that_leaves_the_girder_its_mass_is_taken() -> None:
    """Cells of load that all read 4 % less under a heavier girder are cells of friction that all read 4 % more."""
    of = base(pads=700.0)
    heavy = with_mass(1.04, "channel_gain", "pad_*_N", of, 1.0)
    rated = with_mass(1.0, "channel_gain", "pad_*_Fx", of, 1.02)
    far = with_mass(1.0, "channel_gain", "girder_ax", of, 30.0)
    assert best_of(make_base_hypothesis(of), [heavy, rated, far]) is rated
    assert best_of(make_base_hypothesis(of), [far, make_base_hypothesis(of)]) is far


def test_what_is_worth_nothing_is_not_chosen() -> None:
    of = base()
    assert best_of(make_base_hypothesis(of), [left_by("heating", of=of, pads=0.99)]) is None


def test_what_worsens_other_relations_more_than_it_helps_is_not_chosen() -> None:
    """Slip whose lost samples had moved it: laws helped the pads a little and made other balances far worse."""
    of = base(pads=3.0)
    assert best_of(make_base_hypothesis(of), [left_by("heating", of=of, girder=30.0)]) is None
