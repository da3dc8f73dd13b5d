"""The paper's law in its limits."""

import numpy as np
import pytest

from shaking import G
from slipwise.model import base_model, use
from slipwise.simulation.predict import predictor

AREA = np.pi * 0.0215**2


def friction(pressure, speed, model=None, engine="compiled"):
    """Coefficient of friction of pad A at pressure [Pa] and speed [m/s]."""
    pressure, speed = np.broadcast_arrays(np.asarray(pressure, float), np.asarray(speed, float))
    n = pressure.size
    load = np.repeat((pressure.ravel() * AREA)[:, None], 4, axis=1)
    velocity = np.zeros((n, 4, 2))
    velocity[:, :, 0] = speed.ravel()[:, None]
    answer = predictor(model or base_model("bridge1"), engine=engine).pads(
        np.arange(n) * 1e-3, load, velocity, np.zeros((n, 4, 2))
    )
    return (answer.bound[:, 0] / load[:, 0]).reshape(pressure.shape)


def test_mu_at_high_speed_is_the_papers_at_every_pressure():
    pressure = np.array([2, 5, 10, 16.882, 25, 50]) * 1e6
    assert friction(pressure, 10.0) == pytest.approx([0.1732, 0.1562, 0.1342, 0.1131, 0.0969, 0.0734], abs=5e-5)


def test_mu_at_rated_pressure_is_the_papers_at_every_speed():
    speed = np.array([0.5, 1, 2, 5, 10, 20, 30]) * 1e-2
    assert friction(1e4 * G / 4 / AREA, speed) == pytest.approx(
        [0.0523, 0.0580, 0.0678, 0.0880, 0.1037, 0.1118, 0.1129], abs=6e-5
    )


def test_for_small_pressure_the_law_is_coulombs():
    assert friction(1.0, 1e3) == pytest.approx(1.379e6 * 0.102e-6 + 0.046, rel=1e-7)
    assert friction(2.0, 1e3) == pytest.approx(friction(1.0, 1e3), rel=1e-6)


def test_for_large_pressure_friction_is_limited_by_shear_strength():
    pressure = 2e9
    assert friction(pressure, 1e3) == pytest.approx(0.046 + 1.379e6 / pressure, rel=1e-12)


def test_at_zero_speed_friction_is_alpha_at_every_pressure():
    assert friction(np.array([1e6, 16e6, 50e6]), 0.0) == pytest.approx(0.046, rel=1e-12)


@pytest.mark.parametrize("engine", ["compiled", "python"])
def test_composing_the_two_effects_gives_equations_7_and_8_to_machine_precision(engine):
    rng = np.random.default_rng(7)
    pressure, speed = rng.uniform(0.1e6, 60e6, 500), rng.uniform(0.0, 1.0, 500)
    s, n, k, alpha = 1.379e6, 19.7, 0.102e-6, 0.046
    mu = s * (1 - np.exp(-n * speed)) * (1 - np.exp(-k * pressure)) / pressure + alpha
    assert friction(pressure, speed, engine=engine) == pytest.approx(mu, rel=1e-13)


def test_the_printed_misprint_would_lose_the_effect_of_pressure():
    # Eq. (7) as printed, exp(-kV): with k per MPa there is nothing that V could be divided by, and the measured
    # fall of friction from 5 to 25 MPa (38 %) would be zero.
    assert friction(5e6, 10.0) / friction(25e6, 10.0) == pytest.approx(1.61, abs=0.01)


def test_without_effects_the_pad_is_coulombs():
    model = base_model("bridge1", ())
    mu = friction(np.array([1e6, 20e6, 20e6]), np.array([0.5, 0.5, 1e-4]), model)
    assert mu == pytest.approx(1.108676e6 / 9.803921568627451e6, rel=1e-12)


def test_pressure_alone_and_speed_alone_can_be_switched_on():
    area = base_model("bridge1", (use("contact_area"),))
    assert friction(5e6, 0.1, area) == pytest.approx(friction(5e6, 0.4, area), rel=1e-12)
    assert friction(5e6, 0.1, area) > 1.2 * friction(25e6, 0.1, area)
    rate = base_model("bridge1", (use("shear_rate"),))
    assert friction(5e6, 0.1, rate) == pytest.approx(friction(25e6, 0.1, rate), rel=1e-12)
    assert friction(5e6, 0.4, rate) > 1.05 * friction(5e6, 0.1, rate)


def test_a_lifted_pad_has_no_friction():
    assert predictor(base_model("bridge1")).pads(
        np.arange(3.0), np.zeros((3, 4)), np.ones((3, 4, 2)), np.zeros((3, 4, 2))
    ).force == pytest.approx(0.0)
