"""Effects on friction against their equations, driven with constant or stepped states."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from slipwise.model import Model, base_model, use
from slipwise.simulation.predict import PadForces, Predictor, predictor

LOAD = 24.5e3
DT = 0.002


@cache
def base() -> Model:
    return base_model("bridge1")


def drive(
    law: Model | Predictor, speed: np.ndarray | float, load: np.ndarray | float = LOAD, slip: np.ndarray | float = 0.0,
    across: np.ndarray | float = 0.0, count: int = 1,
) -> PadForces:  # fmt: skip
    """All pads alike, along x at a speed (n,), for as many samples as the longest argument has."""
    n = max(count, *(np.size(a) for a in (speed, load, slip, across)))
    velocity, place = np.zeros((n, 4, 2)), np.zeros((n, 4, 2))
    velocity[:, :, 0] = np.reshape(speed, (-1, 1))
    velocity[:, :, 1] = np.reshape(across, (-1, 1))
    place[:, :, 0] = np.reshape(slip, (-1, 1))
    loads = np.array(np.broadcast_to(np.reshape(load, (-1, 1)), (n, 4)))
    laws = law if isinstance(law, Predictor) else predictor(law)
    time = DT * np.arange(n) if n > 1 else np.array([0.0, DT])
    if n == 1:
        velocity, place, loads = (np.concatenate([a, a]) for a in (velocity, place, loads))
    return laws.pads(time, loads, velocity, place)


def coefficient(law: Model, speed: float, **states: float) -> float:
    return float(drive(law, speed, **states).force[0, 0, 0] / states.get("load", LOAD))


def test_breakaway_adds_its_share_of_the_load_at_low_speed_only() -> None:
    law = base().adding(use("breakaway", rise=0.05, decay=0.01))
    for speed in (1e-9, 2e-3, 0.01, 0.02):
        extra = coefficient(law, speed) - coefficient(base(), speed)
        assert extra == pytest.approx(0.05 * np.exp(-((speed / 0.01) ** 2)), rel=1e-9)
    assert coefficient(law, 0.1) == coefficient(base(), 0.1)
    exponential = base().adding(use("breakaway", rise=0.05, decay=0.01, shape=1.0))
    extra = coefficient(exponential, 0.01) - coefficient(base(), 0.01)
    assert extra == pytest.approx(0.05 * np.exp(-1.0), rel=1e-9)


def test_a_rested_contact_breaks_away_higher_up_to_an_end() -> None:
    law = predictor(base().adding(use("breakaway", rise=0.05, ageing=0.8, time=2.0)))
    fresh = drive(law, 1e-9).force[0, 0, 0]
    for rest, grown in ((1.0, 1.0 - np.exp(-0.5)), (1e6, 1.0)):
        law.reset()
        law.rest(rest)
        aged = drive(law, 1e-9).force[0, 0, 0]
        assert (aged - fresh) / LOAD == pytest.approx(0.05 * 0.8 * grown, rel=1e-6)


def test_slip_uses_the_age_of_a_contact_up() -> None:
    """dz/dt = (1 - z)/t_r - V z/L, from rest, sliding at 1 mm/s."""
    law = predictor(base().adding(use("breakaway", ageing=0.1, decay=0.05, shape=1.0, time=0.2, length=1e-4)))
    law.rest(100.0)
    without = drive(base(), 1e-3, count=100).force[:, 0, 0]
    extra = (drive(law, 1e-3, count=100).force[:, 0, 0] - without) / LOAD / (0.05 * np.exp(-1e-3 / 0.05))
    time = DT * np.arange(100)
    exact = solve_ivp(
        lambda t, z: (1.0 - z) / 0.2 - 1e-3 * z / 1e-4, (0.0, time[-1]), [1.0], "DOP853", time, rtol=1e-12
    )
    np.testing.assert_allclose((extra - 1.0) / 0.1, exact.y[0], rtol=1e-6)


@pytest.mark.parametrize("tail", [0.0, 0.5, 1.0])
def test_run_in_settles_with_the_distance_and_not_with_time(tail: float) -> None:
    model = base().adding(use("run_in", rise=0.3, distance=0.05, tail=tail))
    for speed in (0.05, 0.5):
        law = predictor(model)
        ratio = drive(law, speed, count=200).force[:, 0, 0] / drive(base(), speed).force[0, 0, 0]
        slid = speed * DT * np.arange(200)
        left = np.exp(-slid / 0.05) if tail == 0.0 else (1.0 + tail * slid / 0.05) ** (-1.0 / tail)
        np.testing.assert_allclose(ratio, 1.0 + 0.3 * left, rtol=1e-9)
        law.rest(86400.0)
        after = drive(law, speed).force[0, 0, 0] / drive(base(), speed).force[0, 0, 0]
        assert after == pytest.approx(ratio[-1], rel=1e-12), "a pause does not undo it"


def test_steady_sliding_of_rate_and_state_is_a_line_over_the_logarithm_of_speed() -> None:
    law = base().adding(use("rate_and_state", direct=0.012, state=0.005, length=20e-6))
    for speed in (0.01, 0.1, 0.3):
        force = drive(law, speed, count=3000).force[-1, 0, 0] - drive(base(), speed).force[0, 0, 0]
        exact = 0.012 * np.log((speed + 1e-4) / 0.1) - 0.005 * np.log(speed / 0.1)
        assert force / LOAD == pytest.approx(exact, abs=1e-9)


def test_a_jump_of_speed_acts_at_once_and_is_then_taken_back_over_the_contact_length() -> None:
    law = base().adding(use("rate_and_state", direct=0.01, state=0.015, length=1e-3))
    speed = np.concatenate([np.full(2000, 0.02), np.full(300, 0.1)])
    both = drive(law, speed).force[:, 0, 0] - drive(base(), speed).force[:, 0, 0]
    extra = both[2000:] / LOAD
    time = DT * np.arange(300)

    def theta_at(speed: float, end: float, start: float, at: np.ndarray) -> np.ndarray:
        found = solve_ivp(
            lambda t, s: 1.0 - speed * s / 1e-3, (0.0, end), [start], "DOP853", at, rtol=1e-13, atol=1e-16
        )
        return found.y[0]

    jumped = theta_at(0.06, DT, 1e-3 / 0.02, np.array([DT]))[0]  # between two samples the speed is their mean
    theta = theta_at(0.1, time[-1], jumped, time)
    exact = 0.01 * np.log((0.1 + 1e-4) / 0.1) + 0.015 * np.log(0.1 * theta / 1e-3)
    np.testing.assert_allclose(extra, exact, atol=1e-8)


def test_the_slip_law_forgets_a_jump_over_the_contact_length_and_does_not_age_at_rest() -> None:
    law = base().adding(use("rate_and_state", direct=0.01, state=0.015, length=1e-3, slip=1.0))
    speed = np.concatenate([np.full(2000, 0.02), np.zeros(500), np.full(300, 0.1)])
    both = drive(law, speed).force[:, 0, 0] - drive(base(), speed).force[:, 0, 0]
    slid = 0.1 * DT * np.arange(300)
    left = np.log(0.1 / 0.02)
    for mean in (0.01, 0.05):  # between two samples the speed is their mean
        left = np.log(0.1 / mean) + (left - np.log(0.1 / mean)) * np.exp(-mean * DT / 1e-3)
    left = left * np.exp(-slid / 1e-3)
    exact = 0.01 * np.log((0.1 + 1e-4) / 0.1) + 0.015 * left
    np.testing.assert_allclose(both[2500:] / LOAD, exact, atol=1e-8)


def test_the_pressure_law_touches_published_ones_about_the_rated_pressure() -> None:
    """0.7^((P - P_0)/50 MPa) of Kumar et al. (2015): within 0.3 % from 10 to 25 MPa."""
    law = base().adding(use("pressure_law", slope=-0.1204, bend=-0.0602))
    area = base().specimen.pad_area
    for pressure in (10e6, 14e6, 16.882e6, 20e6, 25e6):
        ratio = coefficient(law, 0.3, load=pressure * area) / coefficient(base(), 0.3, load=pressure * area)
        assert ratio == pytest.approx(0.7 ** ((pressure - 16.882e6) / 50e6), rel=3e-3)
    power = base().adding(use("pressure_law", slope=-1.0 / 3.0))
    ratio = coefficient(power, 0.3, load=2 * 16.882e6 * area) / coefficient(base(), 0.3, load=2 * 16.882e6 * area)
    assert ratio == pytest.approx(2.0 ** (-1.0 / 3.0), rel=1e-12), "mu ~ N^(-1/3) on top of the law at hand"


def test_asymmetry_turns_with_the_direction_and_leaves_the_mean() -> None:
    law = base().adding(use("direction_asymmetry", difference=0.05))
    forth, back = coefficient(law, 0.2), coefficient(law, -0.2)
    assert forth / -back == pytest.approx(1.05 / 0.95, rel=1e-12)
    assert 0.5 * (forth - back) == pytest.approx(coefficient(base(), 0.2), rel=1e-12)


def test_anisotropy_bends_friction_out_of_the_motion() -> None:
    law = base().adding(use("anisotropy", ratio=1.2))
    force, plain = (drive(m, 0.2, across=0.15).force[0, 0] for m in (law, base()))
    assert force[0] == plain[0] and force[1] == pytest.approx(1.2 * plain[1], rel=1e-12)
    assert drive(law, 0.2).force[0, 0, 1] == 0.0


def test_a_patch_acts_at_its_place_on_its_pad() -> None:
    law = base().adding(use("position_patch", pad_a=0.0, pad_c=0.4, place=0.01, width=0.005))
    slip = np.array([-0.01, 0.0, 0.005, 0.01, 0.015, 0.03])
    ratio = drive(law, 0.1, slip=slip).bound / drive(base(), 0.1, slip=slip).bound
    np.testing.assert_allclose(ratio[:, 2], 1.0 + 0.4 * np.exp(-(((slip - 0.01) / 0.005) ** 2)), rtol=1e-12)
    assert np.all(ratio[:, [0, 1, 3]] == 1.0)


def test_every_pad_can_be_given_its_own_patch() -> None:
    for i, name in enumerate(("pad_a", "pad_b", "pad_c", "pad_d")):
        off = dict.fromkeys(("pad_a", "pad_b", "pad_c", "pad_d"), 0.0) | {name: 0.5, "place": 0.0}
        ratio = drive(base().adding(use("position_patch", **off)), 0.1).bound / drive(base(), 0.1).bound
        np.testing.assert_allclose(ratio[0], 1.0 + 0.5 * (np.arange(4) == i), rtol=1e-12)


def test_a_spread_of_pads_leaves_their_sum() -> None:
    law = base().adding(use("pad_spread", along=0.05, across=-0.02, diagonal=0.01))
    ours, plain = drive(law, 0.2).force[0, :, 0], drive(base(), 0.2).force[0, :, 0]
    assert ours.sum() == pytest.approx(plain.sum(), rel=1e-12)
    np.testing.assert_allclose(ours / plain, [1.04, 0.92, 1.06, 0.98], rtol=1e-12)


def test_tilt_and_curvature_follow_the_load_and_not_the_direction() -> None:
    tilt = base().adding(use("slide_tilt", tilt=0.004))
    bowl = base().adding(use("slide_curvature", curvature=0.1))
    for speed in (0.2, -0.2):
        for load in (10e3, 30e3):
            plain = drive(base(), speed, load=load, slip=0.02).force[0, 0, 0]
            assert drive(tilt, speed, load=load).force[0, 0, 0] - plain == pytest.approx(0.004 * load, rel=1e-9)
            slope, mu = 0.1 * 0.02 / np.sqrt(1.0 - (0.1 * 0.02) ** 2), plain / load
            curved = drive(bowl, speed, load=load, slip=0.02).force[0, 0, 0]
            assert curved == pytest.approx(load * (slope + mu) / (1.0 - mu * slope), rel=2e-4)
            assert curved - plain == pytest.approx(0.1 * 0.02 * load, rel=2e-2)
