"""Families of campaigns: each has what it says, both makers shake alike, and what is made is kept until it is stale."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise_benchmarks.campaign import fit_amplitude, shake
from slipwise_benchmarks.code_hash import reached
from slipwise_benchmarks.dirty import build_dirty
from slipwise_benchmarks.dirty_plan import Plan
from slipwise_benchmarks.drawn_rigs import DRAWN, draw_rig, possible_on
from slipwise_benchmarks.families import FAMILIES, MAKERS, build_family
from slipwise_benchmarks.family_dirt import SOILS, Soiled, noisy
from slipwise_benchmarks.family_score import accused, missed, right
from slipwise_benchmarks.family_store import Order, add_features, is_made, make, orders, read_answers, read_features
from slipwise_benchmarks.first_things import LATE_CELLS, LATE_CHANNEL, draw_first
from slipwise_benchmarks.gauges import USUAL, Logger, measure
from slipwise_benchmarks.hidden import PHYSICS
from slipwise_benchmarks.library_effects import UNLISTED, draw_use
from slipwise_benchmarks.library_replay import library_model, replayed
from slipwise_benchmarks.more_dirt import temperature
from slipwise_benchmarks.plan_rigs import STOREYS, draw_plan_rig
from slipwise_benchmarks.planted import faults_of, together
from slipwise_benchmarks.quakes import draw_record
from slipwise_benchmarks.rig_ode import simulate
from slipwise_benchmarks.settings import GRAVITY, pad_names, random_rig, rated
from slipwise_benchmarks.sliders import KINDS_OF_SLIDER, build_slider

PLAN = Plan("nothing", (), (), rich=False, runs=2, short=True, uplift=False)
RIGS = {family.name: family for family in FAMILIES.values() if family.plan is not None}


def still(seconds: float = 8.0) -> dict[str, np.ndarray]:
    """True channels of a rig at rest."""
    time = np.arange(0.0, seconds, 5.0e-4)
    true = {name: np.zeros(time.size) for name in USUAL}
    return {"time": time, **true, "girder_az": np.zeros(time.size)}


def test_families_share_no_seed_and_two_of_ten_and_more_kinds_of_dirt_are_held_out():
    seeds = [seed for family in FAMILIES.values() for seed in family.seeds]
    assert len(seeds) == len(set(seeds)) and min(seeds) >= 700_000
    assert sum(family.dirt for family in FAMILIES.values()) >= 10
    assert [name for name, family in FAMILIES.items() if family.held_out_family] == ["second_logger", "temperature"]


@pytest.mark.parametrize("maker", MAKERS)
def test_what_held_out_families_have_is_in_no_family_of_training(maker):
    for family in RIGS.values():
        late = set()
        for seed in family.seeds[:12]:
            plan = family.plan(seed, maker).plan
            names = {plant.name for plant in plan.plants}
            late |= {kind for kind in plan.first if kind in ("late", LATE_CELLS)}
            assert ("temperature" in names) == (family.name == "temperature")
            assert ("clock_skew" in names) == (family.name == "second_logger")
        assert late == ({LATE_CELLS} if family.name == "second_logger" else set())


def test_a_kind_of_dirt_is_alone_at_even_seeds_and_beside_all_that_is_usual_at_odd_ones():
    for name in ("gains", "drifts", "temperature"):
        dirt = [{p.name for p in RIGS[name].plan(seed, "ode").plan.plants if p.dirt} for seed in RIGS[name].seeds[:6]]
        assert all(len(alone) == 1 for alone in dirt[::2])
        assert all(len(mixed) >= 4 and dirt[0] <= mixed for mixed in dirt[1::2])


def test_hum_stands_out_at_the_frequency_of_the_mains_and_noise_is_larger_at_low_frequency():
    for seed in range(3):
        chain = noisy(Logger(), np.random.default_rng(seed))
        run = measure(still(), USUAL, chain, [], np.random.default_rng(seed))
        power = np.abs(np.fft.rfft(run["girder_ax"])) ** 2
        frequency = np.fft.rfftfreq(run["time"].size, 1.0 / chain.rate)
        beside = np.median(power[(frequency > chain.mains - 8.0) & (frequency < chain.mains + 8.0)])
        assert chain.mains in (50.0, 60.0) and power[np.argmin(np.abs(frequency - chain.mains))] > 20.0 * beside
        assert power[(frequency > 0.0) & (frequency < 5.0)].mean() > 2.0 * power[frequency > 150.0].mean()


def test_a_drift_drifts_by_what_it_says():
    plan = SOILS["drifts"](Soiled(PLAN, None), np.random.default_rng(3)).plan
    faults = faults_of(together(plan.plants, rated("bridge1")), USUAL)
    run = measure(still(), USUAL, Logger(), faults, None)
    assert faults
    for fault in faults:
        (name,) = fault.channels
        assert run[name][-1] - run[name][0] == pytest.approx(fault.size * run["time"][-1], rel=1e-2)


def test_a_leaning_accelerometer_feels_the_other_axis():
    plan = SOILS["coupled_gauges"](Soiled(PLAN, None), np.random.default_rng(3)).plan
    faults = [f for f in faults_of(together(plan.plants, rated("bridge1")), USUAL) if f.effect == "cross_axis"]
    true = still()
    true["girder_ax"] = np.sin(2.0 * np.pi * 3.0 * true["time"])
    run = measure(true, USUAL, Logger(), faults, None)
    share = next(fault.size for fault in faults if fault.channels == ("girder_az",))
    assert run["girder_az"] == pytest.approx(share * run["girder_ax"], abs=1e-6)


def test_a_second_logger_is_late_with_all_cells_and_a_late_channel_is_alone():
    rng = np.random.default_rng(1)
    cells = {name for name in USUAL if name.startswith("pad_")}
    assert set(draw_first(LATE_CELLS, USUAL, 3, rng).channels) == cells
    assert len(draw_first(LATE_CHANNEL, USUAL, 3, rng).channels) == 1


@pytest.mark.parametrize("shaker", [simulate, replayed], ids=MAKERS)
def test_a_warmer_hall_lowers_friction_in_its_run_alone(shaker):
    base = rated("bridge1")
    levels = (1.0, 0.9, *temperature(np.random.default_rng(1), 1.0, base)["run_levels"][2:])
    motion = fit_amplitude(base, draw_record(np.random.default_rng(1), 4.0), 0.02, 2.0, 9.0)
    runs = list(shake(base.changed(run_levels=levels), {"cold": motion, "warm": motion}, 0.0, shaker=shaker).values())
    fast = [np.abs(run["slip_vx"]) > 0.15 for run in runs]
    pairs = [(run["pad_A_Fx"][at], run["pad_A_Fx_base"][at]) for run, at in zip(runs, fast, strict=True)]
    friction = [np.mean(there / base_law) for there, base_law in pairs]
    assert friction == pytest.approx(levels[:2], rel=2e-3)


def test_the_mass_that_is_said_is_off_by_what_the_plan_says():
    made = build_dirty(5, plan=replace(PLAN, mass_error=0.04))
    assert made.truth.said_mass == pytest.approx(1.04 * made.truth.base.mass)
    errors = [RIGS["wrong_mass"].plan(seed, "ode").plan.mass_error for seed in RIGS["wrong_mass"].seeds[:20]]
    assert 0.012 <= min(map(abs, errors)) and max(map(abs, errors)) <= 0.06 and min(errors) < 0.0 < max(errors)


def test_small_effects_come_by_the_dozen():
    plan = RIGS["small_effects"].plan(RIGS["small_effects"].seeds[0], "ode").plan
    small = [plant for plant in plan.plants if not plant.dirt and plant.target <= 0.8 and not plant.floors]
    assert len({plant.name for plant in small}) >= 12


@pytest.mark.parametrize("name", ["bridge", STOREYS, DRAWN])
def test_both_makers_shake_a_complete_rig_alike(name):
    rng = np.random.default_rng(2)
    base = random_rig("bridge1", rng) if name == "bridge" else draw_plan_rig(name, rng).built
    motion = fit_amplitude(base, draw_record(np.random.default_rng(1), 5.0, across=True), 0.02, 2.0, 9.0)
    runs = [shake(base, {"run": motion}, 0.0, shaker=shaker)["run"] for shaker in (simulate, replayed)]
    assert list(runs[0]) == list(runs[1])
    pads = [f"pad_{pad}_{part}" for pad in pad_names(base) for part in ("N", "Fx")]
    floors = [channel for channel in runs[0] if channel.startswith("storey_")]
    slips = np.hypot(runs[0]["slip_vx"], runs[0]["slip_vy"]) > 0.02  # what a pad that sticks bears is nobody's law
    for channel in ("slip_x", "slip_y", "girder_ax", "girder_az", *pads, *floors):
        ode, replay = runs[0][channel], np.interp(runs[0]["time"], runs[1]["time"], runs[1][channel])
        assert np.std((ode - replay)[slips]) < 0.05 * np.std(ode), channel


def test_a_girder_and_its_floors_obey_newton():
    base = draw_plan_rig(STOREYS, np.random.default_rng(4)).built
    run = simulate(base, draw_record(np.random.default_rng(1), 4.0))
    friction = sum(run[f"pad_{pad}_Fx"] for pad in pad_names(base))
    load = sum(run[f"pad_{pad}_N"] for pad in pad_names(base))
    floors = [floor.mass * run[f"storey_{number}_ax"] for number, floor in enumerate(base.storeys, start=1)]
    carried = base.mass + sum(floor.mass for floor in base.storeys)
    assert base.mass * run["girder_ax"] + sum(floors) == pytest.approx(-friction, abs=1e-6 * carried)
    assert load == pytest.approx(carried * (GRAVITY + run["girder_az"]), rel=1e-9)


@pytest.mark.parametrize("kind", KINDS_OF_SLIDER)
def test_both_makers_of_single_sliders_agree_while_they_slide(kind):
    for seed in range(3):
        ode, replay = (build_slider(kind, seed, maker) for maker in MAKERS)
        assert ode.answer["effects"].keys() == replay.answer["effects"].keys()
        for run, table in ode.tables.items():
            force, other = table[:, 3], replay.tables[run][:, 3]
            speed = np.abs(np.gradient(table[:, 1], table[:, 0]))
            sliding = speed > 0.3 * speed.max()
            assert np.std((force - other)[sliding]) < 0.03 * np.std(force)


def test_friction_that_turns_round_slowly_over_a_long_stroke_is_made_by_both_makers():
    """The library's law reaches no further than 5 mm: a stroke of 0.16 m asked for 16 mm, and nothing was made."""
    seed = FAMILIES["sliders"].seeds[26]
    ode, replay = (build_slider(FAMILIES["sliders"].slider, seed, maker) for maker in MAKERS)
    assert ode.answer["effects"].keys() == replay.answer["effects"].keys() == {"presliding"}


