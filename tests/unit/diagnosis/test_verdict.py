"""From what a search has tried to a verdict that is no stronger than its evidence, and names what matters.

Noise is 20 N here and friction 2.7 kN: four hundred noise variances are 15 % of it, nine are 2 %.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from hypotheses import base, decided, left_by, searched
from slipwise.diagnosis import verdict
from slipwise.diagnosis.findings import _inclusion_of
from slipwise.diagnosis.verdict import Verdict, evidence_of, with_faults
from slipwise.effects import Effect, catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.sample_fault import SampleFault
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import FitRun
from slipwise.selection.hypothesis import Hypothesis
from slipwise.selection.inclusion import ABSENT


def _decided(of: BaseFit, *tried: Hypothesis, **material: float) -> Verdict:
    return decided(searched(of, *tried), material)


def _speed(run: FitRun) -> np.ndarray:
    """A state that predicts what is left."""
    return run.velocity


def test_a_model_that_leaves_noise_is_complete():
    of = base()
    assert _decided(of).kind == "complete"
    assert decided(replace(searched(of), tried=(left_by("heating", of=of, pads=0.99),))).kind == "complete"


def test_what_is_above_the_noise_but_does_not_matter_leaves_a_model_complete() -> None:
    """Two percent of what a balance is made of is what matters, however quiet its gauges are."""
    assert _decided(base(pads=6.0)).kind == "complete"


@pytest.mark.parametrize("relation", ["pads", "girder", "roll"])
def test_what_matters_and_stands_above_the_noise_is_unknown_even_if_no_state_predicts_it(relation: str) -> None:
    found = _decided(base(**{relation: 9e4}))
    assert found.kind == "unknown" and found.surface is None


def test_what_a_state_predicts_is_shown_over_that_state():
    of = base(pads=400.0)
    found = _decided(of, left_by("heating", of=of, pads=360.0, over=_speed))
    assert (found.leftover, found.unknown_beside) == ("unknown", True)
    assert found.surface is not None and "velocity" in found.surface.states


def test_an_effect_that_explains_all_is_named_with_confidence():
    of = base(pads=400.0)
    found = _decided(of, left_by("heating", of=of), left_by("run_in", of=of, pads=200.0))
    assert (found.kind, found.effects, found.leftover) == ("named", ("heating",), "none")
    assert found.probability > 0.8


def test_a_model_is_not_complete_where_only_what_is_not_believed_takes_away_what_it_leaves(monkeypatch) -> None:
    weak = {"lead": np.log(0.1), "spread": 0.4}  # no motion is predicted by a fit to the others, the size hardly known
    monkeypatch.setattr(verdict, "evidence_of", lambda finding: {**evidence_of(finding), **weak})
    large, small = base(pads=400.0), base(pads=6.0)
    found = _decided(large, left_by("heating", of=large))
    assert (found.kind, found.effects, found.minor, found.leftover) == ("unknown", (), (), "unknown")
    assert _decided(small, left_by("heating", of=small)).kind == "complete"


def test_what_is_there_and_does_not_matter_is_minor_and_not_named() -> None:
    of = base(pads=400.0)
    tried = left_by("heating", "slide_tilt", of=of), left_by("heating", of=of, pads=3.0)
    found = _decided(of, *tried, heating=4.0, slide_tilt=0.3)
    assert (found.kind, found.effects, found.minor) == ("named", ("heating",), ("slide_tilt",))
    alone = _decided(of, left_by("slide_tilt", of=of), slide_tilt=0.3)
    assert (alone.kind, alone.effects, alone.minor) == ("complete", (), ("slide_tilt",))


def test_many_effects_are_all_named_the_most_important_first() -> None:
    of = base(pads=400.0, girder=100.0)
    names = ("heating", "run_in", "buffer_damping", "uneven_seating", "slide_tilt")
    found = _decided(of, left_by(*names, of=of), **{name: 4.0 + i for i, name in enumerate(names)})
    assert found.kind == "named" and found.effects == tuple(reversed(names))


def test_the_nearer_to_what_matters_the_less_sure_it_is():
    of = base(pads=400.0)
    chances = [_decided(of, left_by("heating", of=of), heating=share).probability for share in (1.2, 0.93, 0.88)]
    assert chances[0] > chances[1] > chances[2]


def test_two_effects_that_explain_as_much_are_ambiguous():
    of = base(pads=400.0)
    found = _decided(of, left_by("heating", of=of), left_by("run_in", of=of))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "run_in"}


def test_a_law_of_far_more_constants_that_says_no_more_is_no_rival():
    """A patch as wide as the stroke is pads that differ."""
    of = base(pads=400.0)
    assert _decided(of, left_by("pad_spread", of=of), left_by("position_patch", of=of, pads=1.0005)).kind == "named"


@cache
def _own() -> Effect:
    """An effect of a user's own that is one thing with damping of buffers unless yaw was measured."""
    return replace(catalogue()["guide_drag"], name="rollers", same_unless={"buffer_damping": ("yaw",)})


@pytest.mark.parametrize(("gauges", "kind"), [((), "ambiguous"), (("yaw",), "named")])
def test_effects_that_are_one_thing_are_told_apart_only_by_what_their_files_ask_for(gauges, kind) -> None:
    of = base(*gauges, girder=900.0)
    found = _decided(of, left_by(Term(_own()), of=of))
    assert found.kind == kind
    assert found.effects == (("buffer_damping", "rollers") if kind == "ambiguous" else ("rollers",))


def test_damping_of_buffers_and_of_guides_are_told_apart_by_the_girders_pitch() -> None:
    of = base(girder=900.0)
    found = _decided(of, left_by("guide_drag", of=of))
    assert (found.kind, found.effects) == ("named", ("guide_drag",))


