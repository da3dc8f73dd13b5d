"""How noisy a channel is, from the top of its spectrum and from quiet stretches; and in which steps it comes."""

import numpy as np
import pytest
from scipy.signal import lfilter

from slipwise.signals.noise import noise, quantum, white_level

COUNT = 8000
TIME = 0.002 * np.arange(COUNT)
MOTION = 30.0 * np.sin(2.0 * np.pi * 3.0 * TIME) + 8.0 * np.sin(2.0 * np.pi * 21.0 * TIME)


def white(level: float, seed: int) -> np.ndarray:
    return level * np.random.default_rng(seed).standard_normal(COUNT)


@pytest.mark.parametrize("level", [0.02, 0.5])
def test_white_noise_is_found_under_a_motion_a_thousand_times_as_large(level):
    assert white_level(MOTION + white(level, 1)) == pytest.approx(level, rel=0.1)


def test_a_hum_line_at_the_top_of_the_spectrum_is_no_noise():
    hum = 2.0 * np.sin(2.0 * np.pi * 220.0 * TIME)
    assert white_level(white(0.5, 2) + hum) == pytest.approx(0.5, rel=0.1)


def test_few_samples_show_their_noise_in_third_differences():
    found = [white_level(np.linspace(0.0, 5.0, 100) + white(0.3, seed)[:100]) for seed in range(20)]
    assert np.mean(found) == pytest.approx(0.3, rel=0.1)


def test_noise_that_went_through_the_filter_shows_only_while_nothing_moves():
    coloured = np.asarray(lfilter([0.1], [1.0, -0.9], white(1.0, 3)))
    quiet = TIME < 4.0
    values = np.where(quiet, 0.0, MOTION) + coloured
    found = noise(values, quiet)
    assert found.basis == "quiet stretch" and found.white is False
    assert found.level == pytest.approx(coloured[quiet].std(), rel=0.05)
    assert found.correlation == pytest.approx(0.9, abs=0.03)
    assert noise(values).level < 0.5 * found.level


def test_white_noise_is_called_white_and_a_slow_drift_is_not_counted():
    found = noise(white(0.4, 4) + 0.02 * TIME, TIME < 2.0)
    assert found.white is True and found.correlation == 0.0
    assert found.level == pytest.approx(0.4, rel=0.05)


def test_too_short_a_rest_is_no_basis():
    assert noise(white(0.4, 5), TIME < 0.05).basis == "top of the spectrum"


@pytest.mark.parametrize("step", [0.01, 0.25])
def test_the_step_of_a_quantised_channel_is_found(step):
    assert quantum(step * np.round((MOTION + white(0.5, 6)) / step)) == pytest.approx(step, rel=1e-6)


def test_a_continuous_channel_has_no_step():
    assert quantum(MOTION + white(0.5, 7)) == 0.0
