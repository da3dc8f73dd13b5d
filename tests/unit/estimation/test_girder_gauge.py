"""A gauge of the girder whose filter has no inverse, and one whose noise comes down as load."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.effects import catalogue
from slipwise.evidence.residual_summary import summarise_residuals
from slipwise.model import base_model
from slipwise.relations.noise import compute_heave_level
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import fit_runs
from slipwise.selection.hypothesis import polish, refit, refit_for_report
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.campaign import Campaign as Made
from slipwise_benchmarks.campaign import with_faults
from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.in_memory import as_campaign

CUTOFF = 12.0


@pytest.fixture(scope="module")
def made() -> Made:
    return build_campaign(61, effects=(), rig="bridge1")


@pytest.mark.slow
def test_a_strong_filter_of_the_girder_is_put_on_what_the_balance_predicts(made: Made) -> None:
    """12 Hz takes reversals out of the accelerometer for good: sharpening it left 2.7 floors in the balance."""
    fault = Fault("channel_filter", ("girder_ax",), CUTOFF, form="second order")
    base = fit_base(as_campaign(with_faults(made, [fault], 5)))
    term, lag = Term(catalogue()["channel_filter"], ("girder_ax",), "girder_ax"), np.sqrt(2.0) / (2.0 * np.pi * CUTOFF)
    found = refit_for_report(polish(refit(base, [term], {term.label: {"lag": lag, "order": 2.0}})))
    before, after = (
        np.sqrt(of.held_out_level("girder"))
        for of in (summarise_residuals(base.objective, base.solution), found.summary)
    )
    assert before > 5.0 and after < 1.1
    assert found.solution.values[f"{term.label}.lag"] == pytest.approx(lag, rel=0.02)


def test_less_mass_is_not_bought_with_the_noise_of_the_accelerometer(made: Made) -> None:
    """The noise that heave is judged by is what the fitted mass makes of the accelerometer's."""
    model, run = base_model(made.truth.rig), fit_runs(as_campaign(made))[0]
    loads = np.linalg.norm(run.gauge_noise[1])
    for share in (0.5, 1.0, 2.0):
        specimen = replace(model.specimen, mass=share * model.specimen.mass)
        expected = np.hypot(loads, specimen.mass * run.noise["girder_az"])
        assert compute_heave_level(replace(model, specimen=specimen), run, {}) == pytest.approx(expected)
        # cells that read 4 % less of a girder of 4 % more weight: the same balance, divided by what it was scaled by
        heavier = replace(model, specimen=replace(specimen, mass=1.04 * specimen.mass))
        assert compute_heave_level(heavier, run, {"loads": 1.04, "heave": 1.04}) == pytest.approx(expected)