def test_one_of_two_effects_that_are_one_thing_is_given_with_the_other_beside_a_third():
    of = base(pads=900.0)
    found = _decided(of, left_by("heating", Term(_own()), of=of))
    assert found.kind == "ambiguous"
    assert set(found.effects) == {"heating", "buffer_damping", "rollers"}


def test_beside_an_effect_that_explains_little_of_much_something_is_missing_that_has_no_name():
    of = base(pads=900.0)
    found = _decided(of, left_by("heating", of=of, pads=600.0, over=_speed))
    assert (found.kind, found.effects, found.leftover) == ("named", ("heating",), "unknown")
    assert found.unknown_beside
    assert not _decided(of, left_by("heating", of=of, pads=4.0)).unknown_beside


def test_what_no_state_organises_is_no_law_but_makes_names_doubtful() -> None:
    of = base(pads=900.0)
    found = _decided(of, left_by("heating", of=of, pads=600.0))
    assert (found.kind, found.effects, found.leftover) == ("named", ("heating",), "none")
    assert found.is_doubtful


def test_a_gauge_is_an_instrument():
    of = base(pads=400.0)
    assert _decided(of, left_by("channel_gain", of=of)).kind == "instrument"


def test_faults_of_samples_are_named_whatever_is_left_without_them():
    fault = SampleFault("held", ("pad_A_N",), 0.01, {}, ())
    clean, more = (with_faults(_decided(of), [fault]) for of in (base(), base(pads=900.0)))
    for found in (clean, more):
        assert (found.kind, found.effects) == ("instrument", ("dropped_samples",))
    assert more.probability < 0.7 < clean.probability, "something else is missing that has no name"


@pytest.mark.parametrize(
    ("moved", "channel", "named"), [(True, "girder_ax", False), (False, "girder_ax", True), (True, "slip_x", True)]
)
def test_a_gauge_that_lost_samples_for_good_is_late_by_that(moved, channel, named):
    of, late = base(pads=400.0), Term(catalogue()["channel_delay"], ("girder_ax",), "girder_ax")
    fault = SampleFault("lost" if moved else "held", (channel,), 0.01, {}, ())
    found = with_faults(_decided(of, left_by(late, of=of)), [fault], [late])
    assert found.kind == "instrument"
    assert found.effects == (("channel_delay",) if named else ()) + ("dropped_samples",)


def test_a_law_of_another_form_is_named_with_what_it_leaves() -> None:
    of = base(pads=900.0)
    found = _decided(of, left_by("breakaway", of=of, pads=60.0, over=_speed))
    assert (found.kind, found.leftover, found.unknown_beside) == ("named", "unknown", True)


def test_a_plainer_effect_is_believed_as_the_one_of_which_it_is_the_end() -> None:
    """The posterior has taken a spring for a restrainer with a small gap."""
    of = base(pads=400.0)
    weak, sure = replace(ABSENT, matters=0.01), replace(ABSENT, matters=0.99)
    tried = left_by("slide_curvature", of=of), left_by("restrainer", of=of)
    state = replace(searched(of, *tried), inclusions={"slide_curvature": weak, "restrainer": sure})
    assert _inclusion_of(state, "slide_curvature", ["slide_curvature"]) is sure
    assert _inclusion_of(state, "slide_curvature", ["slide_curvature", "restrainer"]) is weak


def test_nobody_is_sure_of_what_no_held_out_run_has_confirmed():
    seen, unseen = (
        _decided(of, left_by("heating", of=of)) for of in (base(pads=900.0), base(pads=30.0, held_out=False))
    )
    assert seen.effects == unseen.effects == ("heating",)
    assert unseen.probability < seen.probability


@pytest.mark.parametrize(
    ("before", "after", "confirmed_by_it"),
    [(1e4, 4.0, True), (100.0, 4.0, True), (1e4, 20.0, True), (1e4, 100.0, False), (200.0, 16.0, False)],
)
def test_a_model_that_leaves_three_floors_and_a_twentieth_of_the_error_is_not_confirmed(
    before: float, after: float, confirmed_by_it: bool
) -> None:
    """Squared errors in noise variances: of 100 floors 4.5 are less than a twentieth, 10 are a tenth."""
    of = base(pads=before)
    state = searched(of, left_by("heating", of=of, pads=after))
    assert verdict.is_confirmed(state) is confirmed_by_it
    found, all_of_it = _decided(of, *state.tried), _decided(of, left_by("heating", of=of))
    assert found.effects == all_of_it.effects == ("heating",)
    assert found.probability <= all_of_it.probability
    assert confirmed_by_it or found.probability < all_of_it.probability - 0.1


def test_what_has_ended_where_it_is_another_effect_has_no_name() -> None:
    """A restrainer without a gap is a spring, whatever it explains."""
    of = base(pads=400.0)
    gap = catalogue()["restrainer"].parameter("limit")
    spring, rim = (
        _decided(of, left_by("restrainer", of=of, values={"restrainer.limit": at})) for at in (gap.low, 10.0 * gap.low)
    )
    assert (spring.kind, spring.effects, spring.leftover) == ("unknown", (), "unknown")
    assert (rim.kind, rim.effects) == ("named", ("restrainer",))


def test_a_name_beside_one_that_has_none_leaves_something_unknown() -> None:
    of = base(pads=400.0, girder=100.0)
    gap = catalogue()["restrainer"].parameter("limit").low
    found = _decided(of, left_by("restrainer", "buffer_damping", of=of, values={"restrainer.limit": gap}))
    assert (found.kind, found.effects, found.leftover) == ("named", ("buffer_damping",), "unknown")
