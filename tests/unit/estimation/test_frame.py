"""Balances of a girder with storeys: what they push is known where all were measured, else some are left out."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.estimation.problem import Problem
from slipwise.estimation.run_data import fit_runs
from slipwise.instruments.balances import relations
from slipwise.record import Record, write_record
from slipwise.rig import load_specimen
from slipwise.rig.frame import frame_moment, frame_push
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
    moment = frame_moment(record, building, record["girder_az"]) + record["slip_x"] * loads.sum(axis=1)
    moment -= building.mass * building.centre_height * record["girder_ax"]
    pitch = loads @ np.array(building.pad_places)[:, 0]
    slow = np.ones(25) / 25.0
    smooth = [np.convolve(values, slow, mode="valid") for values in (pitch, moment)]
    assert np.std(smooth[0] - smooth[1]) < 0.02 * np.std(smooth[0])


@pytest.mark.parametrize("lost", ["", "storey_2_ax"])
def test_a_storey_that_was_not_measured_leaves_out_what_it_pushes(record: Record, tmp_path: Path, lost: str) -> None:
    measured = ("table_a", "girder_a", "storey_", "pad_", "slip_x")
    kept = {n: v for n, v in record.channels.items() if n != lost and n.startswith(measured) and not n.endswith("_P")}
    write_record(replace(record, channels=kept), tmp_path / "run.parquet")
    (tmp_path / "campaign.toml").write_text(
        'name = "b"\nrig = "building"\n[[run]]\nfile = "run.parquet"\nrole = "fit"\n'
    )
    campaign = load_campaign(tmp_path)
    problem = Problem(fit_runs(campaign), campaign.specimen, ())
    assert {"girder", "pitch"}.isdisjoint(problem.relations) is bool(lost)
    assert {"heave", "warp", "motion"} <= set(problem.relations)
    audited, cannot = relations(campaign.runs[0].record, campaign.specimen)
    assert ("girder_x" in [relation.name for relation in audited]) is not bool(lost)
    assert any("storey_2_ax" in words for words in cannot) is bool(lost)
