"""Resampling: a sine below the Nyquist frequency keeps amplitude and phase, one above it does not fold back."""

import numpy as np
import pytest

from slipwise.errors import SettingError
from slipwise.motion import TableMotion, resample, scale_time


def sine(frequency: float, dt: float, duration: float = 20.0) -> TableMotion:
    t = np.arange(int(duration / dt) + 1) * dt
    values = np.stack([np.sin(2 * np.pi * frequency * t + 0.3), np.cos(2 * np.pi * frequency * t), 0 * t], axis=1)
    return TableMotion(dt, values, "sine", ("a", "b", ""))


def middle(motion: TableMotion, column: int = 0):
    inside = (motion.time > 3) & (motion.time < motion.duration - 3)
    return motion.time[inside], motion.acceleration[inside, column]


def amplitude_and_phase(motion: TableMotion, frequency: float) -> tuple[float, float]:
    t, values = middle(motion)
    angle = 2 * np.pi * frequency * t + 0.3
    (in_phase, out_of_phase), *_ = np.linalg.lstsq(np.stack([np.sin(angle), np.cos(angle)], axis=1), values, rcond=None)
    return float(np.hypot(in_phase, out_of_phase)), float(np.arctan2(out_of_phase, in_phase))


#: To the step of a replay from the agencies', from a model's time, and coarser.
STEPS = [(0.02, 0.0005), (0.01, 0.0005), (0.005, 0.0005), (0.01 / 3.2696, 0.0005), (0.0005, 0.0037), (0.002, 0.005)]


@pytest.mark.parametrize(("old", "new"), STEPS)
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_sine_below_both_nyquist_frequencies_keeps_amplitude_and_phase(old, new, share):
    frequency = share * 0.5 / max(old, new)
    amplitude, phase = amplitude_and_phase(resample(sine(frequency, old), new), frequency)
    assert amplitude == pytest.approx(1.0, abs=2e-4)
    assert phase == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("share", [1.0, 1.02, 1.2, 3.0])
def test_what_lies_above_the_new_nyquist_frequency_does_not_fold_back(share):
    _, values = middle(resample(sine(share * 50.0, 0.0005, 10.0), 0.01))
    assert np.abs(values).max() < 1e-4


def test_refining_adds_nothing_above_the_old_nyquist_frequency():
    noise = np.random.default_rng(3).standard_normal((2000, 3))
    fine = resample(TableMotion(0.01, noise, "noise", ("a", "b", "c")), 0.0005)
    power = np.abs(np.fft.rfft(fine.acceleration[:, 0] * np.hanning(len(fine)))) ** 2
    frequency = np.fft.rfftfreq(len(fine), 0.0005)
    assert power[frequency > 53].sum() < 1e-6 * power.sum()


@pytest.mark.parametrize("new", [0.0005, 0.0025, 0.01 / 3])
def test_refining_keeps_every_recorded_sample(new):
    noise = np.random.default_rng(4).standard_normal((500, 3))
    fine = resample(TableMotion(0.01, noise, "noise", ("a", "b", "c")), new)
    every = round(0.01 / new)
    np.testing.assert_allclose(fine.acceleration[::every], noise, atol=1e-9)


def test_a_motion_in_the_models_time_is_the_same_whether_scaled_before_or_after():
    before = resample(scale_time(sine(5.0, 0.01), 10.69), 0.0005)
    t, values = middle(before)
    np.testing.assert_allclose(values, np.sin(2 * np.pi * 5.0 * np.sqrt(10.69) * t + 0.3), atol=1e-4)


def test_a_constant_stays_and_the_ends_do_not_ring():
    constant = TableMotion(0.01, np.full((300, 3), 2.0), "constant", ("a", "b", "c"))
    for dt in (0.0005, 0.0037, 0.02):
        np.testing.assert_allclose(resample(constant, dt).acceleration, 2.0, atol=1e-4)


def test_the_same_step_gives_the_same_motion_and_another_is_stated():
    motion = sine(2.0, 0.01)
    assert resample(motion, 0.01) is motion
    assert "from 0.01 s to 0.0005 s" in resample(motion, 0.0005).treatment[-1]
    assert resample(motion, 0.0005).duration == pytest.approx(motion.duration)
    assert "anti-alias" in resample(motion, 0.02).treatment[-1]


@pytest.mark.parametrize("dt", [0.0, -0.01, float("nan"), 1e-9, 100.0])
def test_an_impossible_step_is_refused(dt):
    with pytest.raises(SettingError):
        resample(sine(2.0, 0.01), dt)


def test_the_shortest_motion_can_be_refined():
    shortest = TableMotion(0.01, np.array([[0.0, 0, 0], [1.0, 0, 0]]), "two", ("a", "", ""))
    assert len(resample(shortest, 0.005)) == 3
