"""From what a search has tried to a verdict that is no stronger than its evidence."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import pytest
from slipwise.diagnosis.samples import SampleFault

from slipwise.diagnosis.choice import is_delay, material_alone, needless
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.search_state import Search
from slipwise.diagnosis.verdict import judge, with_faults
from slipwise.effects import catalogue
from slipwise.estimation.parameters import Term
from slipwise.evidence.materiality import is_near, material
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.signals import LowPass

COUNT = 10_000


def _tried(
    names: tuple[str, ...], pads: float, girder: float = 1.0, at_bounds: tuple[str, ...] = (), constants: int = 3
) -> Hypothesis:
    """A hypothesis with these mean squared residuals in fitted and held-out runs alike."""
    levels = {"pads": pads * COUNT, "girder": girder * COUNT}
    account = ResidualSummary(levels, dict(levels), {name: (COUNT, COUNT) for name in levels})
    terms = tuple(Term(catalogue()[name]) for name in names)
    values = {f"{t.label}.{k}": v for t in terms for k, v in t.effect.typical().items()}
    run = SimpleNamespace(states=SimpleNamespace(has_yaw=False), filtered=LowPass(100.0))
    problem = SimpleNamespace(held_out=[], fitted=[], runs=[run], relations=("pads", "girder"))
    solution = SimpleNamespace(values=values, at_bounds=at_bounds, free=(None,) * constants)
    return Hypothesis(terms, cast(Any, problem), cast(Any, solution), account)


def _search(base: Hypothesis, *tried: Hypothesis) -> Search:
    """A search that took the best of what it tried, where that is material."""
    best = min((base, *tried), key=lambda h: h.summary.total)
    path = [base, best] if material_alone(base, best) else [base]
    return Search(cast(Any, None), {}, [], list(tried), tuple(path))


def test_a_model_that_leaves_noise_is_complete():
    assert judge(_search(_tried((), 1.0), _tried(("heating",), 0.99))).kind == "complete"


def test_what_stands_far_above_the_noise_is_unknown_even_if_no_state_foretells_it():
    assert judge(_search(_tried((), 12.0))).kind == "unknown"


@pytest.mark.parametrize(("constants", "kind"), [(3, "ambiguous"), (4, "ambiguous"), (7, "named")])
def test_a_law_of_far_more_constants_that_says_no_more_is_no_rival(constants: int, kind: str) -> None:
    """A filter has an order more than a delay and stays its rival; a patch as wide as the stroke has four more."""
    rich = _tried(("position_patch",), 1.0005, constants=constants)
    found = judge(_search(_tried((), 20.0), _tried(("pad_spread",), 1.0), rich))
    assert found.kind == kind


@pytest.mark.parametrize(("lag", "kind"), [(1e-3, "instrument"), (5e-3, "ambiguous")])
def test_a_filter_that_takes_nothing_is_no_rival_of_a_delay(lag: float, kind: str) -> None:
    """Of order 2, a lag of 1 ms is a corner of 225 Hz, above the logger's own of 100 Hz; one of 5 ms is 45 Hz."""
    base, delay, behind = _tried((), 20.0), _tried(("channel_delay",), 1.0), _tried(("channel_filter",), 1.0005)
    behind.solution.values["channel_filter.lag"] = lag
    assert is_delay(behind) == (kind == "instrument")
    assert judge(_search(base, delay, behind)).kind == kind


def test_a_law_of_far_more_constants_gives_way_to_one_that_does_as_well() -> None:
    base, plain = _tried((), 20.0), _tried(("pad_spread",), 1.0005)
    assert needless(plain, _tried(("position_patch",), 1.0, constants=7), base.summary)
    assert not needless(plain, _tried(("position_patch",), 1.0, constants=4), base.summary)
    assert not needless(plain, _tried(("position_patch",), 0.99, constants=7), base.summary), "it says more"


def test_nobody_is_sure_of_an_effect_that_leaves_a_quarter() -> None:
    quarter, little = (judge(_search(_tried((), 20.0), _tried(("heating",), 1.0 + 19.0 * x))) for x in (0.25, 0.05))
    assert quarter.effects == little.effects == ("heating",)
    assert quarter.probability == 0.5 and little.probability > 0.9


