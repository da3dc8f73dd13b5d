"""Laws outside the catalogue: they act as stated, where stated, are large enough, and vanish with their size."""

from collections import Counter

import numpy as np
import pytest

from slipwise_benchmarks.answer_key import COARSE, EVERY, Scene, alone
from slipwise_benchmarks.gauges import USUAL, Logger
from slipwise_benchmarks.law import pads_at, place_of
from slipwise_benchmarks.law_campaign import LEAST, make_law_campaign
from slipwise_benchmarks.law_force import PORTS
from slipwise_benchmarks.law_plan import BESIDE, beside_of, draw_law_plan
from slipwise_benchmarks.law_states import HEAT, LAST_PEAK, LAST_STROKE, SINCE, STATES, UNITS, WAY, follow, fresh_memory
from slipwise_benchmarks.laws import LAWS
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.planted import LARGEST, Plant
from slipwise_benchmarks.quakes import draw_record
from slipwise_benchmarks.rig_ode import Memory, simulate
from slipwise_benchmarks.settings import GRAVITY, PAD_AREA, PADS, Settings, rated

BASE = rated("bridge1")
IN_LIBRARY = [name for name, law in LAWS.items() if not law.absent]


def plant(name: str, scale: float = 1.0) -> Plant:
    return Plant(f"law:{name}", scale, 5, False, 0.0)


def specimen(name: str, scale: float = 1.0) -> Settings:
    return BASE.changed(**plant(name, scale).hidden(BASE).settings)


@pytest.fixture(scope="module")
def motion() -> Motion:
    whole = draw_record(np.random.default_rng(2), 4.0)
    stronger = whole.scaled(0.9 * GRAVITY / np.abs(whole.ax).max())
    first = slice(int(0.6 / whole.step), int(3.2 / whole.step))
    return Motion(stronger.ax[first], stronger.ay[first], stronger.az[first])


@pytest.fixture(scope="module")
def scene(motion):
    return Scene(BASE, (motion,), (0,), (Memory(),), 7.0, Logger(), USUAL)


@pytest.fixture(scope="module")
def bare(scene):
    return scene.shaken(())


def shaken(settings: Settings, motion: Motion) -> dict:
    return simulate(settings, motion, step=COARSE, every=EVERY)


def coefficient(run: dict, pad: str) -> tuple:
    """What a law adds to a pad's friction over load, in the direction of slip, where the pad certainly slips."""
    speed = run[f"pad_{pad}_vx"]
    slips = np.abs(speed) > 0.03
    added = (run[f"pad_{pad}_Fx"] - run[f"pad_{pad}_Fx_base"]) * np.sign(speed) / run[f"pad_{pad}_N"]
    return added[slips], slips


def test_laws_cover_all_states_and_ports():
    driving = {state for name in IN_LIBRARY for state in LAWS[name].states}
    assert len(IN_LIBRARY) >= 20 and driving == set(STATES) == set(UNITS)
    assert {law.port for law in LAWS.values()} == {*PORTS, "one pad"}
    assert any(len(law.states) == 2 for law in LAWS.values()) and sum(law.absent for law in LAWS.values()) >= 3


@pytest.mark.parametrize("name", LAWS)
def test_a_law_without_size_is_not_there_and_one_of_the_largest_stands_above_noise(name, scene, bare):
    (gone,) = scene.shaken([plant(name, 0.0)])
    assert all(np.array_equal(values, gone[channel]) for channel, values in bare[0].items())
    assert alone(scene, plant(name, LARGEST), bare).after_fit > LEAST


def test_a_bump_in_speed_adds_itself_to_every_pads_coefficient(motion):
    settings = specimen("speed bump")
    run = shaken(settings, motion)
    for pad in PADS:
        added, slips = coefficient(run, pad)
        off = (np.abs(run[f"pad_{pad}_vx"][slips]) - settings.law_place) / settings.law_scale
        assert added == pytest.approx(settings.law_size * np.exp(-(off**2)), abs=2e-5)


