"""Campaigns without gauges of force: what all bearings carry follows from the inertia of girder and storeys."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import Campaign, Logger, Run, measured_states
from slipwise.comparison.isolation_layer import describe_isolation_layer
from slipwise.errors import InputError
from slipwise.model import Model, base_model, use
from slipwise.record import Record
from slipwise.relations.base_shear import compute_base_shear
from slipwise.relations.run_data import fit_runs
from slipwise.relations.setting import Measurements
from slipwise.relations.untold_forces import list_untold_forces
from slipwise.rig import Specimen, load_specimen
from slipwise.rig.places import Buffer
from slipwise.selection.candidates import NOTHING_SLIDES, list_candidates
from slipwise.session.evaluation import evaluator
from slipwise.simulation.replay import replay
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

RNG = np.random.default_rng(5)
NOISE = {"slip_x": 2e-5}


def without(campaign: Campaign, *endings: str) -> Campaign:
    """Drop the channels of pads that end so."""
    records = {
        run.name: Record(
            run.record.time,
            {n: v for n, v in run.record.channels.items() if not (n.startswith("pad_") and n.endswith(endings))},
        )
        for run in campaign.runs
    }
    return campaign.with_records(records, "channels left out")


@pytest.fixture(scope="module")
def gauged() -> Campaign:
    made = as_campaign(build_campaign(34, effects=(), rig="bridge1"))
    return replace(made, runs=(made.runs[0], made.runs[-1]))


@pytest.fixture(scope="module")
def bare(gauged: Campaign) -> Campaign:
    return without(gauged, "_N", "_Fx", "_P")


def test_weight_and_overturning_give_the_loads_that_no_cell_weighed(gauged: Campaign, bare: Campaign) -> None:
    run = gauged.runs[0]
    weighed = measured_states(run, gauged)
    made = measured_states(bare.runs[0], bare)
    assert made.pads == weighed.pads and made.load_errors is not None and weighed.load_errors is None
    swing = np.std(weighed.load, axis=0)
    assert np.all(np.std(made.load - weighed.load, axis=0) < 0.25 * swing)
    assert np.mean(made.load, axis=0) == pytest.approx(np.mean(weighed.load, axis=0), rel=0.05)


def test_inertia_gives_the_force_of_pads_and_buffers_together(gauged: Campaign) -> None:
    run = fit_runs(gauged)[0]
    given = run.force.sum(axis=1) + sum(gauged.specimen.buffer_stiffness) * run.slip
    assert np.std(compute_base_shear(run) - given) < 0.1 * np.std(given)


def test_a_law_of_friction_is_fitted_to_what_all_pads_carry_together(gauged: Campaign, bare: Campaign) -> None:
    whole, alone = fit_base(gauged), fit_base(bare)
    assert alone.objective.relations == ("girder", "motion")
    keys = {free.key for free in alone.free}
    assert keys.isdisjoint({"rig.mass", "rig.centre_height", "rig.late_force", "rig.pitch_frequency"})
    stiffness = "rig.buffer_stiffness"
    assert alone.solution.values[stiffness] == pytest.approx(whole.solution.values[stiffness], rel=0.03)
    level = alone.solution.residuals.level("girder", alone.objective.held_out)
    assert level < 2.5
    untold = dict(list_untold_forces(alone.objective.measurements))
    assert "sum" not in untold and "all of them carry together" in untold["friction of single pads"]
    assert "mass" in untold["forces, stiffness and energy"]
    terms, cannot = list_candidates(alone)
    named = {term.effect.name for term in terms}
    assert {"heating", "buffer_hysteresis", "presliding"} <= named
    assert {"pad_spread", "uneven_seating", "mass_eccentricity"} <= set(cannot)


def test_where_loads_were_kept_their_balances_are_judged_too(gauged: Campaign) -> None:
    loaded = Measurements(tuple(fit_runs(without(gauged, "_Fx"))), gauged.specimen)
    assert not loaded.forces_measured and loaded.loads_measured
    assert {"girder", "heave", "pitch", "warp"} <= set(loaded.relations) and "pads" not in loaded.relations
    assert not list_untold_forces(Measurements(tuple(fit_runs(gauged)), gauged.specimen))


def test_without_an_acceleration_of_all_that_is_carried_the_message_names_it(bare: Campaign) -> None:
    run = bare.runs[0]
    lame = Record(run.record.time, {n: v for n, v in run.record.channels.items() if n != "girder_ax"})
    with pytest.raises(InputError, match=r"no pad has a load or a pressure, and girder_ax is missing"):
        measured_states(replace(run, record=lame), bare)
    framed = replace(bare, specimen=replace(bare.specimen, storeys=load_specimen("building").storeys))
    with pytest.raises(InputError, match=r"storey_1_ax, storey_2_ax is missing.*leave storeys out"):
        measured_states(run, framed)


def test_a_dead_accelerometer_of_what_is_carried_is_named(bare: Campaign) -> None:
    run = bare.runs[0]
    every = np.ones(len(run.record), dtype=bool)
    with pytest.raises(InputError, match="girder_ax shows nothing.*leave this run out"):
        fit_runs(bare, {run.name: {"girder_ax": every}})


@pytest.fixture(scope="module")
def isolated() -> Specimen:
    """A frame of two storeys on four rubber bearings."""
    building = load_specimen("building")
    each = building.carried_mass * (2.0 * np.pi / 2.0) ** 2 / 4.0
    rubber = tuple(Buffer(str(i), p.x, p.y, 0.0, each, each) for i, p in enumerate(building.places, 1))
    return building.changed(friction="none", buffers=rubber)


def measured(specimen: Specimen, model: Model, motions: tuple[tuple[str, str], ...]) -> Campaign:
    """Replay motions and keep accelerations and the displacement of the base, with noise."""
    runs = []
    for number, (motion, role) in enumerate(motions):
        record = replay(model, motion, output_dt=5e-3).record
        kept = ("table_ax", "girder_ax", "storey_1_ax", "storey_2_ax", "slip_x")
        channels = {n: record[n] + NOISE.get(n, 0.003) * RNG.standard_normal(len(record)) for n in kept}
        runs.append(Run(f"r{number}", role, Record(record.time, channels), 1800.0, None, f"r{number}", f"r{number}"))
    return Campaign("rubber", "building", specimen, Logger(None, known=True), tuple(runs), Path())


MOTIONS = (
    ("quake:seed=1,peak=0.08g,f=1Hz,strong=4s", "fit"),
    ("quake:seed=4,peak=0.08g,f=0.8Hz,strong=5s", "holdout"),
)


@pytest.fixture(scope="module")
def lead_rubber(isolated: Specimen) -> Campaign:
    yielding = isolated.weight * 0.02 / len(isolated.buffers)
    hidden = base_model(isolated).adding(use("buffer_hysteresis", strength=yielding, length=4e-3))
    return measured(isolated, hidden, MOTIONS)


def test_the_hysteresis_that_a_linear_layer_lacks_is_found_and_predicts_a_motion_that_no_fit_has_seen(
    isolated: Specimen, lead_rubber: Campaign
) -> None:
    linear = fit_base(lead_rubber)
    assert {free.key for free in linear.free} <= {
        "buffer_damping.damping", "rig.buffer_stiffness", "rig.late_girder", "rig.late_slip",
    }  # fmt: skip
    better = fit_base(lead_rubber, linear.model.adding(use("buffer_hysteresis")))
    before, after = (
        next(one for one in describe_isolation_layer(fit) if one.role == "holdout") for fit in (linear, better)
    )
    assert before.model_left > 0.1 and after.model_left < 0.4 * before.model_left
    assert better.solution.values["rig.buffer_stiffness"] == pytest.approx(sum(isolated.buffer_stiffness), rel=0.05)


def test_a_damper_that_is_to_stay_linear_stays_so_in_a_session(lead_rubber: Campaign) -> None:
    """Else an effect cannot be added: the session has no value of a number that no fit has changed."""
    ready, opened = evaluator(lead_rubber, None)
    assert ready.model_of(opened).uses[0].held == ("exponent", "relaxation")
    assert {free.key for free in ready.free(opened)} == opened.values.keys()
    assert set(ready.with_slopes(opened).solution.values) == opened.values.keys()


def test_the_layer_is_described_by_period_damping_and_energy(isolated: Specimen) -> None:
    """Of a linear layer: its own numbers; what friction there could be is no candidate."""
    model = base_model(isolated)
    fit = fit_base(measured(isolated, model, MOTIONS[:1]))
    (layer,) = describe_isolation_layer(fit)
    assert layer.period == pytest.approx(2.0, rel=0.02)
    critical = 2.0 * np.sqrt(sum(isolated.buffer_stiffness) * isolated.carried_mass)
    dashpots = model.uses[0].values["damping"] * len(isolated.buffers)
    assert layer.damping == pytest.approx(dashpots / critical, rel=0.1)
    run = fit.objective.run(0)
    assert layer.energy == pytest.approx(float(np.sum(dashpots * run.velocity**2) * run.dt), rel=0.1)
    assert layer.linear_left < 0.1 and layer.model_left < 0.1
    terms, cannot = list_candidates(fit)
    assert cannot["presliding"] == cannot["heating"] == NOTHING_SLIDES
    assert not {"presliding", "heating", "run_in"} & {term.effect.name for term in terms}
    assert [name for name, _ in list_untold_forces(fit.objective.measurements)][0] == "force of single buffers"


def test_what_all_bearings_carry_across_is_judged_where_the_girder_moves_that_way() -> None:
    """Of pads that slide by the true law it is noise; of pads that rub half as much it is not."""
    model = base_model("bridge1")
    motion = "quake:seed=2,peak=0.6g,f=3Hz,strong=1.5s,across=0.5g"
    record = replay(model, motion, output_dt=2e-3).record
    kept = ("table_ax", "table_ay", "girder_ax", "girder_ay", "slip_x", "slip_y")
    noise = {"slip_x": 2e-5, "slip_y": 2e-5}
    channels = {n: record[n] + noise.get(n, 0.02) * RNG.standard_normal(len(record)) for n in kept}
    run = Run("q", "fit", Record(record.time, channels), 0.0, None, "q", "q")
    logger = Logger(None, known=True)
    campaign = Campaign("across", "bridge1", model.specimen, logger, (run,), Path())
    fit = fit_base(campaign)
    assert fit.objective.relations == ("girder", "motion", "girder_y")
    assert fit.solution.residuals.level("girder_y", [0]) < 1.2
    weak = {**fit.solution.values, "shear_rate.strength": 0.5 * fit.solution.values["shear_rate.strength"]}
    assert fit.objective.residuals(weak).level("girder_y", [0]) > 3.0
