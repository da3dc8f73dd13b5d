"""The noise floor by channel and state: from a repeat, from quiet stretches, or unknown with the reason."""

from dataclasses import replace

import numpy as np
import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.campaign import measured_states
from slipwise.errors import SettingError
from slipwise.evidence.floor import STATES, noise_floor
from slipwise.view.words.floor_rows import floor_rows

KINDS = {"slip_x": "slip", "girder_ax": "girder", "table_az": "table", "pad_A_N": "load", "pad_D_Fx": "force"}


@pytest.fixture(scope="module")
def made():
    return build_campaign(52, effects=(), rig="bridge2")


@pytest.fixture(scope="module")
def campaign(made):
    return as_campaign(made)


def floor_of(campaign):
    return noise_floor(campaign, [measured_states(run, campaign) for run in campaign.runs])


def test_a_repeated_run_shows_the_noise_of_every_gauge_in_every_state(made, campaign):
    floor = floor_of(campaign)
    for name, kind in KINDS.items():
        for state in STATES:
            assert floor.of(name, state) == pytest.approx(made.truth.logger.noise[kind], rel=0.15), (name, state)
            assert floor.channels[name].basis[state].startswith("repeat")


def test_without_a_repeat_quiet_stretches_are_a_lower_bound_and_this_is_said(made, campaign):
    alone = replace(campaign, runs=tuple(r for r in campaign.runs if r.role != "repeat"))
    floor = floor_of(alone)
    assert floor.channels["slip_x"].basis["sliding"] in ("quiet stretch", "top of the spectrum")
    assert any("lower bound" in note for note in floor.notes)
    assert floor.of("slip_x", "sliding") == pytest.approx(made.truth.logger.noise["slip"], rel=0.2)


def test_a_repeat_of_another_motion_is_no_repeat(campaign):
    runs = tuple(replace(r, role="repeat" if r.name == "quake2_hv" else "fit") for r in campaign.runs)
    fewer = replace(campaign, runs=tuple(r for r in runs if r.name != "quake_hv_again"))
    assert any("quake2_hv repeats no other run" in note for note in floor_of(fewer).notes)


def test_a_constant_has_no_floor_and_the_reason_is_given(campaign):
    records = {r.name: r.record.replaced(pad_A_N=np.full(len(r.record), 24e3)) for r in campaign.runs}
    floor = floor_of(campaign.with_records(records, "constant"))
    assert not floor.channels["pad_A_N"].known
    (row,) = [row for row in floor_rows(floor) if row["channel"] == "pad_A_N"]
    assert row["sliding"] == "unknown" and row["from"].startswith("floor unknown: it is a constant")


def test_floors_are_shown_in_the_units_that_people_read(campaign):
    floor = floor_of(campaign)
    (row,) = [row for row in floor_rows(floor) if row["channel"] == "slip_x"]
    assert row["unit"] == "mm"
    assert float(row["sliding"]) == pytest.approx(1e3 * floor.of("slip_x", "sliding"), rel=0.01)


def test_a_floor_that_does_not_exist_is_asked_for_in_vain(campaign):
    with pytest.raises(SettingError, match="near reversal"):
        floor_of(campaign).of("slip_x", "gliding")
    with pytest.raises(SettingError, match="one for each run"):
        noise_floor(campaign, [])
