"""The logger's filter, where nobody knows it, is read from the spectrum of friction, whatever the law of friction."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import Campaign, Logger
from slipwise.preparation.logger import determine_logger, estimate_logger
from slipwise.signals.filters import LowPass, lowpass
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


def smooth(slip: np.ndarray, dt: float) -> np.ndarray:
    return lowpass(slip, dt, LowPass(30.0))


def unstated(campaign: Campaign) -> Campaign:
    return replace(campaign, logger=Logger())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("effect", "seed", "within"),
    [
        ("buffer_hardening", 71002, 0.1),
        ("heating", 71021, 0.1),
        ("breakaway", 71044, 0.1),
        ("presliding", 71038, 0.2),  # a long bristle bends the spectrum itself
    ],
)
def test_an_unknown_filter_is_found_beside_an_effect_that_the_model_lacks(effect, seed, within):
    made = build_campaign(seed, effects=(effect,), size="large")
    likeliest = estimate_logger(unstated(as_campaign(made))).likeliest
    assert likeliest is not None and likeliest.every is not None
    assert likeliest.every.frequency == pytest.approx(made.truth.logger.lowpass, rel=within)


@pytest.mark.slow
def test_a_fit_takes_the_logger_for_what_the_audit_says_of_the_runs_that_are_not_held_out():
    campaign = unstated(as_campaign(build_campaign(71027, effects=())))
    seen = replace(campaign, runs=tuple(run for run in campaign.runs if run.role != "holdout"))
    assert fit_base(campaign).campaign.logger == estimate_logger(seen).likeliest


def test_without_a_bend_there_was_no_filter():
    campaign = as_campaign(build_campaign(71027, effects=()))
    rng = np.random.default_rng(3)
    sharp = {}
    for run in campaign.runs:  # friction turns round between two samples, and nothing was filtered
        forces = {
            f"pad_{p}_Fx": 2400.0 * np.sign(np.gradient(smooth(run.record["slip_x"], run.record.dt))) for p in "ABCD"
        }
        sharp[run.name] = run.record.replaced(**{n: f + rng.normal(0.0, 3.0, f.size) for n, f in forces.items()})
    found = estimate_logger(unstated(campaign.with_records(sharp, "unfiltered")))
    assert found.lowpass is None
    assert found.likeliest == Logger(known=True)


@pytest.mark.slow
@pytest.mark.parametrize("rate", [50.0, 100.0])
def test_a_slow_logger_says_nothing_and_is_fitted_all_the_same(rate):
    campaign = as_campaign(build_campaign(71027, effects=()))
    every = round(1.0 / rate / campaign.runs[0].record.dt)
    slow = {run.name: replace(run.record, time=run.record.time[::every], channels={
        n: x[::every] for n, x in run.record.channels.items()}) for run in campaign.runs}  # fmt: skip
    campaign = unstated(campaign.with_records(slow, "slow"))
    assert estimate_logger(campaign).likeliest is None
    assert fit_base(campaign).campaign.logger.known


@pytest.mark.parametrize("shape", [(4, "zero"), (8, "causal")])
def test_eight_causal_poles_are_told_from_four_there_and_back_by_what_rings_before_a_reversal(shape):
    """Both fall alike; with the wrong one a complete model leaves twice the floor on its pads."""
    campaign = as_campaign(build_campaign(31, effects=(), rig="bridge1"))
    by = LowPass(40.0, *shape)
    records = {
        run.name: run.record.replaced(**{n: lowpass(x, run.record.dt, by) for n, x in run.record.channels.items()})
        for run in campaign.runs
    }
    filtered = unstated(campaign.with_records(records, "filtered"))
    told, found, _ = determine_logger(filtered, {})
    assert told.logger.every is not None and found is not None
    assert (told.logger.every.order, told.logger.every.phase) == shape
    assert told.logger.every.frequency == pytest.approx(40.0, rel=0.15)
    assert found.likeliest is not None and found.likeliest.every == told.logger.every
