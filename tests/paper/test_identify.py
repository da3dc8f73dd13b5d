"""The four parameters, found again."""

import numpy as np
import pytest

from slipwise.model import base_model
from slipwise.studies.paper import PaperSettings, paper_model
from slipwise.studies.paper.identify import PadData, friction_law, identify, with_noise
from slipwise.studies.paper.law import mu
from slipwise.studies.paper.sine_tests import SWINGS, noise_of, pad_data, sine_model, sine_test, truth, worth_of_swing

MODEL = base_model("bridge1")
AREA, TRUE = MODEL.specimen.pad_area, truth(MODEL)
SETTINGS = PaperSettings()


def sweep(count=800, lowest=5e6, highest=25e6, fastest=0.3, seed=3):
    """Loads and speeds all over a range, with the friction that eq. (7) gives them."""
    rng = np.random.default_rng(seed)
    load, speed = rng.uniform(lowest, highest, count) * AREA, rng.uniform(0.012, fastest, count)
    return PadData(load, speed, friction_law(load, speed, AREA, TRUE))


@pytest.mark.slow
def test_the_law_that_is_fitted_is_the_law_of_the_effects():
    data = sweep()
    assert friction_law(data.load, data.speed, AREA, TRUE) == pytest.approx(
        mu(MODEL, data.load / AREA, data.speed) * data.load, rel=1e-13
    )


def test_without_noise_all_four_come_back_from_a_bad_guess():
    found = identify(sweep(), AREA, TRUE * np.array([0.5, 2.0, 2.0, 0.5]))
    assert found.values == pytest.approx(TRUE, rel=1e-6)
    assert found.residual < 1e-8


def test_intervals_hold_the_truth_as_often_as_they_say():
    data, rms = sweep(), 0.02 * 2.8e3
    inside = np.zeros(4)
    for seed in range(120):
        noisy = with_noise(data, 0.0, 0.0, rms, np.random.default_rng(seed))
        found = identify(noisy, AREA, TRUE * 1.2)
        inside += (found.low <= TRUE) & (found.high >= TRUE)
    # 95 % of 120 is 114; three standard deviations of that count are 7.
    assert np.all(inside >= 107), inside


def test_strength_is_tied_to_slow_friction_and_to_saturation():
    # corr(s', alpha) = -0.94, corr(s', k) = -0.90 with pressures of 5 to 25 MPa and speeds up to 0.3 m/s.
    noisy = with_noise(sweep(4000), 0.0, 0.0, 0.02 * 2.8e3, np.random.default_rng(1))
    correlation = identify(noisy, AREA, TRUE).correlation
    assert correlation[0, 3] == pytest.approx(-0.94, abs=0.04)
    assert correlation[0, 2] == pytest.approx(-0.90, abs=0.05)


def test_a_small_swing_of_pressure_hides_k():
    # sd(k) is about four times larger with +-10 % than with 5 to 25 MPa.
    rms = 0.02 * 2.8e3
    wide, narrow = (
        identify(with_noise(sweep(800, low, high), 0.0, 0.0, rms, np.random.default_rng(2)), AREA, TRUE)
        for low, high in ((5e6, 25e6), (0.9 * 16.9e6, 1.1 * 16.9e6))
    )
    assert narrow.deviation[2] / wide.deviation[2] == pytest.approx(4.0, rel=0.25)


def test_noise_of_load_and_speed_hardly_biases():
    noise = noise_of(SETTINGS, MODEL)
    found = [
        identify(with_noise(sweep(), *noise, np.random.default_rng(seed)), AREA, TRUE, noise).values
        for seed in range(40)
    ]
    bias = np.mean(found, axis=0) / TRUE - 1.0
    assert np.all(np.abs(bias) < 0.01), bias


def test_a_parameter_that_is_held_stays():
    found = identify(sweep(), AREA, TRUE * np.array([1.3, 1.0, 1.3, 1.3]), fixed=(1,))
    assert found.deviation[1] == 0.0
    assert found.low[1] == found.high[1] == found.values[1]
    assert found.values == pytest.approx(TRUE, rel=1e-6)


def test_sine_tests_reach_the_pressures_of_figure_12():
    record, vertical = sine_test(sine_model(SETTINGS))
    pressure = record["pad_C_N"] / AREA
    assert pressure.max() == pytest.approx(25e6, abs=0.5e6)
    assert pressure.min() == pytest.approx(5e6, abs=0.5e6)
    assert vertical > 0.0


def test_pad_c_carries_its_assumed_share_at_rest():
    from slipwise.rig.statics import at_rest

    specimen = sine_model(SETTINGS).built_specimen()
    assert at_rest(specimen).load[2] / (specimen.weight / 4) == pytest.approx(0.89, abs=1e-6)


def test_a_larger_swing_is_worth_more():
    model = paper_model("bridge2", SETTINGS)
    record, _ = sine_test(sine_model(SETTINGS))
    rows = worth_of_swing(pad_data(record), model, SETTINGS)
    deviations = [row["k"] for row in rows]
    assert deviations == sorted(deviations, reverse=True)
    assert deviations[0] > 3 * deviations[-1]
    assert [row["swing"] for row in rows] == list(SWINGS)
