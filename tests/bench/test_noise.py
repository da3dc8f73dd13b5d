"""Noise of the bench has the spectrum and the steps that it says it has."""

import numpy as np
import pytest
from scipy.signal import welch

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.gauges import USUAL, Logger, measure
from slipwise_benchmarks.noise import coloured, converter_step, full_scale, hum, one_over_f, quantised


def test_white_noise_is_what_the_generator_gives():
    plain = np.random.default_rng(1).normal(size=150)[50:]
    assert np.array_equal(coloured(100, 0.0, 0.0, np.random.default_rng(1)), plain)


def test_correlated_noise_has_variance_one_and_its_correlation():
    noise = coloured(200_000, 0.8, 0.0, np.random.default_rng(2))
    assert np.var(noise) == pytest.approx(1.0, rel=0.03)
    assert np.mean(noise[1:] * noise[:-1]) == pytest.approx(0.8, rel=0.03)


def test_pink_noise_has_variance_one_and_falls_as_one_over_f():
    noise = np.stack([one_over_f(4096, np.random.default_rng(seed)) for seed in range(60)])
    assert np.var(noise) == pytest.approx(1.0, rel=0.05)
    frequency, power = welch(noise, nperseg=1024)
    inside = (frequency > 0.01) & (frequency < 0.4)
    slope = np.polyfit(np.log(frequency[inside]), np.log(power.mean(axis=0)[inside]), 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.05)


def test_hum_is_at_the_mains_frequency():
    signal = hum(5000, 60.0 / 500.0, np.random.default_rng(3))
    frequency, power = welch(signal, fs=500.0, nperseg=2500)
    assert frequency[np.argmax(power)] == pytest.approx(60.0, abs=0.2)
    assert np.std(signal) == pytest.approx(np.sqrt(0.5), rel=1e-3)


def test_a_converter_gives_whole_steps_and_rounds_by_half_of_one_at_most():
    signal = np.random.default_rng(4).uniform(-4.5, 4.5, 10_000)
    rounded, step = quantised(signal, 5.0, 12), converter_step(5.0, 12)
    assert step == pytest.approx(10.0 / 4096)
    assert rounded / step == pytest.approx(np.round(rounded / step), abs=1e-9)
    assert np.abs(rounded - signal).max() <= 0.5 * step
    assert np.std(rounded - signal) == pytest.approx(step / np.sqrt(12.0), rel=0.03)
    assert quantised(np.array([9.0, -9.0]), 5.0, 12).tolist() == [5.0 - step, -5.0]


@pytest.mark.parametrize(("largest", "reach"), [(0.7, 1.0), (0.8, 2.0), (31.0e3, 50.0e3), (0.021, 0.05), (4.0, 10.0)])
def test_a_range_is_the_next_that_leaves_room(largest, reach):
    assert full_scale(largest) == pytest.approx(reach)


def _still(seconds: float = 1.0) -> dict[str, np.ndarray]:
    time = np.arange(0.0, seconds, 1.0e-4)
    true = {name: np.zeros(time.size) for name in USUAL}
    true["pad_A_N"] = 24.5e3 + 500.0 * np.sin(2.0 * np.pi * time)
    return {"time": time, **true}


@pytest.mark.parametrize("rate", [200.0, 500.0, 1000.0, 2000.0])
def test_a_logger_samples_at_its_rate(rate):
    run = measure(_still(), USUAL, Logger(rate=rate, lowpass=50.0), [], None)
    assert np.diff(run["time"]) == pytest.approx(1.0 / rate)


def test_what_comes_before_any_balance_does_what_it_says():
    true, logger = _still(), Logger()
    sound = measure(true, USUAL, logger, [], None)["pad_A_N"]

    def read(fault: Fault, number: int = 0) -> np.ndarray:
        return measure(true, USUAL, logger, [fault], None, number)["pad_A_N"]

    assert read(Fault("reversed", ("pad_A_N",), 0.0)) == pytest.approx(-sound)
    assert read(Fault("late", ("pad_A_N",), 0.2))[100:] == pytest.approx(sound[:-100], abs=0.1)
    assert read(Fault("tared", ("pad_A_N",), 0.0)) == pytest.approx(sound - sound[:50].mean())
    assert read(Fault("dead", ("pad_A_N",), 7.0, "constant")) == pytest.approx(7.0)
    assert read(Fault("dead", ("pad_A_N",), 7.0, "noisy", runs=(1,)), 1) == pytest.approx(7.0)
    assert np.array_equal(read(Fault("dead", ("pad_A_N",), 7.0, "noisy", runs=(1,)), 0), sound)
    noisy = measure(true, USUAL, logger, [Fault("dead", ("pad_A_N",), 7.0, "noisy")], np.random.default_rng(5))
    assert np.std(noisy["pad_A_N"]) == pytest.approx(logger.noise["load"], rel=0.1)
    leans = measure(true, USUAL, logger, [Fault("gravity", ("girder_az",), 9.8)], None)
    assert leans["girder_az"] == pytest.approx(9.8) and np.array_equal(leans["pad_A_N"], sound)
