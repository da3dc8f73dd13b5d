"""Gravity in vertical gauges, cells that count compression negative or were tared: each by its name."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import slipwise
from slipwise.campaign import Campaign, load_campaign
from slipwise.campaign.same_specimen import check_same_specimen
from slipwise.comparison.compare import compare
from slipwise.errors import InputError
from slipwise.instruments.checks import check_instruments, corrected_campaign
from slipwise.preparation.signs import find_wrong_signs
from slipwise.preparation.tare import find_tared_cells
from slipwise.record import Record

DEMO = Path(slipwise.__file__).parent / "demo_data"
G = 9.80665
LOADS = tuple(f"pad_{pad}_N" for pad in "ABCD")


@pytest.fixture(scope="module")
def demo() -> Campaign:
    return load_campaign(DEMO)


def altered(campaign: Campaign, **changes: Callable[[np.ndarray], np.ndarray]) -> Campaign:
    """The campaign with channels as a logger would have stored them."""
    runs = []
    for run in campaign.runs:
        channels = {n: changes[n](v) if n in changes else v for n, v in run.record.channels.items()}
        runs.append(replace(run, record=Record(run.record.time, channels, run.record.provenance)))
    return replace(campaign, runs=tuple(runs))


def accused(campaign: Campaign) -> dict[str, str]:
    return {finding.name: finding.words for finding in check_instruments(campaign).report.findings}


@pytest.mark.parametrize(
    "signs", [{"table_az": 1.0, "girder_az": 1.0}, {"girder_az": 1.0}, {"table_az": -1.0, "girder_az": -1.0}]
)
def test_gravity_in_vertical_gauges_is_named_and_nobody_else_is_accused(demo, signs):
    wrong = altered(demo, **{name: (lambda v, s=s: v + s * G) for name, s in signs.items()})
    found = accused(wrong)
    assert found == {
        f"channel_offset:{name}": f"gravity is in {name}: it reads {sign * G:+.3g} m/s^2 at rest"
        for name, sign in signs.items()
    }
    assert all(f"gravity is in {name}" in " ".join(check_same_specimen(wrong)) for name in signs)


def test_gravity_is_taken_out_where_the_finding_is_corrected(demo):
    wrong = altered(demo, girder_az=lambda v: v + G)
    right = corrected_campaign(wrong, check_instruments(wrong), ["channel_offset:girder_az"])
    np.testing.assert_allclose(right.runs[0].record["girder_az"], demo.runs[0].record["girder_az"], atol=1e-9)
    assert not accused(right)


def test_both_vertical_gauges_counted_downwards_are_each_named_once(demo):
    wrong = altered(demo, table_az=np.negative, girder_az=np.negative)
    assert sorted(accused(wrong)) == ["channel_sign:girder_az", "channel_sign:table_az"]


@pytest.mark.parametrize(("turned", "named"), [(LOADS, "pad_*_N"), (("pad_B_N",), "pad_B_N")])
def test_loads_that_count_compression_negative_are_named_as_such(demo, turned, named):
    wrong = altered(demo, **dict.fromkeys(turned, np.negative))
    check_same_specimen(wrong)
    assert accused(wrong) == {f"channel_sign:{named}": f"{named} has the wrong sign"}


def test_a_sliders_load_that_counts_compression_negative_has_the_wrong_sign(demo):
    slider = replace(demo, specimen=replace(demo.specimen, free=False, places=demo.specimen.places[:1]))
    assert find_wrong_signs(slider) == []
    assert find_wrong_signs(altered(slider, pad_A_N=np.negative)) == ["pad_A_N"]


def tared(campaign: Campaign) -> Campaign:
    rest = {name: float(np.mean(campaign.runs[0].record[name][:40])) for name in LOADS}
    return altered(campaign, **{name: (lambda v, r=r: v - r) for name, r in rest.items()})


def test_cells_tared_under_the_girder_are_named_with_the_missing_weight(demo):
    wrong = tared(demo)
    weight = demo.specimen.weight
    assert accused(wrong)["channel_offset:pad_*_N"] == (
        f"pad_*_N were set to zero under the girder: its weight of {weight / 1e3:.4g} kN is missing in them"
    )
    assert "weight of" in " ".join(check_same_specimen(wrong))


def test_the_missing_weight_is_put_back_on_request_where_the_mass_is_known(demo):
    wrong = replace(tared(demo), known={})
    checks = check_instruments(wrong)
    with pytest.raises(InputError, match=r"give the girder's mass in campaign\.toml"):
        corrected_campaign(wrong, checks, ["channel_offset:pad_*_N"])
    known = replace(wrong, known={"mass": demo.specimen.mass})
    right = corrected_campaign(known, checks, ["channel_offset:pad_*_N"])
    total = np.sum([right.runs[0].record[name][:40].mean() for name in LOADS])
    assert total == pytest.approx(demo.specimen.weight, rel=1e-3)
    assert not any("pad_*_N" in words and "zero" in words for words in accused(right).values())


def tared_alone(campaign: Campaign, *names: str) -> Campaign:
    rest = {name: float(np.mean(campaign.runs[0].record[name][:40])) for name in names}
    return altered(campaign, **{name: (lambda v, r=r: v - r) for name, r in rest.items()})


@pytest.mark.parametrize("names", [("pad_B_N",), ("pad_A_N", "pad_D_N")])
def test_single_cells_that_were_tared_are_each_named_with_their_part_and_nobody_else_is(demo, names):
    wrong = tared_alone(demo, *names)
    found = accused(wrong)
    assert set(found) == {f"channel_offset:{name}" for name in names}
    for name in names:
        assert re.match(
            rf"{name} was set to zero under the girder: its part of the weight, 2\d\.\d+ kN, is",
            found[f"channel_offset:{name}"],
        )
        assert any(words.startswith(f"{name} was set to zero") for words in check_same_specimen(wrong))


def test_the_part_of_a_single_tared_cell_is_put_back_where_the_mass_is_known(demo):
    wrong = replace(tared_alone(demo, "pad_B_N"), known={})
    checks = check_instruments(wrong)
    with pytest.raises(InputError, match=r"give the girder's mass in campaign\.toml.*what the others do not carry"):
        corrected_campaign(wrong, checks, ["channel_offset:pad_B_N"])
    known = replace(wrong, known={"mass": demo.specimen.mass})
    right = corrected_campaign(known, checks, ["channel_offset:pad_B_N"])
    before, after = (campaign.runs[0].record["pad_B_N"][:40].mean() for campaign in (demo, right))
    assert after == pytest.approx(before, rel=0.01)
    assert not accused(right)


@pytest.mark.slow
def test_a_comparison_puts_the_weight_of_a_tared_cell_back_and_says_so(demo):
    found = compare(tared_alone(demo, "pad_C_N"), system=False)
    (told,) = found.corrections
    assert told.kind == "tared" and "rated weight was put back" in told.words
    errors = [of.error("pads", held_out=True) for of in (found, compare(demo, system=False))]
    assert errors[0] == pytest.approx(errors[1], rel=0.1)


@pytest.mark.parametrize("names", [("pad_B_N",), LOADS])
def test_cells_that_were_tared_before_some_runs_only_are_told_and_mended_as_the_message_says(demo, names):
    wrong = tared_alone(demo, *names)
    some = replace(demo, runs=(*demo.runs[:3], *wrong.runs[3:]))
    with pytest.raises(
        InputError, match="in quake_hv_again, quake2_hv alone .* set to zero under the girder.*of their"
    ):
        check_same_specimen(some)
    check_same_specimen(replace(demo, runs=demo.runs[:3]))
    notes = check_same_specimen(replace(demo, runs=wrong.runs[3:]))
    assert any("set to zero under the girder" in words for words in notes)


def test_a_pad_that_carries_nothing_and_a_dead_cell_are_not_taken_for_tared(demo):
    quarter = demo.specimen.weight / 4.0
    lifted = {"pad_A_N": -1.0, "pad_D_N": -1.0, "pad_B_N": 1.0, "pad_C_N": 1.0}
    seated = altered(demo, **{name: (lambda v, s=s: v + 0.95 * s * quarter) for name, s in lifted.items()})
    dead = altered(demo, pad_B_N=lambda v: np.zeros_like(v))
    faint = altered(demo, pad_B_N=lambda v: 0.02 * v)
    assert [find_tared_cells(campaign) for campaign in (demo, seated, dead, faint)] == [(), (), (), ()]
