"""Balances of a girder with storeys: what they push is known where all were measured, else some are left out."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from measured import fit_base
from recover.own_replay import noise_of
from slipwise.campaign import Campaign, Logger, Run, load_campaign
from slipwise.comparison.component_level import compute_component_errors, pool_errors
from slipwise.comparison.system_level import list_pad_springs
from slipwise.errors import InputError
from slipwise.estimation.objective import make_objective
from slipwise.model import base_model, use
from slipwise.record import Record, write_record
from slipwise.relations.rigid_balances import list_rigid_balances
from slipwise.relations.run_data import fit_runs
from slipwise.relations.sample_masks import without_uplift
from slipwise.relations.storeys import predict_push
from slipwise.rig import load_specimen
from slipwise.rig.frame import floor_sway, frame_moment, frame_push
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes, rigid_modes
from slipwise.simulation.replay import replay


@pytest.fixture(scope="module")
def record() -> Record:
    return replay("building", "quake:seed=1,peak=0.6g,f=3Hz,strong=1.5s,vertical=0.3g").record


def test_the_push_of_the_storeys_is_what_the_base_lacks(record: Record) -> None:
    building = load_specimen("building")
    forces = record.stacked("pad_{}_Fx", building.pads).sum(axis=1)
    left = building.mass * record["girder_ax"] + forces - frame_push(record, building)
    assert np.abs(left).max() < 2e-3 * np.abs(forces).max()


def test_their_moment_and_the_weight_that_moves_load_the_pads(record: Record) -> None:
    """Slower than the base pitches on its pads, the loads balance all moments about the sliding plane."""
    building = load_specimen("building")
    loads = record.stacked("pad_{}_N", building.pads)
    moment = frame_moment(record, building.storeys, building.gravity + record["girder_az"])
    moment += record["slip_x"] * loads.sum(axis=1)
    moment -= building.mass * building.centre_height * record["girder_ax"]
    pitch = loads @ np.array(building.pad_places)[:, 0]
    slow = np.ones(25) / 25.0
    smooth = [np.convolve(values, slow, mode="valid") for values in (pitch, moment)]
    assert np.std(smooth[0] - smooth[1]) < 0.02 * np.std(smooth[0])


def test_what_a_rigid_base_asks_of_the_pads_holds_its_storeys(record: Record) -> None:
    """Heave to the numbers' last digits, pitch but for what the base itself turns."""
    building = load_specimen("building")
    measured = load_modes(record.stacked("pad_{}_N", building.pads), basis_of(building))
    rigid = rigid_modes(
        record, building.mass, building.gravity, building.centre_height, building.half_spacing, building.pads_on,
        building.storeys,
    )  # fmt: skip
    assert rigid.heave == pytest.approx(measured.heave, rel=2e-3)
    assert np.std(rigid.pitch - measured.pitch) < 0.05 * np.std(measured.pitch)
    without = Record(record.time, {n: v for n, v in record.channels.items() if n != "storey_2_ax"})
    with pytest.raises(InputError, match="storey_2_ax"):
        rigid_modes(without, 6e3, 9.81, 0.5, (1.0, 1.0), storeys=building.storeys)


def test_floors_stand_as_far_beside_the_base_as_in_the_replay(record: Record) -> None:
    """Their drift is their acceleration against the base, integrated: seen at the frame's own 2.7 and 7 Hz."""
    building = load_specimen("building")
    top = floor_sway(record, building.storeys)[1]
    rate = 1.0 / record.dt
    against = record["storey_2_ax"] - record["girder_ax"]
    frequency = np.fft.rfftfreq(len(top), record.dt)
    seen = (frequency > 1.5) & (frequency < min(15.0, 0.5 * rate))
    omega = 2.0 * np.pi * np.where(seen, frequency, 1.0)
    integrated = np.fft.irfft(np.where(seen, -np.fft.rfft(against) / omega**2, 0.0), len(top))
    band = np.fft.irfft(np.where(seen, np.fft.rfft(top), 0.0), len(top))
    assert np.std(band - integrated) < 0.15 * np.std(band)