def test_a_washboard_multiplies_friction_by_a_sine_of_slip(motion):
    settings = specimen("washboard")
    run = shaken(settings, motion)
    added, slips = coefficient(run, "C")
    wave = np.sin(2.0 * np.pi * run["slip_x"][slips] / settings.law_scale + settings.law_phase)
    base = np.abs(run["pad_C_Fx_base"][slips]) / run["pad_C_N"][slips]
    assert added == pytest.approx(base * settings.law_size * wave, abs=3e-4)


def test_grooves_have_another_period_on_the_way_back(motion):
    settings = specimen("grooves")
    run = shaken(settings, motion)
    added, slips = coefficient(run, "A")
    period = np.where(run["pad_A_vx"][slips] > 0.0, settings.law_scale, settings.law_back)
    wave = np.sin(2.0 * np.pi * run["slip_x"][slips] / period + settings.law_phase)
    base = np.abs(run["pad_A_Fx_base"][slips]) / run["pad_A_N"][slips]
    assert settings.law_back > settings.law_scale
    assert added == pytest.approx(base * settings.law_size * wave, abs=3e-4)


def test_a_law_of_one_pad_leaves_the_others_alone(motion):
    settings = specimen("fast pad").changed(yaw_known=1)  # one pad turns the girder, and pads slip unlike each other
    run = shaken(settings, motion)
    for share, pad in zip(settings.law_pads, PADS, strict=True):
        added, _ = coefficient(run, pad)
        assert np.abs(added).max() > 5e-3 if share else np.abs(added).max() < 1e-9


def test_outward_friction_depends_on_the_side_and_not_on_the_velocity(motion):
    settings = specimen("outward")
    run = shaken(settings, motion)
    added, slips = coefficient(run, "B")
    off = np.abs(run["slip_x"][slips]) > 2e-3
    force = added * np.sign(run["pad_B_vx"][slips]) * np.sign(run["slip_x"][slips])
    assert np.all(np.sign(force[off]) == np.sign(settings.law_size))


def test_drag_stands_in_the_girders_balance_and_in_no_pads(motion):
    settings = specimen("cubic drag")
    run = shaken(settings, motion)
    pads = sum(run[f"pad_{pad}_Fx"] for pad in PADS)
    left = BASE.mass * run["girder_ax"] + pads + run["buffer_1_Fx"] + run["buffer_2_Fx"]
    drag = settings.law_size * (np.abs(run["slip_vx"]) / settings.law_scale) ** settings.law_exponent
    assert left == pytest.approx(-drag * np.tanh(run["slip_vx"] / 2e-3), abs=1e-5 * BASE.mass)
    assert run["pad_A_Fx"] == pytest.approx(run["pad_A_Fx_base"], abs=1e-6)


def test_a_stop_pushes_at_the_buffers_on_one_side_only(motion):
    settings = specimen("one-sided stop")
    run = shaken(settings, motion)
    more = run["buffer_1_Fx"] + run["buffer_2_Fx"] - BASE.buffer_stiffness * run["slip_x"]
    stop = settings.law_size * np.clip(run["slip_x"] - settings.law_place, 0.0, None)
    assert stop.max() > 500.0 and more == pytest.approx(stop, abs=5.0)


def test_lift_takes_load_off_the_pads_or_puts_it_on(motion):
    settings = specimen("lift")
    run = shaken(settings, motion)
    load = sum(run[f"pad_{pad}_N"] for pad in PADS)
    lift = settings.law_size * run["slip_vx"] ** 2
    assert load - BASE.mass * (GRAVITY + run["girder_az"]) == pytest.approx(-lift, abs=1.0)


