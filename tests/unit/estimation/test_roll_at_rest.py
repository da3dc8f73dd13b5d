"""Roll of the loads is judged where all that rolls the girder was measured: before the motion, if it moves across."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import fit_base
from slipwise.model import base_model
from slipwise.record import Record
from slipwise.relations.parameters import SEAT_STIFFNESS, Term, list_base_numbers
from slipwise.relations.sample_masks import is_roll_known
from slipwise.rig import Specimen, load_specimen
from slipwise.simulation.replay import replay

NOISE = {"ax": 0.02, "ay": 0.02, "az": 0.02, "slip_x": 2e-5, "slip_y": 2e-5, "N": 60.0, "Fx": 15.0, "Fy": 15.0}


def measured(specimen: Specimen) -> Record:
    model = base_model(specimen)
    record = replay(model, "quake:seed=2,peak=0.6g,f=3Hz,strong=1.5s,vertical=0.2g,across=0.3g", output_dt=2e-3).record
    rng = np.random.default_rng(7)
    channels = {}
    for name, values in record.channels.items():
        noise = NOISE.get(name if name.startswith("slip") else name.rpartition("_")[2])
        if noise and name.startswith(("table_a", "girder_a", "pad_", "slip_")):
            channels[name] = values + rng.normal(0.0, noise, len(values))
    return Record(record.time, channels)


def campaign(record: Record, stated: Specimen) -> Campaign:
    run = Run("q", "fit", record, 0.0, None, "q", "q")
    return Campaign("c", stated.name, stated, Logger(None, known=True), (run,), Path())


def test_motion_across_leaves_roll_to_the_rest_before_it() -> None:
    stated = load_specimen("bridge1")
    record = measured(stated)
    known = is_roll_known(record, True, stated)
    assert 60 < known.sum() < len(known) and known[0] and not known[-1]
    assert np.abs(record["table_ax"][known]).max() < 0.2
    assert is_roll_known(record, False, stated).all()


def test_a_centre_of_gravity_off_across_shows_before_the_motion_and_its_effect_takes_it_away() -> None:
    stated = load_specimen("bridge1")
    base = fit_base(campaign(measured(replace(stated, centre_y=0.05)), stated))
    assert "roll" in base.objective.relations and "across" in base.objective.relations
    (left,) = base.solution.residuals.of("roll")
    assert abs(left[left != 0.0].mean()) > 10.0
    term = Term(catalogue()["mass_eccentricity"])
    off = {"mass_eccentricity.along": 0.0, "mass_eccentricity.across": 0.05}
    (left,) = base.objective.adding(term).residuals({**base.solution.values, **off}).of("roll")
    assert abs(left[left != 0.0].mean()) < 0.5


def test_pads_of_stated_unlike_heights_show_their_stiffness_at_rest() -> None:
    stated = load_specimen("bridge1").changed(seating=(2e-5, -2e-5, -1e-5, 3e-5))
    stiffer = stated.changed(pad_stiffness=1.08 * stated.pad_stiffness)
    base = fit_base(campaign(measured(stiffer), stated))
    assert base.solution.values[SEAT_STIFFNESS] == pytest.approx(1.08, abs=0.01)
    level = [f.key for f in list_base_numbers(base_model("bridge1"), balances=True)]
    assert SEAT_STIFFNESS not in level