@pytest.mark.parametrize("start", [0.0, 2.0])
def test_the_frames_push_follows_from_what_its_base_does(record: Record, start: float) -> None:
    """From rest, and where the record begins while the frame swings; friction jumps between two samples cost 2 %."""
    building = load_specimen("building")
    part = record.between(start, 99.0)
    channels = {n: v for n, v in part.channels.items() if not n.endswith("_P")}
    run = Run("q", "fit", Record(part.time, channels), 0.0, None, "q", "q")
    campaign = Campaign("b", "building", building, Logger(None, known=True), (run,), Path())
    (fitted,) = fit_runs(campaign)
    assert bool(fitted.states.at_rest[0]) is (start == 0.0)
    left = frame_push(fitted.record, building) - predict_push(fitted, building)
    assert np.std(left) < 0.03 * np.std(frame_push(fitted.record, building))
    softer = base_model(building).adding(use("superstructure", stiffness=0.9)).built_specimen()
    left = frame_push(fitted.record, building) - predict_push(fitted, softer)
    assert np.std(left) > 0.1 * np.std(frame_push(fitted.record, building))


def test_a_frame_is_not_judged_once_a_pad_has_lifted() -> None:
    lifted = np.zeros(100, dtype=bool)
    lifted[40:45] = True
    kept = without_uplift({"storeys": np.ones(100, dtype=bool), "heave": ~lifted}, lifted, lifted, 2e-3)
    assert kept["storeys"].sum() == 40 and kept["heave"].sum() == 95


def test_a_campaign_of_a_frame_that_is_softer_than_stated_is_fitted_by_its_effect(record: Record) -> None:
    rng = np.random.default_rng(5)
    stated = base_model("building").adding(use("superstructure", stiffness=1.25, damping=-0.005)).built_specimen()
    kept = {n: v for n, v in record.channels.items() if noise_of(n) is not None}
    noisy = {n: v + noise_of(n) * rng.standard_normal(len(v)) for n, v in kept.items()}
    run = Run("q", "fit", Record(record.time, noisy), 0.0, None, "q", "q")
    campaign = Campaign("b", "building", stated, Logger(None, known=True), (run,), Path())
    base = fit_base(campaign)
    assert pool_errors(compute_component_errors(base), "storeys", held_out=False) > 5.0
    better = fit_base(campaign, base.model.adding(use("superstructure", stiffness=1.0, damping=0.0)))
    assert pool_errors(compute_component_errors(better), "storeys", held_out=False) < 1.2
    found = better.solution.values
    assert found["superstructure.stiffness"] == pytest.approx(0.8, rel=0.01)
    assert found["superstructure.damping"] == pytest.approx(0.005, abs=0.0015)


def test_the_pads_springs_are_found_under_storeys_too(record: Record) -> None:
    """Storeys ride up and down with the base: their mass is on the pads' springs."""
    rng = np.random.default_rng(3)
    kept = {
        n: v for n, v in record.channels.items() if n.startswith(("table_a", "girder_a", "storey_", "pad_", "slip"))
    }
    noisy = {n: v + 0.005 * np.std(v) * rng.standard_normal(len(v)) for n, v in kept.items() if not n.endswith("_P")}
    specimen = load_specimen("building")
    run = Run("q", "fit", Record(record.time, noisy), 0.0, None, "q", "q")
    campaign = Campaign("b", "building", specimen, Logger(None, known=True), (run,), Path())
    base = fit_base(campaign)
    found = list_pad_springs(base, base.model)
    assert found is not None and found[0] == pytest.approx(specimen.pad_stiffness, rel=0.03)


@pytest.mark.parametrize("lost", ["", "storey_2_ax"])
def test_a_storey_that_was_not_measured_leaves_out_what_it_pushes(record: Record, tmp_path: Path, lost: str) -> None:
    measured = ("table_a", "girder_a", "storey_", "pad_", "slip_x")
    kept = {n: v for n, v in record.channels.items() if n != lost and n.startswith(measured) and not n.endswith("_P")}
    write_record(replace(record, channels=kept), tmp_path / "run.parquet")
    (tmp_path / "campaign.toml").write_text(
        'name = "b"\nrig = "building"\n[[run]]\nfile = "run.parquet"\nrole = "fit"\n'
    )
    campaign = load_campaign(tmp_path)
    objective = make_objective(fit_runs(campaign), campaign.specimen, ())
    assert {"girder", "pitch"}.isdisjoint(objective.relations) is bool(lost)
    assert {"heave", "warp", "motion"} <= set(objective.relations)
    audited, cannot = list_rigid_balances(campaign.runs[0].record, campaign.specimen)
    assert ("girder_x" in [relation.name for relation in audited]) is not bool(lost)
    assert any("storey_2_ax" in words for words in cannot) is bool(lost)