def test_an_effect_that_explains_all_is_named_with_confidence():
    found = judge(_search(_tried((), 20.0), _tried(("heating",), 1.0), _tried(("run_in",), 12.0)))
    assert (found.kind, found.effects) == ("named", ("heating",))
    assert found.probability > 0.9


def test_two_effects_that_explain_as_much_are_ambiguous():
    found = judge(_search(_tried((), 20.0), _tried(("heating",), 1.0), _tried(("run_in",), 1.0)))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "run_in"}


def test_damping_of_buffers_and_of_guides_are_one_thing_without_a_yaw_gauge():
    found = judge(_search(_tried((), 1.0, girder=9.0), _tried(("guide_drag",), 1.0, girder=1.0)))
    assert (found.kind, found.effects) == ("ambiguous", ("buffer_damping", "guide_drag"))


def test_an_effect_that_explains_little_of_much_is_not_named():
    assert judge(_search(_tried((), 30.0), _tried(("heating",), 18.0))).kind == "unknown"


def test_a_gauge_is_an_instrument():
    assert judge(_search(_tried((), 5.0), _tried(("channel_gain",), 1.0))).kind == "instrument"


@pytest.mark.parametrize("left", [1.0, 12.0])
def test_faults_of_samples_are_named_whatever_is_left_when_they_are_mended(left):
    fault = SampleFault("dropped_samples", "pad_A_N", 0.01)
    found = with_faults(judge(_search(_tried((), left))), [fault])
    assert found.effects == ("dropped_samples",)
    assert found.kind == "instrument"
    assert (found.probability < 0.7) == (left > 2.0)


@pytest.mark.parametrize(
    ("moved", "channel", "named"), [(True, "girder_ax", False), (False, "girder_ax", True), (True, "slip_x", True)]
)
def test_a_gauge_that_lost_samples_for_good_is_late_by_that(moved, channel, named):
    late = Term(catalogue()["channel_delay"], ("girder_ax",), "girder_ax")
    found = replace(judge(_search(_tried((), 5.0), _tried(("channel_delay",), 1.0))), kind="instrument")
    told = with_faults(found, [SampleFault("dropped_samples", channel, 0.01, moved)], [late])
    assert told.kind == "instrument"
    assert told.effects == (("channel_delay",) if named else ()) + ("dropped_samples",)


def _structured(found: Hypothesis) -> Any:
    return SimpleNamespace(relation="pads", explained=0.5, level=1.0)


@pytest.mark.parametrize(("name", "kind"), [("slide_curvature", "unknown"), ("breakaway", "named")])
def test_geometry_that_leaves_structure_is_not_geometry_but_a_law_may_have_another_form(monkeypatch, name, kind):
    monkeypatch.setattr("slipwise.diagnosis.verdict.leftover", _structured)
    assert judge(_search(_tried((), 20.0), _tried((name,), 3.0))).kind == kind


@pytest.mark.parametrize(("left", "kind"), [(1.5, "named"), (4.0, "unknown")])
@pytest.mark.parametrize("shaped", [True, False])
def test_two_laws_that_leave_much_may_be_a_third(monkeypatch, left: float, kind: str, shaped: bool) -> None:
    """Of what a cubic drag left, breakaway and the age of a contact explained 0.88 together, and neither was there."""
    if shaped:
        monkeypatch.setattr("slipwise.diagnosis.verdict.leftover", _structured)
    assert judge(_search(_tried((), 20.0), _tried(("breakaway", "rate_and_state"), left))).kind == kind


@pytest.mark.parametrize(("held", "kind"), [(1.4, "named"), (168.0, "unknown")])
def test_two_laws_that_are_bent_to_look_quiet_where_they_were_fitted_are_not_named(held: float, kind: str) -> None:
    base, both = _tried((), 300.0), _tried(("rate_and_state", "breakaway"), 1.4)
    account = replace(both.summary, held_out={**both.summary.held_out, "pads": held * COUNT})
    assert judge(_search(base, replace(both, summary=account))).kind == kind


