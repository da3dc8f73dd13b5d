"""Campaigns of the bench: the contract's form, blind, repeatable, complete where nothing is hidden."""

import numpy as np
import pytest

from slipwise_benchmarks.campaign import build_campaign, make_campaign
from slipwise_benchmarks.faults import Fault, with_rails
from slipwise_benchmarks.floors import noise_floors
from slipwise_benchmarks.gauges import NOISE, RICH, USUAL, Logger, measure
from slipwise_benchmarks.hidden import INSTRUMENTS, PHYSICS, draw, hide, plan
from slipwise_benchmarks.settings import GRAVITY, PADS, rated
from slipwise_benchmarks.write import unit_of


@pytest.fixture(scope="module")
def complete():
    return build_campaign(21, effects=(), rig="bridge1")


@pytest.fixture(scope="module")
def rich_run():
    return build_campaign(22, effects=(), rig="bridge2", rich=True)


def test_folder_has_the_contracts_form_and_not_the_answer(tmp_path):
    make_campaign(tmp_path / "b1", 23, effects=["heating"], size="small")
    assert sorted(path.name for path in (tmp_path / "b1").iterdir()) == sorted(
        ["campaign.toml", *(f"{run}.csv" for run in ("sine_hv", "quake_h", "quake_hv", "quake_hv_again", "quake2_hv"))]
    )
    text = (tmp_path / "b1" / "campaign.toml").read_text()
    assert 'name = "b1"' in text and text.count('role = "fit"') == 3 and "heating" not in text
    header, first = (tmp_path / "b1" / "quake_hv.csv").read_text().splitlines()[:2]
    assert header.split(",")[:7] == [
        *("time [s]", "table_ax [m/s^2]", "table_az [m/s^2]", "girder_ax [m/s^2]", "girder_az [m/s^2]"),
        *("slip_x [mm]", "pad_A_N [kN]"),
    ]
    assert float(first.split(",")[6]) == pytest.approx(24.5, abs=0.6)


@pytest.mark.slow
def test_one_seed_gives_one_campaign(complete):
    again = build_campaign(21, effects=(), rig="bridge1")
    other = build_campaign(24, effects=(), rig="bridge1")
    for run, channels in complete.recorded.items():
        assert all(np.array_equal(values, again.recorded[run][name]) for name, values in channels.items())
    assert not np.array_equal(complete.recorded["quake_h"]["slip_x"], other.recorded["quake_h"]["slip_x"])


def test_slips_and_loads_are_those_of_a_laboratory(complete, rich_run):
    for made in (complete, rich_run):
        for run in made.true.values():
            assert 0.005 < np.abs(run["slip_x"]).max() < 0.045
            assert min(run[f"pad_{pad}_N"].min() for pad in PADS) > 0.0


def test_a_complete_campaign_leaves_sensor_noise_in_its_balances(complete):
    truth = complete.truth
    assert truth.missing == () and truth.size_in_floors < 0.05
    base, floors = truth.base, noise_floors(truth.base, truth.logger.noise)
    for run in complete.recorded.values():
        force = sum(run[f"pad_{pad}_Fx"] for pad in PADS)
        load = sum(run[f"pad_{pad}_N"] for pad in PADS)
        girder = base.mass * run["girder_ax"] + force + base.buffer_stiffness * run["slip_x"]
        heave = load - base.mass * (GRAVITY + run["girder_az"])
        assert 0.9 * floors["girder"] < np.std(girder) < 1.4 * floors["girder"]
        assert 0.9 * floors["heave"] < np.std(heave) < 1.4 * floors["heave"]


def test_a_complete_rich_campaign_lacks_nothing_either(rich_run):
    assert rich_run.truth.size_in_floors < 0.05


def test_repeat_is_the_same_motion_with_fresh_noise(complete):
    first, again = complete.recorded["quake_hv"], complete.recorded["quake_hv_again"]
    difference = np.std(first["table_ax"] - again["table_ax"])
    assert difference == pytest.approx(np.sqrt(2.0) * complete.truth.logger.noise["table"], rel=0.1)


def test_true_slip_speed_is_the_derivative_of_true_slip(complete):
    true, at = complete.true["quake_hv"], complete.at_samples("quake_hv")
    speed = np.gradient(true["slip_x"], true["time"])
    assert np.std(speed - true["slip_vx"]) < 2e-3 * np.std(true["slip_vx"])
    assert at["time"] == pytest.approx(complete.recorded["quake_hv"]["time"])


def test_a_rich_campaign_moves_across_and_records_it(rich_run):
    run = rich_run.recorded["quake_hv"]
    assert set(RICH) <= set(run)
    assert np.abs(run["slip_y"]).max() > 2e-3
    assert all(unit_of(name)[0] for name in run)


@pytest.mark.parametrize("effect", INSTRUMENTS)
def test_a_faulty_gauge_changes_its_own_channels_only(effect, complete):
    true = complete.true["quake_hv"]
    (fault,) = hide([effect], "large", rated("bridge1"), np.random.default_rng(31)).faults
    fault = with_rails(fault, [true]) if effect == "channel_clipping" else fault
    sound, faulty = (measure(true, USUAL, Logger(), faults, None) for faults in ([], [fault]))
    for name in USUAL:
        changed = not np.array_equal(sound[name], faulty[name])
        assert changed == (name in fault.channels)


def test_a_late_channel_shows_the_past(complete):
    true = complete.true["quake_hv"]
    late = Fault("channel_delay", ("girder_ax",), 4.0e-3)
    sound, faulty = (measure(true, USUAL, Logger(), faults, None) for faults in ([], [late]))
    assert faulty["girder_ax"][2:] == pytest.approx(sound["girder_ax"][:-2], abs=1e-6)


def test_noise_is_what_the_logger_says(complete):
    true = complete.true["quake_h"]
    clean, noisy = (measure(true, USUAL, Logger(), [], rng) for rng in (None, np.random.default_rng(32)))
    assert np.std(noisy["pad_B_N"] - clean["pad_B_N"]) == pytest.approx(NOISE["load"], rel=0.05)
    assert np.std(noisy["slip_x"] - clean["slip_x"]) == pytest.approx(NOISE["slip"], rel=0.05)


def test_plan_covers_the_catalogue_and_a_third_is_complete():
    cases = plan(300, 1)
    assert sum(case.effects == () for case in cases) == 100
    singles = {case.effects[0].partition(":")[0] for case in cases if len(case.effects) == 1}
    assert singles == {*PHYSICS, *INSTRUMENTS, "unknown"}
    assert sum(len(case.effects) == 2 for case in cases) >= 30
    assert all(draw(seed) == draw(seed) for seed in range(20))


def test_unknown_names_are_errors():
    with pytest.raises(KeyError):
        hide(["no_such_effect"], "small", rated("bridge1"), np.random.default_rng(0))
