"""Slip velocity from slip gauge and two accelerometers: within 0.3 mm/s, where differentiating errs far more."""

import numpy as np
import pytest

from slipwise.campaign import measured_states
from slipwise.errors import InputError
from slipwise.signals.fused import fuse, fuse_scaled
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

#: Root of the mean square of the error that is allowed [m/s].
ALLOWED = 3e-4


@pytest.fixture(scope="module", params=["bridge1", "bridge2"])
def made(request):
    return build_campaign(31, effects=(), rig=request.param)


@pytest.mark.slow
def test_slip_velocity_of_a_campaign_is_right_within_a_third_of_a_millimetre_a_second(made):
    campaign = as_campaign(made)
    for run in campaign.runs:
        states = measured_states(run, campaign)
        true = made.at_samples(run.name)["slip_vx"][: len(states.time)]
        error = (states.velocity[:, 0] - true)[states.valid]
        assert np.sqrt(np.mean(error**2)) < ALLOWED
        assert np.sqrt(np.mean((np.gradient(run.record["slip_x"], run.record.dt) - true) ** 2)) > 10.0 * ALLOWED


def test_the_smoother_knows_its_own_error(made):
    campaign = as_campaign(made)
    states = measured_states(campaign.runs[0], campaign)
    error = states.velocity[:, 0] - made.at_samples("sine_hv")["slip_vx"]
    moving = states.valid & (states.velocity[:, 0] != 0.0)
    assert np.std(error[moving]) == pytest.approx(states.velocity_error[0], rel=0.15)


def test_a_girder_at_rest_does_not_wear_its_contacts_out(made):
    """Noise of 0.15 mm/s adds up to an eighth of a millimetre in a second; what leads into a slip is slip."""
    campaign = as_campaign(made)
    for run in campaign.runs:
        states = measured_states(run, campaign)
        true = np.abs(made.at_samples(run.name)["slip_vx"][: len(states.time)])
        at_rest = np.flatnonzero(true > 2e-3)[0]  # until the first slip
        worn = np.sum(np.abs(states.velocity[:at_rest, 0])) * states.dt
        assert worn < np.sum(true[:at_rest]) * states.dt + 20e-6


def sine(noise: float, count: int = 4000, seed: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Give time, noisy position, true velocity and true acceleration of 10 mm at 1.5 Hz."""
    time = 0.002 * np.arange(count)
    turn = 2.0 * np.pi * 1.5
    position = 0.01 * np.sin(turn * time) + noise * np.random.default_rng(seed).standard_normal(count)
    return time, position, 0.01 * turn * np.cos(turn * time), -0.01 * turn**2 * np.sin(turn * time)


def test_a_biased_accelerometer_does_not_bias_the_velocity():
    time, position, velocity, acceleration = sine(2e-5)
    noisy = acceleration + 0.036 * np.random.default_rng(2).standard_normal(len(time)) + 0.15
    fused = fuse(time, position, noisy)
    assert np.std(fused.velocity - velocity) < ALLOWED
    assert abs(np.mean(fused.velocity - velocity)) < 0.2 * ALLOWED
    assert np.median(fused.bias) == pytest.approx(0.15, abs=0.02)


def test_a_slip_gauge_alone_gives_a_velocity_too():
    time, position, velocity, _ = sine(1e-5)
    assert np.std((fuse(time, position).velocity - velocity)[20:-20]) < 0.02 * np.std(velocity)


def test_missing_samples_of_the_gauge_are_bridged():
    time, position, velocity, acceleration = sine(2e-5)
    position[1000:1040] = np.nan
    fused = fuse(time, position, acceleration + 0.03 * np.random.default_rng(3).standard_normal(len(time)))
    assert np.max(np.abs(fused.velocity - velocity)[1000:1040]) < 10.0 * ALLOWED


@pytest.mark.parametrize(
    ("count", "gap", "message"), [(6, None, "too few"), (400, 17, "cannot be integrated")], ids=["short", "gap"]
)
def test_what_cannot_be_fused_is_refused(count, gap, message):
    time, position, _, acceleration = sine(1e-5, count)
    if gap is not None:
        acceleration[gap] = np.nan
    with pytest.raises(InputError, match=message):
        fuse(time, position, acceleration)


def test_a_speed_that_an_actuator_changes_at_once_is_followed_at_once():
    rng = np.random.default_rng(5)
    time = 0.01 * np.arange(3000)
    speed = np.where(time < 15.0, 1e-3, 3e-3)
    slip = np.cumsum(speed) * 0.01 + 2e-5 * rng.standard_normal(len(time))
    found = fuse_scaled(time, slip, None, 30.0, 0.6)
    near = np.abs(time - 15.0) < 0.3
    assert np.count_nonzero(np.abs(found.velocity - speed)[near] > 2e-4) <= 3
    assert np.abs(found.velocity - speed)[~near].max() < 1e-4


@pytest.mark.parametrize("accelerated", [False, True])
@pytest.mark.parametrize("size", [0.0, 1e-13])
def test_a_gauge_that_never_moves_gives_no_motion(accelerated, size):
    """A simulation's motion across is zero, or what is left of zero."""
    time = np.arange(2000) * 2e-3
    still = size * np.random.default_rng(0).normal(size=2000)
    found = fuse(time, still, 0.0 * still if accelerated else None, levels=(1e-16, 1e-12) if accelerated else None)
    assert np.abs(found.velocity).max() < 1e-8


def test_a_gauge_that_is_smoothed_alone_knows_how_far_off_a_place_is():
    time, position, _, _ = sine(2e-5)
    found = fuse(time, position)
    true = 0.01 * np.sin(2.0 * np.pi * 1.5 * time)
    assert found.position_error == pytest.approx(np.std((found.position - true)[50:-50]), rel=0.25)
    assert fuse_scaled(time, position, None, 1.0, 1.0).position_error == pytest.approx(found.position_error, rel=0.1)
