"""Noise that effects hide, ring with or pass on is counted for what it is."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.model import base_model, use
from slipwise.relations.girder import compute_heave_rate
from slipwise.relations.noise import (
    compute_bent_noise_in_heave,
    compute_heave_level,
    compute_vertical_friction_noise,
    whiten_residual,
    with_masked_noise,
)
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.signals.oscillator import oscillator
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def run() -> FitRun:
    return fit_runs(as_campaign(build_campaign(36206, effects=(), rig="bridge1")))[0]


def test_each_sample_carries_its_part_of_what_is_hidden() -> None:
    part = np.random.default_rng(1).standard_normal(500)
    part[:100] = 0.0  # masked
    counted = with_masked_noise(part, 0.3)
    assert float(counted @ counted) == pytest.approx(float(part @ part) + 0.3 * 400)
    assert not counted[:100].any()


def test_a_residual_that_changes_sign_does_not_jump() -> None:
    part = np.random.default_rng(2).standard_normal(500)
    shifted = part - (part[7] + 1e-6)
    moved = with_masked_noise(shifted + 2e-6, 0.3) - with_masked_noise(shifted, 0.3)
    assert np.abs(moved).max() < 1e-5


def test_a_girder_that_bends_rings_with_the_noise_of_its_accelerometer(run: FitRun) -> None:
    model = base_model("bridge1").adding(use("girder_bending", share=0.4, frequency=13.0, damping=0.01))
    mass, level = model.specimen.mass, run.noise["girder_az"]
    more, loads = compute_bent_noise_in_heave(model, run), float(np.linalg.norm(run.gauge_noise[1]))
    own, hidden = float(np.hypot(loads, mass * level)), compute_heave_level(model, run, {})
    rng, frequency = np.random.default_rng(4), np.fft.rfftfreq(len(run.time), run.dt)
    near = np.abs(frequency - 13.0) < 1.0

    def power(values: np.ndarray) -> float:
        return float(np.mean(np.abs(np.fft.rfft(values)[near]) ** 2) / len(values))

    before, after = [], []
    for _ in range(20):
        shaken = rng.normal(0.0, level, len(run.time))
        # q'' of q'' + 2 z w q' + w^2 q = -a
        carried = mass * shaken + 0.4 * mass * oscillator(-shaken, run.dt, 13.0, 0.01, 2)
        left = carried + rng.normal(0.0, loads, len(shaken))
        before.append(power(left))
        after.append(power(whiten_residual(left, run, own, more)))
    assert np.mean(before) > 5.0 * own**2
    assert np.mean(after) == pytest.approx(hidden**2, rel=0.2)


def test_the_noise_of_a_bending_girder_is_as_white_below_its_frequency_as_above(run: FitRun) -> None:
    share, frequency, damping = 0.5, 8.0, 0.026
    model = base_model("bridge1").adding(use("girder_bending", share=share, frequency=frequency, damping=damping))
    mass, level = model.specimen.mass, run.noise["girder_az"]
    hidden, more = compute_heave_level(model, run, {}), compute_bent_noise_in_heave(model, run)
    own = float(np.hypot(np.linalg.norm(run.gauge_noise[1]), mass * level))
    rng, at = np.random.default_rng(5), np.fft.rfftfreq(len(run.time), run.dt)
    bands = {"below": (at > 1.0) & (at < 6.0), "above": (at > 12.0) & (at < 100.0)}
    power = dict.fromkeys(bands, 0.0)
    for _ in range(20):
        shaken = rng.normal(0.0, level, len(run.time))
        carried = mass * (shaken + share * oscillator(-shaken, run.dt, frequency, damping, 2))
        left = carried + np.linalg.norm(run.gauge_noise[1]) * rng.standard_normal(len(shaken))
        spectrum = np.abs(np.fft.rfft(whiten_residual(left, run, own, more))) ** 2 / len(left)
        power = {name: power[name] + float(np.mean(spectrum[band])) / 20.0 for name, band in bands.items()}
    assert power["below"] == pytest.approx(hidden**2, rel=0.15)
    assert power["above"] == pytest.approx(hidden**2, rel=0.15)
    assert hidden < 0.8 * own


def test_what_rubs_against_heave_passes_on_the_noise_of_the_loads(run: FitRun) -> None:
    model = base_model("bridge1").adding(use("key_friction", friction=0.3, slow=5e-4))
    buffers = np.full((len(run.time), 2), 4e3)
    rng, levels = np.random.default_rng(6), [run.noise[f"pad_{p}_N"] for p in run.pads]
    noisy = replace(run, load=run.load + rng.standard_normal(run.load.shape) * levels)
    plain, shaken = (np.tanh(compute_heave_rate(r.load.sum(axis=1), r.dt, model.specimen) / 5e-4) for r in (run, noisy))
    made = 0.3 * 8e3 * (shaken - plain)
    expected = compute_vertical_friction_noise(model, run, buffers)["heave"]
    assert np.sqrt(np.mean(expected**2)) == pytest.approx(np.std(made), rel=0.2)
