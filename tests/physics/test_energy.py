"""Energy closes, whatever acts on the girder."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import G, shaken, sine
from slipwise.model import base_model


def earthquake(seconds=30.0, peak=0.7 * G, dt=5e-4, seed=11):
    """Noise through a 4 Hz oscillator under an envelope, with a vertical part."""
    rng = np.random.default_rng(seed)
    n = round(seconds / dt)
    f = np.fft.rfftfreq(n, dt)
    shape = 1.0 / np.sqrt((1 - (f / 4.0) ** 2) ** 2 + (0.6 * f / 4.0) ** 2) * (f > 0.4) * (f < 25.0)
    t = np.arange(n) * dt
    envelope = np.clip(t / 2, 0, 1) * np.clip((seconds - t) / 8, 0, 1)
    out = np.zeros((n, 3))
    for axis, scale in ((0, 1.0), (1, 0.4), (2, 0.35)):
        out[:, axis] = np.fft.irfft(np.fft.rfft(rng.standard_normal(n)) * shape, n) * envelope
        out[:, axis] *= scale * peak / np.abs(out[:, axis]).max()
    return out


@pytest.mark.parametrize("rig", ["bridge1", "bridge2", "block", "pendulum", "building"])
def test_energy_closes_over_an_earthquake_of_thirty_seconds(rig):
    replay = shaken(base_model(rig), earthquake())
    assert abs(replay.energy_error) < 0.002
    assert sum(replay.pad_energy.values()) > 1000.0


def test_energy_closes_with_a_bending_girder():
    model = base_model("bridge1")
    specimen = replace(model.specimen, bending_mass=6000.0, bending_frequency=13.0)
    replay = shaken(replace(model, specimen=specimen), earthquake(8.0))
    assert abs(replay.energy_error) < 0.002


def test_the_error_of_the_balance_falls_with_the_step():
    coarse = shaken(base_model("bridge1"), sine(2.0, 0.3 * G, 5.0, dt=1e-3), dt=1e-3)
    fine = shaken(base_model("bridge1"), sine(2.0, 0.3 * G, 5.0, dt=2.5e-4), dt=2.5e-4)
    assert abs(fine.energy_error) < 0.5 * abs(coarse.energy_error)


def test_a_girder_that_sticks_dissipates_nothing():
    replay = shaken(base_model("bridge1"), sine(2.0, 0.03 * G, 3.0))
    # A cycle at 0.3 g dissipates about 600 J; what is left is the creep of the constraint, about 1 um/s.
    assert sum(replay.pad_energy.values()) < 1e-5 * 600.0
