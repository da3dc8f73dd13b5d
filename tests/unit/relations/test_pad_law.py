"""Pads' forces as a logger writes them."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.signal import butter, lsim

from slipwise.relations.evaluation_times import Instants
from slipwise.relations.pad_law import compute_stick_share, estimate_lost_velocity, log_force, sum_forces_along
from slipwise.relations.run_data import FINE, interpolate_finely
from slipwise.signals.filters import LowPass, align, lowpass
from slipwise.simulation.predict import PadForces


@dataclass(frozen=True)
class _Run:
    time: np.ndarray
    dt: float
    filtered: LowPass | None
    fine: int = FINE


def _run(by: LowPass | None) -> _Run:
    return _Run(np.arange(2001) * 0.002, 0.002, by)


def test_a_force_without_kinks_is_filtered_as_the_logger_filters() -> None:
    run = _run(LowPass(60.0))
    fine = np.linspace(run.time[0], run.time[-1], FINE * (len(run.time) - 1) + 1)
    force = np.sin(2.0 * np.pi * 40.0 * fine)[:, None]
    logged = log_force(force, run, None, averaged=False)[:, 0]  # type: ignore[arg-type]
    gain = 1.0 / (1.0 + (40.0 / 60.0) ** 8)
    inside = slice(200, -200)
    assert np.sqrt(2.0) * np.std(logged[inside]) == pytest.approx(gain, rel=1e-3)


def test_a_reversal_between_two_samples_is_timed_to_a_fraction_of_a_sample() -> None:
    run = _run(LowPass(80.0))
    fine = np.linspace(run.time[0], run.time[-1], FINE * (len(run.time) - 1) + 1)
    half = run.dt / FINE / 2.0
    turn = 2.0003
    share = np.clip((fine - turn) / half, -1.0, 1.0)  # mean of the sign over each instant
    logged = log_force(share[:, None], run, None, averaged=True)[:, 0]  # type: ignore[arg-type]
    near = np.abs(run.time - turn) < 0.006
    crossing = np.interp(0.0, logged[near], run.time[near])
    assert crossing == pytest.approx(turn, abs=2e-5)


@pytest.mark.parametrize("order", [2, 4])
@pytest.mark.parametrize("fine", [FINE, 2 * FINE])
def test_what_the_samples_of_a_causal_filter_fold_is_predicted(order: int, fine: int) -> None:
    """Friction of 1 turns round behind 150 Hz, 500 samples a second: without the folding it was 0.15 and 0.03 off."""
    once, dt, parts = LowPass(150.0, order, "causal"), 0.002, 48
    time = np.arange(0.0, 2.0, dt / parts)
    force = np.where((time > 0.7003) & (time < 1.2011), 1.0, -1.0)
    logged = np.asarray(lsim(butter(order, 2.0 * np.pi * 150.0, analog=True), force + 1.0, time)[1])[::parts] - 1.0
    measured, by = align(logged, dt, once)
    step = parts // fine
    around = np.concatenate([np.full(step // 2, -1.0), force])[: step * (fine * (len(logged) - 1) + 1)]
    mean = around.reshape(-1, step).mean(axis=1)
    found = log_force(mean[:, None], _Run(time[::parts], dt, by, fine), None, averaged=True)[:, 0]  # type: ignore[arg-type]
    np.testing.assert_allclose(found[100:-100], measured[100:-100], atol=0.025)


def test_most_of_a_kink_that_the_filter_took_from_the_velocity_is_given_back() -> None:
    by, mass = LowPass(80.0), 1e4
    run = _run(by)
    fine = np.linspace(run.time[0], run.time[-1], FINE * (len(run.time) - 1) + 1)
    force = 5e3 * np.sign(fine - 2.0)
    sharp = -5e3 * np.abs(fine - 2.0) / mass
    seen = lowpass(sharp, run.dt / FINE, by)[::FINE]
    sharp = sharp[::FINE]
    by_pad = estimate_lost_velocity(force[:, None], run, np.array([[1.0 / mass]]), None)  # type: ignore[arg-type]
    given_back = seen + by_pad[::FINE, 0]
    near = np.abs(run.time - 2.0) < 0.02
    assert np.abs(given_back - sharp)[near].max() < np.abs(seen - sharp)[near].max() / 3.0


def test_a_force_on_one_side_kicks_the_other_by_what_the_girder_turns() -> None:
    run = _run(LowPass(80.0))
    fine = np.linspace(run.time[0], run.time[-1], FINE * (len(run.time) - 1) + 1)
    force = np.stack([5e3 * np.sign(fine - 2.0), np.zeros_like(fine)], axis=1)
    compliance = 1e-4 + 2.5**2 / 3e4 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    lost = estimate_lost_velocity(force, run, compliance, None)  # type: ignore[arg-type]
    np.testing.assert_allclose(lost[:, 1], lost[:, 0] * compliance[1, 0] / compliance[0, 0], atol=1e-12)
    assert np.abs(lost[:, 0]).max() > 1e-3, "it must be seen at all"


def test_instants_pass_through_the_samples_and_reproduce_a_cubic() -> None:
    place = np.arange(50.0)
    values = 0.01 * place**3 - place
    fine = interpolate_finely(values, FINE)
    assert np.array_equal(fine[::FINE], values)
    between = np.linspace(0.0, 49.0, FINE * 49 + 1)
    assert np.allclose(fine[FINE:-FINE], (0.01 * between**3 - between)[FINE:-FINE])


def _share(speed: np.ndarray, length: float, damping: float) -> np.ndarray:
    velocity = np.zeros((len(speed), 1, 2))
    velocity[:, 0, 0] = speed
    state = Instants(1e-3 * np.arange(len(speed)), np.ones((len(speed), 1)), velocity, np.zeros_like(velocity))
    return compute_stick_share(state, length, damping)[:, 0]


def test_a_spring_turns_friction_round_over_a_slip_and_a_damper_at_once() -> None:
    """From rest at 1 mm/s: 10 um fill in 10 ms; a damper that leads by 4 ms is there 4 um earlier, 6 ms long."""
    speed = np.where(np.arange(40) >= 10, 1e-3, 0.0)
    spring, damped = _share(speed, 1e-5, 0.0), _share(speed, 1e-5, 4e-3)
    since = np.arange(40)[12:] - 9.5  # ms of slip, the velocity rising between two instants
    np.testing.assert_allclose(spring[12:], np.minimum(0.1 * since, 1.0), atol=0.03)
    np.testing.assert_allclose(damped[12:], np.minimum(0.1 * since + 0.4, 1.0), atol=0.03)
    assert np.all(spring[:9] == 0.0) and np.all(damped[:9] == 0.0)


def test_a_share_of_the_bound_acts_in_the_place_of_a_sharp_turn_along_x_alone() -> None:
    """Friction of 10 N with 1 N of tilt: at rest 1 N and the share, along the diagonal the share of its cosine."""
    velocity = np.array([[[0.0, 0.0]], [[-0.2, 0.0]], [[0.3, 0.3]]])
    speed = np.maximum(np.hypot(*velocity[:, 0].T), 1e-12)
    bound = np.full((3, 1), 10.0)
    force = 10.0 * velocity / speed[:, None, None]
    force[:, :, 0] += 1.0
    state = Instants(1e-3 * np.arange(3), np.ones((3, 1)), velocity, np.zeros_like(velocity))
    share = np.array([[0.4], [-0.9], [0.5]])
    along = sum_forces_along(PadForces(force, bound), state, share)[:, 0]
    np.testing.assert_allclose(along, [5.0, -8.0, 1.0 + 5.0 / np.sqrt(2.0)])
    np.testing.assert_allclose(sum_forces_along(PadForces(force, bound), state, None), force[:, :, 0])
