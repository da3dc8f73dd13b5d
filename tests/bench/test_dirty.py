"""Dirty campaigns: drawn from the seed alone, clean where no dirt is, with an answer that simulation gives."""

from collections import Counter

import numpy as np
import pytest

from slipwise_benchmarks.answer_key import Scene, alone, answer_key
from slipwise_benchmarks.campaign import shake
from slipwise_benchmarks.dirty import build_dirty
from slipwise_benchmarks.dirty_logger import draw_dirty_logger
from slipwise_benchmarks.dirty_plan import MIX, Plan, draw_plan, group_of
from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.first_things import KINDS
from slipwise_benchmarks.floors import sizes_in_floors
from slipwise_benchmarks.gauges import USUAL, Logger, measure, sensor
from slipwise_benchmarks.importance import relative_changes
from slipwise_benchmarks.other_forms import OTHER_FORMS
from slipwise_benchmarks.pad_law import bristle
from slipwise_benchmarks.planted import Plant, faults_of, together
from slipwise_benchmarks.quakes import draw_pulse, draw_record, draw_sweep
from slipwise_benchmarks.rig_ode import Memory
from slipwise_benchmarks.settings import GRAVITY, PADS, rated
from slipwise_benchmarks.write import campaign_toml

SPOTLESS = Plan("nothing", (), (), rich=False, runs=2, short=True, uplift=False)


def _plant(effect: str, scale: float, dirt: bool = True) -> Plant:
    return Plant(effect, scale, 3, dirt, 1.0)


@pytest.fixture(scope="module")
def scene():
    motion = draw_record(np.random.default_rng(1), 4.0)
    memories = (Memory(), Memory())
    return Scene(rated("bridge1"), (motion, motion.scaled(1.1)), (0, 1), memories, 0.0, Logger(), USUAL)


@pytest.fixture(scope="module")
def bare(scene):
    return scene.shaken(())


@pytest.fixture(scope="module")
def spotless():
    return build_dirty(5, plan=SPOTLESS)


def test_a_seed_decides_everything():
    assert all(draw_plan(seed) == draw_plan(seed) for seed in range(30))
    assert draw_plan(1) != draw_plan(2)
    first, again = (draw_dirty_logger(np.random.default_rng(4), USUAL) for _ in range(2))
    assert first == again


def test_seeds_in_a_row_keep_to_the_mix():
    counted = Counter(group_of(seed) for seed in range(300, 500))
    assert all(counted[group] == pytest.approx(200 * share, abs=3) for group, share in MIX.items())


def test_every_fault_that_comes_before_any_balance_has_its_turn():
    counted = Counter(plan.first[0] for plan in map(draw_plan, range(300, 700)) if plan.first)
    assert set(counted) == set(KINDS) and max(counted.values()) - min(counted.values()) <= 3


def test_plans_hide_what_their_group_says():
    for seed in range(200):
        plan = draw_plan(seed)
        chosen = [plant for plant in plan.plants if not plant.dirt and plant.target > 0.8]
        most = {"nothing": 0, "one or two": 2, "three to five": 5, "unknown": 3, "first": 2}[plan.group]
        assert len(chosen) <= most and bool(plan.first) == (plan.group == "first")
        assert sum(plant.dirt for plant in plan.plants) >= 5


def test_one_seed_gives_one_campaign(spotless):
    again = build_dirty(5, plan=SPOTLESS)
    for run, channels in spotless.recorded.items():
        assert all(np.array_equal(values, again.recorded[run][name]) for name, values in channels.items())


def test_without_imperfections_a_dirty_campaign_is_a_clean_one(spotless):
    base, logger = spotless.truth.base, spotless.truth.logger
    clean = shake(base, spotless.motions, 0.0, every=5)
    assert spotless.truth.key == {} and spotless.truth.missing == []
    for number, (run, true) in enumerate(clean.items()):
        assert all(np.array_equal(values, spotless.true[run][name]) for name, values in true.items())
        expected = measure(true, USUAL, logger, [], None, number)
        for name in USUAL:
            floor = logger.noise[sensor(name)] + (2.0 * logger.ranges[name] / 2.0**logger.bits if logger.bits else 0.0)
            assert np.std(spotless.recorded[run][name] - expected[name]) < 2.0 * floor


def test_what_is_absent_is_worth_nothing(scene, bare):
    tilt, gain = (alone(scene, _plant(name, 0.0), bare) for name in ("slide_tilt", "channel_gain"))
    assert tilt.importance.of_limit == 0.0 and gain.importance.of_limit == 0.0


def test_a_tilt_is_worth_the_share_of_the_load_that_it_adds_to_friction(scene, bare):
    found = alone(scene, _plant("slide_tilt", 5.0), bare)
    added = max(1.0e-3 * run["pad_A_N"].mean() / np.hypot(run["pad_A_Fx"].std(), 15.0) for run in bare)
    assert found.importance.channels["pad_A_Fx"] == pytest.approx(added, rel=0.2)  # a stuck pad shares it out


