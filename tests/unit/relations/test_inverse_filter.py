"""Noise of a channel whose filter is taken out again: how much it grows, and residuals that are white all the same."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import welch

from slipwise.effects import catalogue
from slipwise.relations.girder import compute_motion_residual
from slipwise.relations.inverse_filter import whiten_again
from slipwise.relations.measurement import compute_raised_noise, without
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import fit_runs
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

LAG = 5e-3


@pytest.fixture(scope="module")
def run():
    return fit_runs(as_campaign(build_campaign(31, effects=(), rig="bridge1")))[0]


def filtered(channel: str) -> tuple[Term, dict[str, float]]:
    term = Term(catalogue()["channel_filter"], (channel,), channel)
    return term, {f"{term.label}.lag": LAG, f"{term.label}.order": 1.0}


def test_noise_grows_by_the_inverse_of_the_filter_up_to_a_power_of_nine(run):
    """|H|^-2 = 1 + (2 pi f T)^2 of a first order, no more than 3^2; above the logger's band nothing is taken out."""
    term, values = filtered("slip_x")
    frequency, factor = compute_raised_noise([term], values, run)["slip_x"]
    for hertz in (5.0, 20.0, 40.0):
        assert np.interp(hertz, frequency, factor) == pytest.approx(1.0 + (2.0 * np.pi * hertz * LAG) ** 2, rel=0.03)
    assert factor.max() < 9.1
    assert factor[-1] == pytest.approx(1.0, abs=0.05)
    gain = Term(catalogue()["channel_gain"], ("slip_x",), "slip_x")
    assert compute_raised_noise([gain], {f"{gain.label}.gain": 0.2}, run) == {}


def test_a_residual_with_raised_noise_is_brought_to_white_of_unit_size(run):
    """Half of the noise is of another channel, which nobody touched."""
    rng = np.random.default_rng(5)
    term, values = filtered("slip_x")
    raised = compute_raised_noise([term], values, run)
    own, other = rng.normal(size=(2, len(run.time))) * np.sqrt(0.5)
    noisy = run.with_record(run.record.replaced(slip_x=own), moved=False)
    left = without(term, values, noisy).record["slip_x"] + other
    assert np.std(left) > 1.3
    white = whiten_again(left, run, raised, {"slip_x": 0.5})
    assert np.std(white) == pytest.approx(1.0, rel=0.03)
    frequency, density = welch(white, 1.0 / run.dt, nperseg=256)
    parts = [density[(frequency > low) & (frequency < low + 50.0)].mean() for low in (2.0, 52.0, 102.0, 152.0)]
    assert max(parts) / min(parts) < 1.3


def test_the_motion_of_a_filtered_slip_gauge_is_judged_by_the_noise_that_it_has(run):
    term, values = filtered("slip_x")
    rng = np.random.default_rng(6)
    channels = {name: run.noise[name] * rng.normal(size=len(run.time)) for name in ("girder_ax", "table_ax", "slip_x")}
    quiet = replace(run, states=replace(run.states, record=run.record.replaced(**channels)))
    corrected = without(term, values, quiet)
    inside = slice(300, -300)
    plain = compute_motion_residual(corrected, 0.0, {}, {})[inside]
    known = compute_motion_residual(corrected, 0.0, {}, compute_raised_noise([term], values, run))[inside]
    assert np.std(plain) > 1.05
    assert np.std(known) == pytest.approx(1.0, rel=0.04)
