"""The nearest friction model of another program: which it is, and with which numbers."""

import numpy as np
import pytest

from slipwise.export.friction_fit import FrictionFit, fit_nearest, fit_pads, fit_rate
from slipwise.export.friction_states import FrictionStates


def states(law, pad="A", seed=1):
    """A pad that slides at up to 0.4 m/s under 5 to 25 MPa."""
    generator = np.random.default_rng(seed)
    speed = 0.4 * np.abs(np.sin(generator.uniform(0.0, np.pi, 3000)))
    pressure = generator.uniform(5e6, 25e6, 3000)
    return FrictionStates(pad, 1.452e-3, pressure, speed, law(pressure, speed), np.ones(3000))


def constant(mu):
    return lambda pressure, speed: np.full_like(speed, mu)


def test_constant_friction_is_coulombs_with_its_coefficient():
    fit = fit_nearest([states(constant(0.1))])
    assert fit.kind == "Coulomb"
    assert fit.fast == pytest.approx(0.1) and fit.error < 1e-9


def test_friction_that_follows_speed_alone_is_found_with_its_three_numbers():
    fit = fit_nearest([states(FrictionFit("VelDependent", 0.046, 0.113, 19.7).coefficient)])
    assert fit.kind == "VelDependent"
    assert (fit.slow, fit.fast, fit.rate) == pytest.approx((0.046, 0.113, 19.7), rel=5e-3)


def test_the_papers_law_is_within_three_thousandths_of_a_model_of_speed_and_pressure():
    """Eq. (8): mu = s' (1 - exp(-n V)) (1 - exp(-k P)) / P + alpha; tanh is not exp, but near over 5 to 25 MPa."""

    def law(pressure, speed):
        return 1.379e6 * -np.expm1(-19.7 * speed) * -np.expm1(-0.102e-6 * pressure) / pressure + 0.046

    fit = fit_nearest([states(law)])
    assert fit.kind == "VelPressureDep"
    assert fit.error < 3e-3
    assert (fit.slow, fit.rate) == pytest.approx((0.046, 19.7), rel=5e-3)


def test_pads_of_one_law_share_a_model_and_pads_that_differ_have_their_own():
    alike = fit_pads([states(constant(0.1), "A"), states(constant(0.1), "B", seed=2)])
    assert alike["A"] == alike["B"]
    apart = fit_pads([states(constant(0.10), "A"), states(constant(0.12), "B", seed=2)])
    assert (apart["A"].fast, apart["B"].fast) == pytest.approx((0.10, 0.12))


def test_no_pressure_makes_friction_negative():
    fit = fit_nearest([states(lambda p, v: 0.2 * np.exp(-p / 8e6) * (1.0 - np.exp(-20.0 * v)))])
    far = fit.coefficient(np.geomspace(1e4, 1e9, 50), np.full(50, 1.0))
    assert far.min() >= 0.0


def test_a_link_without_pressure_says_how_far_it_is_from_a_law_with():
    law = FrictionFit("VelPressureDep", 0.05, 0.12, 20.0, 0.05, 0.05e-6).coefficient
    assert 0.02 < fit_rate([states(law)]).error < 0.2