def test_every_effect_of_the_catalogue_can_be_drawn_for_the_library():
    rng = np.random.default_rng(1)
    for base in (rated("bridge1"), draw_rig(rng), draw_rig(rng)):
        for name in possible_on(base) if base.pads else PHYSICS:
            change, _ = draw_use(name, rng, 0.5, base)
            assert name in library_model(base.changed(**change))


@pytest.mark.long
def test_laws_outside_the_catalogue_change_what_the_library_shakes():
    """One of them acts at a time; the others are there without size, so that all are compiled at once."""
    base = rated("bridge1")
    motion = fit_amplitude(base, draw_record(np.random.default_rng(1), 4.0), 0.02, 2.0, 9.0)
    for acting in UNLISTED:
        drawn = (draw_use(f"unknown:{k}", np.random.default_rng(1), float(k == acting), base)[0] for k in UNLISTED)
        uses = tuple(use for change in drawn for use in change["uses"])
        law = shake(base.changed(uses=uses), {"run": motion}, 0.0, shaker=replayed)["run"]
        assert np.std(law["pad_A_Fx"] - law["pad_A_Fx_base"]) > 0.02 * np.std(law["pad_A_Fx"]), acting


def test_what_is_made_is_kept_until_the_code_that_made_it_changes(tmp_path: Path):
    (order,) = orders(tmp_path, [FAMILIES["sliders"]], ["ode"], 1)
    assert not is_made(order)
    answer = make(order)
    assert is_made(order) and read_answers(tmp_path) == {order.name: answer}
    assert len(load_campaign(order.folder).runs) == 3 and not list(order.folder.glob("*.json"))
    assert not is_made(Order(tmp_path, "sliders", "ode", order.seed, "another hash"))
    again = make(order)
    assert {**again, "seconds": 0.0} == {**answer, "seconds": 0.0}


