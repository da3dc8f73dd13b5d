"""Curves over states: what they find, what base parameters take from them, and that noise carries nothing over."""

import numpy as np
import pytest

from slipwise.discovery.residual_field import ResidualField
from slipwise.discovery.splines import hats, knots_of, spline

RNG = np.random.default_rng(7)
STATE, GROUP = RNG.uniform(0.0, 2.0, 6000), np.repeat(np.arange(4), 1500)


def field(residual: np.ndarray, basis: np.ndarray | None = None) -> ResidualField:
    given = np.zeros((len(residual), 0)) if basis is None else basis
    left = residual - given @ (given.T @ residual)
    return ResidualField("pads", left, given, np.ones(len(residual)), GROUP, {}, 1)


def test_hats_add_up_to_one_and_are_straight_between_knots() -> None:
    knots = knots_of(STATE, 9)
    found = hats(STATE, knots)
    np.testing.assert_allclose(found.sum(axis=1), 1.0)
    np.testing.assert_allclose(found @ knots, STATE, atol=1e-12)


def test_a_curve_takes_what_goes_with_its_state_and_carries_over() -> None:
    made = field(5.0 * np.sin(3.0 * STATE) + RNG.standard_normal(len(STATE)))
    found = spline(made, np.ones(len(STATE)), (STATE,), (16,))
    assert found.gain / made.excess == pytest.approx(1.0, abs=0.02)
    assert found.carried_over() / made.excess == pytest.approx(1.0, abs=0.02)
    np.testing.assert_allclose(found.curve(), 5.0 * np.sin(3.0 * found.knots[0]), atol=0.6)


def test_noise_gains_as_much_as_it_has_knots_and_carries_nothing_over() -> None:
    found = spline(field(RNG.standard_normal(len(STATE))), np.ones(len(STATE)), (STATE,), (16,))
    assert 4.0 < found.gain < 40.0 and found.carried_over() < 10.0


def test_what_only_tells_one_motion_from_another_carries_nothing_over() -> None:
    offsets = np.array([3.0, -2.0, 1.0, -2.0])[GROUP]
    found = spline(field(offsets + RNG.standard_normal(len(STATE))), np.ones(len(STATE)), (GROUP + STATE / 20,), (16,))
    assert found.gain > 10000.0 and found.carried_over() < 0.2 * found.gain


def test_what_a_base_parameter_can_do_is_not_found() -> None:
    straight = (STATE - STATE.mean())[:, None] / np.linalg.norm(STATE - STATE.mean())
    made = field(40.0 * straight[:, 0] + RNG.standard_normal(len(STATE)), straight)
    assert spline(made, np.ones(len(STATE)), (STATE,), (16,)).gain < 60.0


def test_the_gain_of_the_curve_itself_is_its_own() -> None:
    found = spline(field(4.0 * STATE**2 + RNG.standard_normal(len(STATE))), np.ones(len(STATE)), (STATE,), (12,))
    gain, strength = found.gain_of(found.curve()[None])
    assert gain[0] == pytest.approx(found.gain, rel=1e-3) and strength[0] == pytest.approx(1.0, rel=1e-3)
