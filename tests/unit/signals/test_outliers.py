"""Rare samples that stand out are bridged before anything is estimated; what a sound channel does often is left."""

import numpy as np
import pytest

from slipwise.signals.noise import white_level
from slipwise.signals.outliers import outliers, without_outliers
from slipwise.signals.short_bursts import LONGEST

NOISE = 0.01


def motion() -> np.ndarray:
    """Give a motion (10 000,) of range 2, of 0.5 to 1.3 Hz at 500 samples a second."""
    time = 2e-3 * np.arange(10_000)
    return np.sin(2.0 * np.pi * (0.5 + 0.02 * time) * time)


def noise(seed: int) -> np.ndarray:
    return NOISE * np.random.default_rng(seed).standard_normal(10_000)


def sweep() -> np.ndarray:
    return motion() + noise(3)


@pytest.mark.parametrize("size", [-1.6, 0.3, 1.6])
@pytest.mark.parametrize("at", [30, 700, 4444, 9970])
def test_one_sample_in_ten_thousand_is_found_and_nothing_far_from_it(at, size):
    values = sweep()
    values[at] += size
    found = np.flatnonzero(outliers(values))
    assert at in found
    assert np.abs(found - at).max() < LONGEST  # on a slope, samples beside it seem to stand out too


@pytest.mark.parametrize("length", [3, 5, 15])
def test_a_burst_of_less_than_the_range_is_bridged(length):
    values = sweep()
    values[5000 : 5000 + length] += 1.6
    assert np.abs(without_outliers(values) - sweep()).max() < 10.0 * NOISE


def test_neither_noise_nor_friction_that_turns_round_is_an_outlier():
    assert not outliers(sweep()).any()
    force = np.tanh(50.0 * motion()) + noise(4)
    assert not outliers(force).any()


def test_a_glitch_that_comes_often_belongs_to_the_channel():
    values = sweep()
    values[::40] += 1.0
    assert not outliers(values).any()


def test_missing_values_stay_missing():
    values = sweep()
    values[[100, 690]] = np.nan
    values[700] += 1.6
    after = without_outliers(values)
    assert np.flatnonzero(np.isnan(after)).tolist() == [100, 690]
    assert after[700] == pytest.approx(sweep()[700], abs=10.0 * NOISE)


def test_the_white_noise_level_ignores_one_glitch():
    values = sweep()
    values[4444] += 1.6
    assert white_level(values) == pytest.approx(white_level(sweep()), rel=0.01)