def test_features_of_a_campaign_take_the_place_of_earlier_ones(tmp_path: Path):
    assert read_features(tmp_path) == {}
    add_features(tmp_path, "a", {"size": 1.0})
    add_features(tmp_path, "a", {"size": 2.0})
    add_features(tmp_path, "b", {"size": 3.0})
    assert {name: line["size"] for name, line in read_features(tmp_path).items()} == {"a": 2.0, "b": 3.0}


def test_campaigns_depend_on_what_makes_them_and_on_nothing_else():
    def names(modules: tuple[str, ...], packages: tuple[str, ...]) -> set[str]:
        return {f"{path.parent.name}/{path.name}" for path in reached(modules, packages)}

    here = "slipwise_benchmarks"
    rigs, sliders = names((f"{here}.dirty",), (here,)), names((f"{here}.sliders",), (here,))
    assert {f"{here}/rig_loop.py", f"{here}/dirt.py", "unlisted/washboard.py"} <= rigs
    assert f"{here}/rig_loop.py" not in sliders and f"{here}/bearing.py" in sliders
    by_library = names((f"{here}.dirty", f"{here}.library_replay"), (here, "slipwise"))
    assert {"kernel/step.py", "effects/heating.py", "rig/build.py"} <= by_library
    assert not any(name.startswith(("diagnosis/", "view/", "instruments/")) for name in by_library)


