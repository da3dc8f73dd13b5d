"""The logger's filter does what a Butterworth filter does: known gain, known phase, known lag."""

import numpy as np
import pytest
from scipy.signal import butter, freqs

from slipwise.errors import InputError, SettingError, UnknownNameError
from slipwise.signals.filters import LowPass, align, lowpass, response

DT = 0.002
TIME = DT * np.arange(2000)
#: Samples away from the ends, where a filter has seen both sides.
MIDDLE = slice(500, 1500)


def amplitude_and_phase(values: np.ndarray, frequency: float) -> tuple[float, float]:
    """Fit a sine: amplitude [1] and phase [rad] against sin(2 pi f t)."""
    turn = 2.0 * np.pi * frequency * TIME[MIDDLE]
    columns = np.stack([np.sin(turn), np.cos(turn)], axis=1)
    inphase, quadrature = np.linalg.lstsq(columns, values[MIDDLE], rcond=None)[0]
    return float(np.hypot(inphase, quadrature)), float(np.arctan2(quadrature, inphase))


@pytest.mark.parametrize("order", [1, 2, 4, 8])
def test_the_response_of_one_pass_is_that_of_the_analogue_butterworth_filter(order):
    frequency = np.geomspace(1.0, 240.0, 40)
    numerator, denominator = butter(order, 2.0 * np.pi * 80.0, analog=True)
    expected = freqs(numerator, denominator, 2.0 * np.pi * frequency)[1]
    assert response(LowPass(80.0, order, "causal"), frequency) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("phase", "gain", "turned"),
    [("zero", 0.5, 0.0), ("aligned", np.sqrt(0.5), 0.0), ("causal", np.sqrt(0.5), -np.pi)],
)
def test_at_its_frequency_a_fourth_order_filter_lets_through_what_theory_says(phase, gain, turned):
    # each of the four poles turns the phase by 45 degrees at the corner
    filtered = lowpass(np.sin(2.0 * np.pi * 50.0 * TIME), DT, LowPass(50.0, 4, phase))
    found, angle = amplitude_and_phase(filtered, 50.0)
    assert found == pytest.approx(gain, rel=1e-3)
    assert np.exp(1j * angle) == pytest.approx(np.exp(1j * turned), abs=2e-3)


@pytest.mark.parametrize("order", [1, 2, 4])
def test_a_causal_filter_is_late_by_its_lag_where_motion_is_slow(order):
    by = LowPass(60.0, order, "causal")
    _, angle = amplitude_and_phase(lowpass(np.sin(2.0 * np.pi * 2.0 * TIME), DT, by), 2.0)
    assert -angle / (2.0 * np.pi * 2.0) == pytest.approx(by.lag, rel=5e-3)


def test_aligning_takes_the_lag_out_and_leaves_the_amplitude():
    by = LowPass(60.0, 4, "causal")
    late = lowpass(np.sin(2.0 * np.pi * 30.0 * TIME), DT, by)
    straight, seen_as = align(late, DT, by)
    before, _ = amplitude_and_phase(late, 30.0)
    after, angle = amplitude_and_phase(straight, 30.0)
    assert after == pytest.approx(before, rel=1e-3)
    assert angle == pytest.approx(0.0, abs=2e-3)
    assert seen_as == LowPass(60.0, 4, "aligned")


@pytest.mark.parametrize("by", [None, LowPass(60.0, 4, "zero")])
def test_there_is_no_lag_to_take_out_of_what_was_not_filtered_or_filtered_both_ways(by):
    values = np.sin(TIME)
    straight, seen_as = align(values, DT, by)
    assert straight is values and seen_as == by


@pytest.mark.parametrize("phase", ["zero", "causal", "aligned"])
def test_a_straight_line_comes_through_to_its_very_ends(phase):
    by = LowPass(40.0, 4, phase)
    line = 3.0 + 2.0 * TIME
    expected = 3.0 + 2.0 * (TIME - by.lag)
    assert lowpass(line, DT, by) == pytest.approx(expected, abs=2e-3)


def test_a_filter_refuses_missing_samples_rather_than_spreading_them():
    values = np.sin(TIME)
    values[7] = np.nan
    with pytest.raises(InputError, match="1 samples are missing"):
        lowpass(values, DT, LowPass(40.0))


@pytest.mark.parametrize(
    ("setting", "error", "message"),
    [
        ({"frequency": 0.0}, SettingError, "above zero"),
        ({"frequency": 50.0, "order": 17}, SettingError, "1 to 16"),
        ({"frequency": 50.0, "phase": "casual"}, UnknownNameError, "did you mean causal"),
    ],
)
def test_a_filter_that_cannot_be_is_refused(setting, error, message):
    with pytest.raises(error, match=message):
        LowPass(**setting)
