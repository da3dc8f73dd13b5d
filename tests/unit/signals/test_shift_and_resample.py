"""Shifts by phase are exact; derivatives, integrals and new time axes do what they say."""

import numpy as np
import pytest

from slipwise.signals.derivative import derivative
from slipwise.signals.ends import in_frequency
from slipwise.signals.resample import resampled, uniform_time
from slipwise.signals.shift import shift

DT = 0.002
TIME = DT * np.arange(1500)
INNER = slice(200, -200)


@pytest.mark.parametrize("delay", [0.3 * DT, -0.5 * DT, 4.25 * DT, 0.01])
@pytest.mark.parametrize("frequency", [3.0, 40.0, 150.0])
def test_a_sine_shifted_by_a_fraction_of_a_sample_is_that_sine_later(delay, frequency):
    shifted = shift(np.sin(2.0 * np.pi * frequency * TIME), DT, delay)
    expected = np.sin(2.0 * np.pi * frequency * (TIME - delay))
    assert shifted[INNER] == pytest.approx(expected[INNER], abs=1e-3)


@pytest.mark.parametrize("frequency", [3.0, 40.0, 200.0])
def test_a_spectrum_gives_a_sine_between_its_samples(frequency):
    fine = in_frequency(np.sin(2.0 * np.pi * frequency * TIME), DT, np.ones_like, 64, 8)
    expected = np.sin(2.0 * np.pi * frequency * DT / 8.0 * np.arange(8 * len(TIME)))
    assert fine[1600:-1600] == pytest.approx(expected[1600:-1600], abs=2e-3)


def test_a_shift_keeps_the_noise_that_interpolation_would_smooth():
    noise = np.random.default_rng(1).standard_normal(20000)
    moved = shift(noise, DT, 0.5 * DT)
    assert moved.std() == pytest.approx(noise.std(), rel=0.01)
    assert np.interp(np.arange(20000) - 0.5, np.arange(20000), noise).std() < 0.8


def test_there_and_back_is_where_it_was():
    values = np.cumsum(np.random.default_rng(2).standard_normal(len(TIME)))
    smooth = np.convolve(values, np.hanning(25) / np.hanning(25).sum(), mode="same")
    back = shift(shift(smooth, DT, 0.37 * DT), DT, -0.37 * DT)
    assert back[INNER] == pytest.approx(smooth[INNER], abs=1e-3 * np.ptp(smooth))


def test_the_derivative_agrees_with_calculus():
    turn = 2.0 * np.pi * 12.0
    values = np.sin(turn * TIME)
    assert derivative(values, DT)[5:-5] == pytest.approx(turn * np.cos(turn * TIME)[5:-5], abs=1e-3 * turn)


def test_an_even_clock_is_left_alone():
    axis = uniform_time(TIME)
    assert axis.time is TIME and not axis.moved and axis.measured.all()


def test_a_clock_that_is_only_written_coarsely_is_put_on_its_line():
    true = np.arange(500) / 96.0
    axis = uniform_time(np.round(true, 2))
    assert not axis.moved and axis.measured.all()
    assert axis.time == pytest.approx(true, abs=2e-3)
    assert np.ptp(np.diff(axis.time)) < 1e-9


def test_a_gap_is_filled_with_samples_that_are_marked_as_not_measured():
    kept = (TIME < 1.0) | (TIME > 1.2)
    axis = uniform_time(TIME[kept])
    assert axis.moved and len(axis.time) == len(TIME)
    inside = (axis.time > 1.0 + 2 * DT) & (axis.time < 1.2 - 2 * DT)
    assert not axis.measured[inside].any()
    assert axis.measured[axis.time < 1.0 - DT].all() and axis.measured[axis.time > 1.2 + 2 * DT].all()


def test_resampling_goes_through_what_was_measured_and_is_constant_beyond_the_ends():
    values = np.sin(2.0 * np.pi * 5.0 * TIME)
    new = np.array([-1.0, 0.0005, 0.5013, 9.0])
    expected = np.sin(2.0 * np.pi * 5.0 * np.clip(new, TIME[0], TIME[-1]))
    assert resampled(TIME, values, new) == pytest.approx(expected, abs=1e-6)


def test_a_rate_that_was_changed_on_purpose_leaves_its_samples_measured():
    slow, fast = 0.1 * np.arange(50), 5.0 + 0.01 * np.arange(1000)
    axis = uniform_time(np.concatenate([slow, fast]))
    here = axis.time[axis.measured]
    assert np.count_nonzero(here < 4.95) == 50
    np.testing.assert_allclose(here[here < 4.95], slow[:50], atol=5e-3)
    assert axis.measured[axis.time > 5.0].all()


def test_single_long_steps_are_gaps():
    time = np.delete(0.01 * np.arange(400), [100, 101, 102, 250, 251])
    axis = uniform_time(time)
    assert not axis.measured[100:102].any() and not axis.measured[250]
