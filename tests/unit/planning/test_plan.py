"""A plan of the reference rig: chances of its effects in one short motion, and what it says where it cannot say all."""

import json

import numpy as np
import pytest

import slipwise as sw
from slipwise.model import base_model, use
from slipwise.planning.sensors import make_sensors

MOTION = "quake:seed=2,peak=0.7g,f=4Hz,strong=2s,vertical=0.3g"
GAUGES = ("pad_*_N", "pad_*_Fx", "slip_x", "girder_ax", "table_ax")


@pytest.fixture(scope="module")
def short() -> sw.PlannedTest:
    return sw.plan("bridge1", [MOTION], GAUGES, rate=250.0, corner=80.0)


def test_what_is_named_was_seen_and_every_chance_is_one(short):
    chances = [c for one in short.sets for c in one.chances]
    assert chances
    assert all(0.0 <= c.named <= c.seen <= 1.0 for c in chances)
    assert all(c.named + sum(share for _, share in c.taken_for) <= 1.0 + 1e-9 for c in chances)


def test_a_strong_motion_names_some_effects_and_not_those_far_below_the_noise(short):
    named = {c.effect: c.named for c in short.planned.of_rig}
    assert max(named.values()) > 0.7
    least = {c.effect: c.least for c in short.planned.of_rig}
    assert all(named[effect] < 0.1 for effect, size in least.items() if size > 2.0)


def test_effects_that_heave_alone_shows_have_chances_with_a_vertical_accelerometer_only(short):
    assert short.planned.chance_of("key_friction") is None
    with_heave = [one for one in short.sets if "girder_az" in one.channels and one.chances]
    assert with_heave and all(one.chance_of("key_friction") is not None for one in with_heave)


def test_a_mass_off_its_place_is_put_in_where_it_moves_an_answer_by_two_percent(short):
    [chance] = [c for c in short.planned.of_rig if c.effect == "mass_eccentricity"]
    assert chance.unit == "m" and 1e-4 < abs(chance.value) < 0.05


def test_buffers_that_are_unlike_are_put_in_where_they_move_a_channel_by_its_limit(short):
    """Friction holds the girder until they are unlike enough: no straight line leads from a small size to the limit."""
    [chance] = [c for c in short.planned.of_rig if c.effect == "buffer_mismatch"]
    model, motion = base_model("bridge1"), sw.load_motion(MOTION)
    unlike = model.adding(use("buffer_mismatch", difference=chance.value))
    one, other = (sw.replay(m, motion).record for m in (model, unlike))
    moved = [np.std(other[c] - one[c]) / np.std(one[c]) for c in short.planned.channels if c in one and c != "table_ax"]
    assert max(moved) == pytest.approx(0.02, rel=0.25)


def test_the_plan_is_json_and_says_its_gauges_and_motion(short):
    content = json.loads(json.dumps(short.as_json(), allow_nan=False))
    assert content["sets"][0]["channels"] == list(short.planned.channels) and len(short.planned.channels) == 11
    assert [m["motion"] for m in content["motions"]] == [MOTION]
    assert {r["effect"] for r in short.rows} >= {"heating", "channel_gain"}


def test_without_a_motion_the_gauges_alone_are_judged_and_a_sentence_says_so():
    found = sw.plan("bridge1")
    assert not found.motions and not found.planned.chances
    assert "No motion is planned" in found.notes[0]
    assert "11 channels" in found.sentence and "At the limit" not in found.sentence


def test_ten_channels_take_the_cells_the_slip_gauge_and_the_girders_accelerometer():
    found = sw.plan("bridge1", budget=10)
    assert set(found.planned.channels) == {
        *(f"pad_{pad}_{kind}" for pad in "ABCD" for kind in ("N", "Fx")), "slip_x", "girder_ax",
    }  # fmt: skip


def test_a_budget_beyond_all_channels_is_said_to_be_so():
    assert "fewer than the budget of 99" in sw.plan("bridge1", budget=99).notes[0]


def test_gauges_that_no_balance_uses_are_named_and_alone_refused():
    assert sw.plan("bridge1", gauges=[*GAUGES, "pad_A_T"]).unused == ("pad_A_T",)
    with pytest.raises(sw.SlipwiseError, match="no balance of bridge1 uses any of pad_A_T"):
        sw.plan("bridge1", gauges=["pad_A_T"])


def test_cells_on_some_pads_only_make_no_balance_and_that_is_said():
    channels = ["slip_x", "pad_A_N", "pad_*_Fx", "girder_ax", "girder_az", "table_ax", "table_az"]
    some = sw.plan("bridge1", (), channels)
    assert any("pad_D_Fx, girder_ax" in note and "on some pads only" in note for note in some.notes)
    unseen = {"buffer", "guide_drag", "key_friction", "table_pitch", "uneven_seating"}
    assert unseen <= set(some.planned.structure.unseen) and "pad friction" not in some.planned.structure.unseen
    every = sw.plan("bridge1", (), [*channels, "pad_*_N"])
    assert not unseen & set(every.planned.structure.unseen)
    assert not any("some pads only" in note for note in every.notes)


def test_a_prescribed_slip_is_judged_by_its_balances_alone():
    found = sw.plan("pad", [MOTION])
    assert "prescribed" in found.notes[0] and not found.planned.chances


def test_a_motion_that_cannot_be_read_is_refused_before_anything_is_replayed():
    with pytest.raises(sw.SlipwiseError):
        sw.plan("bridge1", ["quake:seed=2,peak=many"])
    with pytest.raises(sw.SlipwiseError, match="planned twice"):
        sw.plan("bridge1", [MOTION, MOTION])


@pytest.mark.parametrize(("rate", "corner"), [(0.0, None), (-1.0, None), (200.0, 150.0), (None, 0.0)])
def test_a_chain_that_cannot_be_is_refused(rate, corner):
    with pytest.raises(sw.SlipwiseError, match="cannot be"):
        make_sensors(None, rate, corner)


def test_a_plan_is_a_table_of_pandas(short):
    pytest.importorskip("pandas")
    assert {"gauges", "effect", "seen", "named"} <= set(short.to_pandas().columns)