def test_a_gain_is_worth_itself_and_moves_no_rig(scene, bare):
    recorded = scene.recorded(bare, ())
    changes = relative_changes(
        scene.recorded(bare, [Fault("channel_gain", ("girder_ax",), 0.02)]), recorded, scene.noise()
    )
    assert changes["girder_ax"] == pytest.approx(0.02 / 1.02, rel=0.02)
    assert max(value for name, value in changes.items() if name != "girder_ax") == 0.0
    found = alone(scene, _plant("channel_gain", 1.0), bare)
    assert (found.importance.peak_slip, found.importance.energy, found.importance.largest_load) == (0.0, 0.0, 0.0)


def test_effects_beside_each_other_are_worth_what_they_are_alone(scene, bare):
    plants = [_plant("slide_tilt", 5.0), _plant("uneven_seating", 2.0), _plant("channel_offset", 3.0)]
    key = answer_key(scene, plants, faults_of(together(plants, scene.base), USUAL))
    assert list(key) == [plant.name for plant in plants]
    for plant in plants:
        lone = alone(scene, plant, bare).importance.of_limit
        assert key[plant.name].importance.of_limit == pytest.approx(lone, rel=0.15)


def test_seating_is_seen_and_a_stiffness_hides_in_the_base(scene, bare):
    seating = alone(scene, _plant("uneven_seating", 3.0), bare)
    assert seating.status == "material" and seating.after_fit == pytest.approx(seating.raw)
    gain = [Fault("channel_gain", ("slip_x",), 0.05)]
    sizes = sizes_in_floors(scene.base, bare, scene.recorded(bare, gain), scene.logger)
    assert sizes["after_fit"]["girder"] < 0.02 * sizes["raw"]["girder"]


@pytest.mark.parametrize("effect", OTHER_FORMS)
def test_laws_of_other_forms_change_the_rig_and_stay_finite(effect, scene, bare):
    found = alone(scene, _plant(effect, 1.0, dirt=False), bare)
    assert 0.5 < found.importance.of_limit < 100.0


def test_a_damped_bristle_overshoots_its_bound_and_one_without_damping_does_not():
    largest = []
    for lag in (0.0, 3.0e-3):
        z, forces = 0.0, []
        for _ in range(1000):
            force, _, z, _ = bristle(z, 0.0, 0.1, 0.0, 2.7e3, 0.0, 2.0e-4, lag, 2.0e-5)
            forces.append(force)
        largest.append(max(forces))
        assert forces[-1] == pytest.approx(2.7e3, rel=1e-3)
    assert largest[0] <= 2.7e3 and largest[1] == pytest.approx(2.7e3 * 3.0e-3 * 0.1 / 2.0e-4, rel=0.03)


def test_lifted_pads_bear_no_friction_and_a_flying_girder_feels_no_weight():
    motion = draw_record(np.random.default_rng(2), 4.0)
    lifting = motion.scaled(1.0, 1.8 * GRAVITY / np.abs(motion.az).max())
    (run,) = shake(rated("bridge1"), {"run": lifting}, 0.0).values()
    lifted = [run[f"pad_{pad}_N"] == 0.0 for pad in PADS]
    assert max(flags.sum() for flags in lifted) > 50
    for pad, flags in zip(PADS, lifted, strict=True):
        assert run[f"pad_{pad}_N"].min() >= 0.0
        assert np.abs(run[f"pad_{pad}_Fx"][flags]).max() == 0.0
    flying = np.logical_and.reduce(lifted)
    assert flying.sum() > 5 and run["girder_az"][flying] == pytest.approx(-GRAVITY)


@pytest.mark.parametrize("draw", [draw_record, draw_pulse, draw_sweep])
def test_motions_begin_and_end_at_rest_and_carry_both_directions(draw):
    motion = draw(np.random.default_rng(6), 7.0, True)
    for part in (motion.ax, motion.ay, motion.az):
        assert (
            np.abs(part[: int(0.7 / motion.step)]).max() < 1e-3 and np.abs(part[-int(0.4 / motion.step) :]).max() < 1e-3
        )
        assert 0.05 * GRAVITY < np.abs(part).max() < 1.0 * GRAVITY
    assert motion.followed_by_rest(2.0).duration == pytest.approx(motion.duration + 2.0)


def test_a_campaign_says_the_rig_and_the_mass_that_the_laboratory_believes():
    text = campaign_toml("d1", "bridge2", Logger(stated=False), (("run_1", "fit"), ("run_2", "holdout")), 10150.0)
    assert 'rig = "bridge2"' in text and 'mass = "10150 kg"' in text and "two runs" in text
