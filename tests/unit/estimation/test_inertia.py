"""How hard the girder is to turn is found where it turns, and noise that drives a rocking table is counted."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import Logger
from slipwise.effects import catalogue
from slipwise.evidence.residual_summary import summarise_residuals
from slipwise.model import base_model, use
from slipwise.relations.noise import compute_driven_noise_in_pitch
from slipwise.relations.parameters import PITCH_INERTIA, YAW_INERTIA, Term
from slipwise.relations.run_data import fit_runs
from slipwise.selection.hypothesis import polish, refit, refit_for_report
from slipwise.signals.filters import LowPass
from slipwise.signals.oscillator import oscillator
from slipwise.signals.pitch import pass_through_pitch
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.slow
def test_yaw_made_from_forces_tells_the_inertia_about_the_vertical() -> None:
    made = build_campaign(36154, effects=("buffer_mismatch",), size="medium", rig="bridge1")
    chain = made.truth.logger
    stated = Logger(LowPass(chain.lowpass, chain.order, chain.phase), known=True)
    base = fit_base(replace(as_campaign(made), logger=stated))
    term = Term(catalogue()["buffer_mismatch"])
    found = refit_for_report(polish(refit(base, [term], {term.label: term.effect.typical()})))
    assert found.solution.values[YAW_INERTIA] == pytest.approx(made.truth.base.inertia_yaw, rel=0.03)
    assert found.summary.held_out_level("pads") < 1.5**2


@pytest.mark.slow
def test_a_table_that_rocks_tells_the_inertia_of_pitch() -> None:
    made = build_campaign(36206, effects=("table_pitch",), size="large", rig="bridge1")
    hidden = made.truth.as_dict()["details"]["table_pitch"]
    base = fit_base(as_campaign(made))
    term = Term(catalogue()["table_pitch"])
    kind = "compliance" if hidden["pitch_form"] == 1 else "specimen"
    start = {**term.effect.neutral(), **{"damping": 0.3, "gravity": 1.0, "frequency": hidden["pitch_frequency"]}}
    start[kind] = hidden["pitch_per_acceleration"]
    found = refit_for_report(polish(polish(refit(base, [term], {term.label: start}))))
    assert found.solution.values[PITCH_INERTIA] == pytest.approx(made.truth.base.inertia_pitch, rel=0.05)
    assert found.summary.held_out_level("pitch") < 1.5**2


def test_the_noise_that_drives_a_rocking_table_is_counted() -> None:
    run = fit_runs(as_campaign(build_campaign(36206, effects=(), rig="bridge1")))[0]
    rocking = use("table_pitch", compliance=3e-4, frequency=13.0, damping=0.35, gravity=0.0)
    model = base_model("bridge1").adding(rocking)
    values = {"rig.pitch_frequency": 70.0, "rig.pitch_damping": 0.1}
    power = compute_driven_noise_in_pitch(model, [run], values)[0]
    shaken = np.random.default_rng(3).normal(0.0, run.noise["table_ax"], len(run.time))
    turning = oscillator((2.0 * np.pi * 13.0) ** 2 * 3e-4 * shaken, run.dt, 13.0, 0.35, 2)
    load = pass_through_pitch(-model.specimen.inertia[1] * turning / model.specimen.half_spacing[0], run.dt, 70.0, 0.1)
    assert np.mean(power) == pytest.approx(np.var(load), rel=0.1)


@pytest.mark.slow
def test_pitch_is_weighed_with_the_resonance_that_is_there_however_far_from_the_rated_one() -> None:
    """54 Hz where 80 Hz is rated: weighed where the fit had passed by, its noise counted half."""
    made = build_campaign(59174, effects=())
    chain = made.truth.logger
    stated = Logger(LowPass(chain.lowpass, chain.order, chain.phase), known=True)
    base = fit_base(replace(as_campaign(made), logger=stated))
    assert made.truth.base.inertia_pitch == 1.6e4
    assert summarise_residuals(base.objective, base.solution).held_out_level("pitch") < 1.1
