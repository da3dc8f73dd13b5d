"""Ensembles: what is drawn lies where it should, a member is a replay, and tables are those of their members."""

import numpy as np
import pyarrow.parquet as pq
import pytest

from slipwise.errors import SettingError, UnitError, UnknownNameError
from slipwise.model import base_model
from slipwise.motion import load_motion, scale
from slipwise.simulation.replay import replay
from slipwise.studies.ensemble import QUANTILES, Base, Shaken, read_scales, read_varied, run_scaled, run_shaken
from slipwise.studies.ensemble.distributions import draw, with_values
from slipwise.studies.ensemble.member import member_key, motion_key
from slipwise.studies.ensemble.responses import read_limit

MODEL = base_model("bridge1")
SINE = "sine:2Hz,0.2g,cycles=9"


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Two motions at two scales, four draws of a mass and a rate."""
    folder = tmp_path_factory.mktemp("ensemble")
    vary = ("rig.mass=9..11t", "shear_rate.rate=10..30s/m")
    return run_scaled(
        [SINE, "sine:3Hz,0.2g,cycles=9"], folder, vary=vary, scales="1:2:1", members=4, limits=["slip_x=9mm"], workers=1
    )


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [
        ("rig.mass=9..11t", 9e3, 11e3),
        ("rig.mass = 9000 kg .. 11 t", 9e3, 11e3),
        ("rig.mass=9.5..10.5 t", 9.5e3, 10.5e3),
        ("rig.centre_x=-2..2mm", -2e-3, 2e-3),
        ("rig.bending_damping=1..5%", 0.01, 0.05),
        ("shear_rate.rate=0.1..0.3 s/cm", 10.0, 30.0),
    ],
)
def test_a_range_takes_the_unit_of_its_upper_end_or_of_each(text, low, high):
    varied = read_varied(text, MODEL)
    assert (varied.low, varied.high) == pytest.approx((low, high))


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("rig.mass=9..11", UnitError, "no unit"),
        ("rig.mass=9..11 mm", UnitError, "wrong dimension"),
        ("rig.mass=11..9t", SettingError, "lower end first"),
        ("rig.mass=9t", SettingError, "KEY=LOW..HIGH"),
        ("rig.mas=9..11t", UnknownNameError, "rig.mass"),
        ("heating.share=0..1", UnknownNameError, "--effect"),
        ("rig.centre_height=-3..2m", SettingError, "cannot be"),
        ("shear_rate.rate=10..1e9 s/m", SettingError, "out of bounds"),
    ],
)
def test_a_range_that_cannot_be_is_refused_before_anything_is_shaken(text, kind, words):
    with pytest.raises(kind, match=words):
        read_varied(text, MODEL)


@pytest.mark.parametrize("sampling", ["sobol", "latin"])
def test_draws_fill_their_ranges_evenly_and_the_same_seed_draws_the_same(sampling):
    varied = [read_varied("rig.mass=9..11t", MODEL), read_varied("rig.centre_x=-2..2mm", MODEL)]
    drawn = draw(varied, 64, sampling, 7)
    assert np.array_equal(drawn, draw(varied, 64, sampling, 7))
    assert not np.array_equal(drawn, draw(varied, 64, sampling, 8))
    for column, v in zip(drawn.T, varied, strict=True):
        eighths = np.histogram(column, 8, (v.low, v.high))[0]
        assert list(eighths) == [8] * 8
        assert column.mean() == pytest.approx(0.5 * (v.low + v.high), abs=0.02 * (v.high - v.low))


def test_an_unknown_sampling_is_told():
    with pytest.raises(UnknownNameError, match="sobol"):
        draw([read_varied("rig.mass=9..11t", MODEL)], 4, "soboll", 1)


def test_more_members_of_sobol_begin_with_the_fewer():
    varied = [read_varied("rig.mass=9..11t", MODEL)]
    assert np.array_equal(draw(varied, 16, "sobol", 1)[:8], draw(varied, 8, "sobol", 1))


def test_drawn_numbers_go_to_rig_and_effect_and_leave_the_rest():
    model = with_values(MODEL, {"rig.mass": 9100.0, "rig.buffer_stiffness": 2e6, "shear_rate.rate": 12.0})
    assert model.specimen.mass == 9100.0 and model.specimen.buffer_stiffness == (2e6, 2e6)
    assert model["shear_rate"].values["rate"] == 12.0
    assert model["shear_rate"].values["strength"] == MODEL["shear_rate"].values["strength"]
    assert model.specimen.centre_height == MODEL.specimen.centre_height


def test_scales_have_both_ends():
    assert read_scales("0.5:3:0.5") == (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
    assert read_scales("0.1:0.3:0.1") == (0.1, 0.2, 0.3)
    assert read_scales("1:2:0.6") == (1.0, 1.6)
    assert read_scales("2") == (2.0,)


@pytest.mark.parametrize("text", ["", "0", "0:1:0.5", "1:2", "3:1:1", "1:2:0", "nan", "1:inf:1", "1:2:1e-9", "a:b:c"])
def test_scales_that_cannot_be_are_refused(text):
    with pytest.raises(SettingError, match="--scale"):
        read_scales(text)


def test_a_member_is_the_replay_of_its_model_and_motion():
    motion = load_motion(SINE)
    member = Shaken(Base("bridge1"), (("rig.mass", 9500.0),), motion, 1.5)
    numbers = run_shaken(member)
    answer = replay(with_values(MODEL, {"rig.mass": 9500.0}), scale(motion, 1.5))
    assert numbers["slip"] == answer.largest_slip
    assert numbers["energy"] == sum(answer.pad_energy.values())
    assert numbers["pad_load"] == max(high for _, high in answer.load_range.values())
    assert numbers["residual_slip"] == abs(answer.record["slip_x"][-1])
    assert (numbers["uplift"], numbers["uplifts"], numbers["buffer_hit"]) == (0.0, 0, None)
    assert run_shaken(Shaken(member.base, member.values, SINE, 1.5)) == numbers


def test_pads_that_lift_are_counted_and_a_play_that_closes_is_seen():
    lifted = run_shaken(Shaken(Base("bridge1"), (), "quake:seed=1,peak=0.7g,vertical=1.5g", 1.0))
    assert lifted["uplift"] > 0.0 and lifted["uplifts"] > 1
    for clearance, hit in ((1e-3, True), (9e-3, False)):
        loose = Shaken(
            Base("bridge1", effects=("key_clearance",)), (("key_clearance.clearance", clearance),), SINE, 0.4
        )
        assert run_shaken(loose)["buffer_hit"] is hit


def test_a_simulation_that_diverges_is_a_result():
    assert "slip grew beyond" in run_shaken(Shaken(Base("bridge1"), (), SINE, 3000.0))["failed"]


def test_the_key_changes_with_everything_that_decides_the_result():
    base, motion = Base("bridge1").key(), motion_key(load_motion(SINE))
    values = {"rig.mass": 9500.0}
    keys = [
        member_key(base, motion, 1.0, values),
        member_key(Base("bridge2").key(), motion, 1.0, values),
        member_key(Base("bridge1", "coulomb").key(), motion, 1.0, values),
        member_key(Base("bridge1", effects=("run_in",)).key(), motion, 1.0, values),
        member_key(base, motion_key(load_motion("sine:2Hz,0.21g,cycles=9")), 1.0, values),
        member_key(base, motion, 1.5, values),
        member_key(base, motion, 1.0, {"rig.mass": 9501.0}),
        member_key(base, motion, 1.0, {}),
    ]
    assert len(set(keys)) == len(keys)


def test_every_motion_and_scale_meets_the_same_draws(found):
    table = pq.read_table(found.path).to_pandas()
    assert len(table) == 16 and found.run == 16
    for _, group in table.groupby(["motion", "scale"]):
        assert list(group["member"]) == [0, 1, 2, 3]
        assert list(group["rig.mass"]) == list(table["rig.mass"][:4])
    assert table["rig.mass"].between(9e3, 11e3).all() and table["rig.mass"].nunique() == 4


def test_columns_say_their_units(found):
    schema = pq.read_schema(found.path)
    units = {name: (schema.field(name).metadata or {}).get(b"unit") for name in schema.names}
    assert units["rig.mass"] == b"kg" and units["slip"] == b"m" and units["pad_load"] == b"N"


def test_more_shaking_slides_farther_and_heavier_girders_press_harder(found):
    table = pq.read_table(found.path).to_pandas()
    weak, strong = (table[table["scale"] == s].reset_index() for s in (1.0, 2.0))
    assert (strong["slip"] > weak["slip"]).all() and (strong["energy"] > weak["energy"]).all()
    first = table[:4].sort_values("rig.mass")
    assert first["pad_load"].is_monotonic_increasing


def test_quantiles_and_exceedances_are_those_of_the_members(found):
    table = pq.read_table(found.path).to_pandas()
    for q in found.quantiles:
        own = table[(table["motion"] == q.motion) & (table["scale"] == q.scale)][q.response.name]
        assert q.values == pytest.approx(np.percentile(own, QUANTILES))
        assert (q.members, q.failed) == (4, 0)
    for e in found.exceedances:
        own = table[(table["motion"] == e.motion) & (table["scale"] == e.scale)]["slip_x"]
        assert e.over == (own > 9e-3).sum()
    assert len({e.over for e in found.exceedances}) > 1


def test_the_same_again_runs_nothing_and_writes_the_same_bytes(found):
    before = found.path.read_bytes()
    again = run_scaled(
        list(found.motions), found.path.parent, vary=("rig.mass=9..11t", "shear_rate.rate=10..30s/m"),
        scales="1:2:1", members=4, workers=1,
    )  # fmt: skip
    assert again.run == 0 and found.path.read_bytes() == before


def test_members_that_diverged_are_in_no_quantile_and_counted(tmp_path):
    found = run_scaled([SINE], tmp_path, scales="3000", workers=1)
    assert {(q.members, q.failed) for q in found.quantiles} == {(0, 1)}
    assert np.isnan(found.quantiles[0].values).all()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"members": 0}, "at least 1"),
        ({"law": "stribeck"}, "paper and coulomb"),
        ({"effects": ["heatin"]}, "heating"),
        ({"limits": ["slipx=3mm"]}, "slip_x"),
        ({"limits": ["slip_x"]}, "RESPONSE=VALUE"),
        ({"vary": ["rig.mass=9..11t", "rig.mass=9..10t"]}, "twice"),
    ],
)
def test_what_cannot_be_is_told_before_anything_is_shaken(given, words, tmp_path):
    with pytest.raises((SettingError, UnknownNameError), match=words):
        run_scaled([SINE], tmp_path, **given)
    assert not list(tmp_path.iterdir())


def test_a_limit_is_read_with_its_unit():
    assert read_limit("slip_x = 30 mm").value == pytest.approx(0.03)
    assert read_limit("pad_load=60kN").value == pytest.approx(6e4)
