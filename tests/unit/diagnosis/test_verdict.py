"""From what a search has tried to a verdict that is no stronger than its evidence."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from hypotheses import base, left_by, searched
from slipwise.diagnosis.choice import best_of, has_delay_for_filter
from slipwise.diagnosis.hypothesis import Hypothesis, base_hypothesis
from slipwise.diagnosis.verdict import Verdict, decide_verdict, with_faults
from slipwise.effects import Effect, catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.parameters import Term
from slipwise.estimation.run_data import FitRun
from slipwise.instruments.sample_faults import SampleFault


def _decided(of: BaseFit, *tried: Hypothesis) -> Verdict:
    return decide_verdict(searched(of, *tried))


def _speed(run: FitRun) -> np.ndarray:
    """A state that predicts what is left."""
    return run.velocity


def test_a_model_that_leaves_noise_is_complete():
    of = base()
    assert _decided(of).kind == "complete"
    assert decide_verdict(replace(searched(of), tried=[left_by("heating", of=of, pads=0.99)])).kind == "complete"


@pytest.mark.parametrize("relation", ["pads", "girder", "roll"])
def test_what_stands_far_above_the_noise_is_unknown_even_if_no_state_predicts_it(relation: str) -> None:
    found = _decided(base(**{relation: 12.0}))
    assert found.kind == "unknown" and found.surface is None


def test_what_a_state_predicts_is_shown_over_that_state():
    of = base(pads=6.0)
    little = left_by("heating", of=of, pads=5.0, over=_speed)
    found = _decided(of, little)
    assert found.kind == "unknown" and found.effects == ()
    assert found.surface is not None and "velocity" in found.surface.states


def test_an_effect_that_explains_all_is_named_with_confidence():
    of = base(pads=20.0)
    found = _decided(of, left_by("heating", of=of), left_by("run_in", of=of, pads=12.0))
    assert (found.kind, found.effects, found.leftover) == ("named", ("heating",), "none")
    assert found.probability > 0.9


def test_the_more_an_effect_leaves_the_less_sure_it_is():
    of = base(pads=20.0)
    found = [_decided(of, left_by("heating", of=of, pads=1.0 + 19.0 * share)) for share in (0.0, 0.15, 0.25)]
    assert {each.effects for each in found} == {("heating",)}
    assert found[0].probability > found[1].probability > found[2].probability


def test_two_effects_that_explain_as_much_are_ambiguous():
    of = base(pads=20.0)
    found = _decided(of, left_by("heating", of=of), left_by("run_in", of=of))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "run_in"}


def test_a_law_of_far_more_constants_that_says_no_more_is_no_rival():
    """A patch as wide as the stroke is pads that differ; a filter has only an order more than a delay."""
    of = base(pads=20.0)
    patch = left_by("position_patch", of=of, pads=1.0005)
    assert _decided(of, left_by("pad_spread", of=of), patch).kind == "named"
    slow = {"channel_filter.lag": 5e-3}
    assert _decided(of, left_by("channel_delay", of=of), left_by("channel_filter", of=of, values=slow)).rivals


@pytest.mark.parametrize(("lag", "kind"), [(1e-3, "instrument"), (5e-3, "ambiguous")])
def test_a_filter_that_takes_nothing_is_no_rival_of_a_delay(lag: float, kind: str) -> None:
    """Of order 2, a lag of 1 ms is a corner of 225 Hz, above the logger's own of 100 Hz; one of 5 ms is 45 Hz."""
    of = base(pads=20.0)
    behind = left_by("channel_filter", of=of, pads=1.0005, values={"channel_filter.lag": lag})
    assert has_delay_for_filter(behind) == (kind == "instrument")
    assert _decided(of, left_by("channel_delay", of=of), behind).kind == kind


@cache
def _own() -> Effect:
    """An effect of a user's own that is one thing with damping of buffers unless yaw was measured."""
    return replace(catalogue()["guide_drag"], name="rollers", same_unless={"buffer_damping": ("yaw",)})


@pytest.mark.parametrize(("gauges", "kind"), [((), "ambiguous"), (("yaw",), "named")])
def test_effects_that_are_one_thing_are_told_apart_only_by_what_their_files_ask_for(gauges, kind) -> None:
    of = base(*gauges, girder=9.0)
    found = _decided(of, left_by(Term(_own()), of=of))
    assert found.kind == kind
    assert found.effects == (("buffer_damping", "rollers") if kind == "ambiguous" else ("rollers",))


