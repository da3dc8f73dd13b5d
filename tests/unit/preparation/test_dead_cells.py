"""A rigid girder tells what a dead load cell would have read, whatever the number of pads."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.preparation.dead_cells import estimate_dead_loads
from slipwise.preparation.sample_fault import SampleFault
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.record import Record
from slipwise.relations.run_data import fit_runs
from slipwise.rig import load_specimen
from slipwise.rig.load_basis import basis_of

TIME = np.arange(2000) * 0.005


def campaign(rig: str, dead: dict[str, tuple[str, ...]], warp: float = 0.0) -> tuple[Campaign, list[np.ndarray]]:
    """Make two runs of a rocking girder with some cells dead, and give what the cells would have read, (n, p)."""
    specimen = load_specimen(rig)
    basis = basis_of(specimen)
    runs, every = [], []
    for name, tone in (("one", 1.3), ("two", 2.1)):
        motion = np.stack([1.0 + 0.05 * np.sin(tone * TIME), 0.2 * np.sin(9.0 * TIME), 0.1 * np.cos(7.0 * TIME)])
        patterns = basis.rigid * np.array(specimen.springs) / sum(specimen.springs)
        loads = specimen.weight * motion.T @ patterns + (warp * basis.warp[0] if warp else 0.0)
        every.append(loads)
        channels = {f"pad_{pad}_N": loads[:, i] for i, pad in enumerate(specimen.pads)}
        channels |= {cell: np.zeros(len(TIME)) for cell, in_runs in dead.items() if name in in_runs}
        runs.append(Run(name, "fit", Record(TIME, channels), None, None, f"{name}.csv", ""))
    return Campaign("made", rig, specimen, Logger(known=True), tuple(runs), Path()), every


def faults_of(dead: dict[str, tuple[str, ...]]) -> list[SampleFault]:
    bad = np.ones(len(TIME), dtype=bool)
    return [SampleFault("dead", (name,), -1.0, dict.fromkeys(runs, bad), runs) for name, runs in dead.items()]


def masks_of(dead: dict[str, tuple[str, ...]]) -> dict:
    bad = np.ones(len(TIME), dtype=bool)
    return {"dead": {run: {name: bad for name, runs in dead.items() if run in runs} for run in ("one", "two")}}


@pytest.mark.parametrize(("rig", "cells"), [("bridge1", ("pad_D_N",)), ("six_pads", ("pad_B_N", "pad_F_N"))])
def test_the_loads_of_a_rigid_girder_give_those_of_dead_cells(rig, cells):
    dead = dict.fromkeys(cells, ("one", "two"))
    made, loads = campaign(rig, dead)
    alive, found = estimate_dead_loads(made, faults_of(dead), masks_of(dead))
    assert [one.channel for one in found] == list(cells) and not any(one.warp_seen for one in found)
    for run, true in zip(alive.runs, loads, strict=True):
        for name in cells:
            place = made.specimen.pads.index(name.split("_")[1])
            np.testing.assert_allclose(run.record[name], true[:, place], rtol=1e-9)
            assert run.estimated[name] == pytest.approx(0.05 * made.specimen.weight / len(made.specimen.pads))


def test_a_warp_that_another_run_shows_is_taken_over():
    dead = {"pad_D_N": ("two",)}
    made, loads = campaign("bridge1", dead, warp=900.0)
    alive, (found,) = estimate_dead_loads(made, faults_of(dead), masks_of(dead))
    np.testing.assert_allclose(alive.run("two").record["pad_D_N"], loads[1][:, 3], rtol=1e-9)
    assert found.warp_seen and found.runs == ("two",) and alive.run("one").record is made.run("one").record
    assert "the warp that it shows in other runs" in found.words


@pytest.mark.parametrize(("rig", "cells"), [("three_pads", ("pad_B_N",)), ("bridge1", ("pad_B_N", "pad_D_N"))])
def test_too_few_living_cells_give_nothing(rig, cells):
    dead = dict.fromkeys(cells, ("one", "two"))
    made, _ = campaign(rig, dead)
    alive, found = estimate_dead_loads(made, faults_of(dead), masks_of(dead))
    assert found == () and alive is made


def test_no_balance_of_loads_is_judged_by_a_load_that_was_made_of_the_others_and_its_noise_is_wider():
    dead = {"pad_D_N": ("two",)}
    made, _ = campaign("bridge1", dead, warp=900.0)
    slip = 0.02 * np.sin(4.0 * TIME)
    friction = {f"pad_{pad}_Fx": 2000.0 * np.sign(np.cos(4.0 * TIME)) for pad in "ABCD"}
    runs = [Run(r.name, r.role, r.record.replaced(slip_x=slip, **friction), None, None, r.file, "") for r in made.runs]
    made = Campaign("made", "bridge1", made.specimen, Logger(known=True), tuple(runs), Path())
    alive, (found,) = estimate_dead_loads(made, faults_of(dead), masks_of(dead))
    one, two = fit_runs(alive)
    for relation in ("heave", "roll", "warp"):
        assert one.judged[relation].any() and not two.judged[relation].any()
    assert two.judged["pads"][:, 3].any()
    assert two.noise["pad_D_N"] >= one.noise["pad_D_N"] and two.noise["pad_D_N"] >= found.error


def test_a_noisy_cell_is_dead_in_a_run_too_in_which_its_like_hardly_move():
    """Taken for alive there it showed a load of nothing, and the pad seemed lifted in every other run."""
    made, _ = campaign("bridge1", {})
    rng = np.random.default_rng(5)
    records = {}
    for run in made.runs:
        share = 0.01 if run.name == "two" else 1.0
        loads = {f"pad_{p}_N": run.record[f"pad_{p}_N"] for p in "ABC"}
        quiet = {name: np.mean(load) + share * (load - np.mean(load)) for name, load in loads.items()}
        swing = min(float(np.std(load)) for load in loads.values())
        records[run.name] = run.record.replaced(**quiet, pad_D_N=0.02 * swing * rng.standard_normal(len(run.record)))
    found = [f for f in find_sample_faults(made.with_records(records, "dead")) if f.kind == "dead"]
    assert [(f.channels, f.runs) for f in found] == [(("pad_D_N",), ("one", "two"))]