def entry(of_limit: float) -> dict[str, float]:
    return {"of_limit": of_limit}


def test_right_is_everything_that_matters_and_nothing_that_does_not():
    answer = {
        "effects": {"heating": entry(3.0), "run_in": entry(0.8), "guide_drag": entry(0.2), "unknown": entry(0.0)},
        "missing": ["heating"],
        "alternatives": {},
        "first": [],
    }
    assert right(answer, {"verdict": "named", "effects": ["heating"]})
    assert right(answer, {"verdict": "named", "effects": ["run_in"], "minor": ["heating"]})
    assert missed(answer, {"verdict": "complete", "effects": []}) == {"heating"}
    assert accused(answer, {"verdict": "named", "effects": ["heating", "guide_drag"]}) == {"guide_drag"}
    assert not right(answer, {"verdict": "named", "effects": ["heating"], "leftover": "unknown"})
    assert not right(answer, {"verdict": "failed: ValueError", "effects": ["heating"]})


def test_a_law_outside_the_catalogue_may_stand_beside_names():
    answer = {
        "effects": {"heating": entry(3.0), "unknown": entry(5.0)},
        "missing": ["unknown", "heating"],
        "alternatives": {},
        "first": [],
    }
    assert right(answer, {"verdict": "named", "effects": ["heating"], "leftover": "unknown"})
    assert not right(answer, {"verdict": "named", "effects": ["heating"]})
    assert not right(answer, {"verdict": "unknown", "effects": []})


def test_a_spring_without_friction_may_be_a_curved_face_or_unknown():
    made = build_family(FAMILIES["springs_and_walls"], "ode", FAMILIES["springs_and_walls"].seeds[0])
    assert made.answer["missing"] == ["restrainer"]
    for names in (["restrainer"], ["slide_curvature"]):
        assert right(made.answer, {"verdict": "named", "effects": names})
    assert right(made.answer, {"verdict": "unknown", "effects": []})
    assert not right(made.answer, {"verdict": "named", "effects": ["heating"]})