def test_damping_of_buffers_and_of_guides_are_told_apart_by_the_girders_pitch() -> None:
    of = base(girder=9.0)
    found = _decided(of, left_by("guide_drag", of=of))
    assert (found.kind, found.effects) == ("named", ("guide_drag",))


def test_one_of_two_effects_that_are_one_thing_is_given_with_the_other_beside_a_third():
    of = base(pads=30.0)
    found = _decided(of, left_by("heating", Term(_own()), of=of))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "buffer_damping", "rollers"}


def test_an_effect_that_explains_little_of_much_is_not_named():
    of = base(pads=30.0)
    found = _decided(of, left_by("heating", of=of, pads=18.0))
    assert (found.kind, found.effects) == ("unknown", ())


def test_a_gauge_is_an_instrument():
    of = base(pads=5.0)
    assert _decided(of, left_by("channel_gain", of=of)).kind == "instrument"


def test_faults_of_samples_are_named_whatever_is_left_without_them():
    fault = SampleFault("held", ("pad_A_N",), 0.01, {}, ())
    clean, more = (with_faults(_decided(of), [fault]) for of in (base(), base(pads=12.0)))
    for found in (clean, more):
        assert (found.kind, found.effects) == ("instrument", ("dropped_samples",))
    assert more.probability < 0.7 < clean.probability, "something else is missing that has no name"


@pytest.mark.parametrize(
    ("moved", "channel", "named"), [(True, "girder_ax", False), (False, "girder_ax", True), (True, "slip_x", True)]
)
def test_a_gauge_that_lost_samples_for_good_is_late_by_that(moved, channel, named):
    of, late = base(pads=5.0), Term(catalogue()["channel_delay"], ("girder_ax",), "girder_ax")
    fault = SampleFault("lost" if moved else "held", (channel,), 0.01, {}, ())
    found = with_faults(_decided(of, left_by(late, of=of)), [fault], [late])
    assert found.kind == "instrument"
    assert found.effects == (("channel_delay",) if named else ()) + ("dropped_samples",)


@pytest.mark.parametrize(("name", "kind"), [("slide_curvature", "unknown"), ("breakaway", "named")])
def test_geometry_that_leaves_structure_is_not_geometry_but_a_law_may_have_another_form(name: str, kind: str) -> None:
    of = base(pads=20.0)
    found = _decided(of, left_by(name, of=of, pads=3.0, over=_speed))
    assert (found.kind, found.leftover) == (kind, "unknown")


@pytest.mark.parametrize(("left", "kind"), [(1.3, "named"), (6.0, "unknown")])
@pytest.mark.parametrize("over", [_speed, None])
def test_two_laws_that_leave_much_may_be_a_third(left: float, kind: str, over) -> None:
    """Together two laws take many forms: what neither of them is they explain for the most part."""
    of = base(pads=20.0)
    assert _decided(of, left_by("breakaway", "rate_and_state", of=of, pads=left, over=over)).kind == kind


@pytest.mark.parametrize(("held", "kind"), [(1.2, "named"), (100.0, "unknown")])
def test_two_laws_that_are_bent_to_look_quiet_where_they_were_fitted_are_not_named(held: float, kind: str) -> None:
    of = base(pads=300.0)
    assert _decided(of, left_by("rate_and_state", "breakaway", of=of, pads=1.2, held_out={"pads": held})).kind == kind


@pytest.mark.parametrize(("girder", "kind"), [(1.0, "named"), (1.3, "unknown")])
def test_what_repairs_one_relation_and_worsens_another_is_not_what_is_there(girder: float, kind: str) -> None:
    of = base(pads=20.0)
    both = left_by("slide_curvature", "cell_inertia", of=of, pads=1.2, girder=girder, over=_speed)
    assert _decided(of, both).kind == kind


def test_a_law_needs_less_to_be_named_than_a_lag_that_takes_up_small_errors_of_a_model() -> None:
    def least(name: str) -> float:
        """The smallest drop of the pads' mean squared residual at which this effect is chosen and named."""
        for drop in (0.01 * n for n in range(1, 30)):
            of = base(pads=1.0 + drop)
            chosen = best_of(base_hypothesis(of), [left_by(name, of=of)])
            if chosen is not None and _decided(of, chosen).effects == (name,):
                return drop
        return np.inf

    assert 0.01 < least("breakaway") < least("channel_delay") < np.inf


def test_nobody_is_sure_of_what_no_held_out_run_has_confirmed():
    seen, unseen = (
        _decided(of, left_by("heating", of=of)) for of in (base(pads=30.0), base(pads=30.0, held_out=False))
    )
    assert seen.effects == unseen.effects == ("heating",)
    assert unseen.probability < seen.probability