def test_a_memory_tells_the_stroke_and_takes_a_shiver_for_no_reversal():
    step, m = 1.0e-4, fresh_memory(2.4e4)[0]
    for velocity, seconds in ((0.2, 0.1), (-1.0e-3, 0.01), (0.1, 0.05), (-0.1, 0.03)):
        for _ in range(round(seconds / step)):
            follow(m, velocity, 2.4e4, 1.0, step)
    assert m[SINCE] == pytest.approx(0.03, abs=2 * step) and m[WAY] == pytest.approx(3e-3, abs=3e-5)
    assert m[LAST_PEAK] == 0.2 and m[LAST_STROKE] == pytest.approx(0.2 * 0.1 + 1e-5 + 0.1 * 0.05, rel=1e-2)


def test_heat_is_the_work_on_the_face_less_what_has_cooled(motion):
    settings = specimen("warm film")
    run = simulate(settings, motion, step=COARSE, every=1)
    heat, expected = 0.0, []
    for work in np.abs(run["pad_D_Fx"] * run["pad_D_vx"]) / PAD_AREA:
        heat += COARSE * (work - heat / settings.law_time)
        expected.append(heat)
    added, slips = coefficient(run, "D")
    off = (np.array(expected)[slips] - settings.law_place) / settings.law_scale
    assert added == pytest.approx(settings.law_size * np.exp(-(off**2)), abs=2e-5)
    assert fresh_memory(1.0)[0, HEAT] == 0.0


def test_a_law_of_the_clock_differs_between_two_runs_of_one_motion(motion):
    noon = specimen("chance").changed(clock=1800.0)
    later = noon.changed(clock=3600.0)
    first, again, other = (shaken(s, motion)["pad_A_Fx"] for s in (noon, noon, later))
    assert np.array_equal(first, again) and np.std(first - other) > 20.0


@pytest.mark.parametrize("name", LAWS)
def test_the_truth_of_a_law_says_what_was_planted(name):
    law, settings = LAWS[name], specimen(name, 2.0)
    truth = law.truth(settings)
    assert truth["state"] == list(law.states) and truth["where"] in law.where
    assert truth["driver"] == ("absent" if law.absent else "in library")
    assert abs(truth["constants"]["size"]["value"]) == pytest.approx(2.0 * law.size)
    assert all(isinstance(one["value"], float) and one["unit"] for one in truth["constants"].values())


def test_places_of_a_law_are_pads_or_sides():
    assert pads_at("pad B") == (0.0, 1.0, 0.0, 0.0) and pads_at("side x+") == (1.0, 0.0, 1.0, 0.0)
    assert all(place_of(pads_at(place)) == place for place in ("all", "pad D", "side x-", "side y+", "side y-"))


def test_seeds_in_a_row_meet_every_law_and_campaigns_without_one():
    plans = [draw_law_plan(seed) for seed in range(500, 700)]
    met = Counter(plan.law for plan in plans)
    assert set(met) == {*LAWS, ""} and met[""] == pytest.approx(40, abs=3)
    assert 0.4 < np.mean([plan.dirty for plan in plans]) < 0.6
    assert any(not plan.law and plan.beside for plan in plans) and any(len(plan.beside) == 2 for plan in plans)
    assert draw_law_plan(7) == draw_law_plan(7) != draw_law_plan(8)


@pytest.mark.parametrize("name", ["", *LAWS])
def test_nothing_that_stands_for_a_part_of_a_law_is_put_beside_it(name):
    left = beside_of(name)
    assert set(left) <= set(BESIDE) and len(left) >= 7
    assert name != "loaded side" or not {"pad_spread", "pressure_law"} & set(left)


def test_a_campaign_is_written_as_others_are_with_its_truth_beside(tmp_path):
    answer = make_law_campaign(tmp_path / "l1", 90001, law="washboard")
    text = (tmp_path / "l1" / "campaign.toml").read_text()
    assert {path.name for path in (tmp_path / "l1").iterdir()} == {
        "campaign.toml",
        "truth.json",
        *(f"run_{number}.csv" for number in range(1, 6)),
    }
    assert text.count('role = "fit"') == 3 and 'role = "repeat"' in text and 'role = "holdout"' in text
    assert "washboard" not in text and answer["law"]["state"] == ["slip"] and answer["floors"] >= LEAST
