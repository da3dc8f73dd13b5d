"""What no gauge can have read is found, and what motions and gauges do is not."""

import numpy as np
import pytest

from slipwise.signals.filters import LowPass, lowpass
from slipwise.signals.short_bursts import short_bursts

DT = 0.002
TIME = DT * np.arange(3000)
#: Samples from the middle of a pulse.
ABOUT = np.abs(np.arange(3000) - 500)


def force(rng: np.random.Generator) -> np.ndarray:
    """Friction of a pad that slides back and forth, behind a logger of 80 Hz, with noise of 15 N."""
    turning = 2400.0 * np.tanh(np.cos(9.4 * TIME) / 0.05) * (TIME > 1.0)
    return lowpass(turning, DT, LowPass(80.0, 2)) + rng.normal(0.0, 15.0, TIME.size)


@pytest.mark.parametrize("length", [1, 2, 7, 20])
@pytest.mark.parametrize("ranges", [3.0, 1e3, 1e9])
@pytest.mark.parametrize("start", [0, 250, 1400, 2980])
def test_a_burst_beyond_the_range_is_found_sample_by_sample(length, ranges, start):
    rng = np.random.default_rng(length)
    values = force(rng)
    values[start : start + length] += ranges * np.ptp(values) * rng.choice([-1.0, 1.0], length)
    assert np.flatnonzero(short_bursts(values)).tolist() == list(range(start, start + length))


def test_a_small_and_a_huge_burst_of_one_channel_are_both_found():
    values = force(np.random.default_rng(5))
    values[700] += 3.0 * np.ptp(values)
    values[2000:2010] = 1e12
    assert np.flatnonzero(short_bursts(values)).tolist() == [700, *range(2000, 2010)]


def test_what_lies_between_two_bursts_is_kept():
    values = force(np.random.default_rng(5))
    values[700:705] += 3.0 * np.ptp(values)
    values[712:714] += 1e9
    assert np.flatnonzero(short_bursts(values)).tolist() == [*range(700, 705), 712, 713]


def test_a_single_sample_within_the_range_is_found_by_what_noise_does_elsewhere():
    values = force(np.random.default_rng(6))
    values[300] += 1500.0
    assert np.flatnonzero(short_bursts(values)).tolist() == [300]


def test_beside_a_spike_a_sample_on_a_slope_is_none():
    slip = 0.05 * np.sin(9.4 * TIME) + np.random.default_rng(7).normal(0.0, 2e-5, TIME.size)
    slip[1000] += 0.03
    assert np.flatnonzero(short_bursts(slip)).tolist() == [1000]


def test_missing_values_are_passed_over():
    values = force(np.random.default_rng(8))
    values[:100] = np.nan
    values[900] = 1e7
    assert np.flatnonzero(short_bursts(values)).tolist() == [900]


def landing(rng: np.random.Generator) -> np.ndarray:
    """The load of a pad that lifts and lands once, with a peak of three times the weight that takes ten samples."""
    load = np.full(TIME.size, 25e3)
    load[1000:1100] = 0.0
    load[1100:1110] = 25e3 + 50e3 * np.sin(np.pi * np.arange(10) / 9.0)
    return load + rng.normal(0.0, 40.0, TIME.size)


def sound() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(9)
    reversing = 2400.0 * np.sign(np.cos(9.4 * TIME))
    return {
        "noise": rng.normal(0.0, 1.0, TIME.size),
        "friction that reverses within a sample, without noise": reversing,
        "stick-slip": (TIME % 0.2) * 1e4,
        "clipped": np.clip(force(rng), -1500.0, 1500.0),
        "rounded to steps of its range": np.round(force(rng) / 2000.0),
        "a gauge at rest that flickers by one step": (rng.random(TIME.size) < 0.002).astype(float),
        "constant": np.full(TIME.size, 3.0),
        "a pulse of fifteen samples without noise": np.where(ABOUT < 8, np.cos(ABOUT * np.pi / 16.0), 0.0),
        "cusps without noise": np.abs(np.sin(3.0 * TIME)),
        "a pad that lands": landing(rng),
        "short": rng.normal(0.0, 1.0, 40),
    }  # fmt: skip


@pytest.mark.parametrize("what", sound())
def test_what_motions_and_gauges_do_is_no_burst(what):
    assert not short_bursts(sound()[what]).any()