@pytest.mark.parametrize(("girder", "kind"), [(1.01, "named"), (1.08, "unknown")])
def test_what_repairs_one_relation_and_spoils_another_is_not_what_is_there(monkeypatch, girder, kind) -> None:
    """Curvature and inertia of cells took friction that follows acceleration from the pads, and left some elsewhere."""
    monkeypatch.setattr("slipwise.diagnosis.verdict.leftover", _structured)
    both = _tried(("slide_curvature", "cell_inertia"), 1.05, girder=girder)
    assert judge(_search(_tried((), 5.0), both)).kind == kind


@pytest.mark.parametrize(("name", "kind"), [("breakaway", "named"), ("channel_delay", "complete")])
def test_a_law_needs_less_to_be_named_than_a_lag_that_takes_up_small_errors_of_a_model(name: str, kind: str) -> None:
    assert judge(_search(_tried((), 1.07), _tried((name,), 1.0))).kind == kind
    assert judge(_search(_tried((), 1.03), _tried((name,), 1.0))).kind == "complete"


@pytest.mark.parametrize(("left", "worthy"), [(1.02, True), (6.0, False)])
def test_a_second_law_beside_a_huge_one_must_explain_nearly_all_that_is_left(left: float, worthy: bool) -> None:
    """Cross-talk of 20 floors leaves 4.4: half of that may be its own wrong form, all of it is another effect."""
    base, first = _tried((), 400.0), _tried(("load_crosstalk",), 8.0)
    both = _tried(("load_crosstalk", "rate_and_state"), left)
    assert material(base.summary, first.summary, both.summary) == worthy


@pytest.mark.parametrize(("touched", "worthy"), [(1.15, True), (1.6, False)])
def test_beside_an_effect_of_buffers_a_law_of_pads_is_worth_a_name_as_it_is_alone(touched: float, worthy: bool) -> None:
    """Breakaway takes 0.15 from the pads; had the first effect changed them, that might be its own wrong form."""
    base, first = _tried((), touched, girder=3.0), _tried(("buffer_hardening",), 1.15, girder=1.0)
    both = _tried(("buffer_hardening", "breakaway"), 1.0, girder=1.0)
    assert material(base.summary, first.summary, both.summary) == worthy


@pytest.mark.parametrize(("left", "near", "worthy"), [(7.95, False, False), (7.88, True, False), (1.02, True, True)])
def test_a_further_law_is_fitted_on_only_where_half_of_what_is_worth_a_name_is_there(
    left: float, near: bool, worthy: bool
) -> None:
    base, first, both = _tried((), 9.0), _tried(("heating",), 8.0), _tried(("heating", "run_in"), left)
    assert is_near(base.summary, first.summary, both.summary) == near
    assert material(base.summary, first.summary, both.summary) == worthy


def test_any_relation_far_above_its_noise_is_no_complete_model():
    base = _tried((), 1.0)
    levels = {"pads": 1.0, "girder": 1.0, "roll": 4.0}
    total = {name: level * COUNT for name, level in levels.items()}
    account = ResidualSummary(total, dict(total), {name: (COUNT, COUNT) for name in levels})
    assert judge(_search(replace(base, summary=account))).kind == "unknown"


def test_nobody_is_sure_of_what_no_held_out_run_has_confirmed():
    def unseen(of: Hypothesis) -> Hypothesis:
        counts = {name: (fitted, 0) for name, (fitted, _) in of.summary.counts.items()}
        return replace(of, summary=replace(of.summary, held_out=dict.fromkeys(counts, 0.0), counts=counts))

    found = judge(_search(unseen(_tried((), 30.0)), unseen(_tried(("heating",), 1.0))))
    assert found.kind == "named" and found.probability <= 0.9


def test_one_of_two_effects_that_are_one_thing_is_given_with_the_other_beside_a_third():
    found = judge(_search(_tried((), 30.0), _tried(("heating", "buffer_damping"), 1.0)))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "buffer_damping", "guide_drag"}
