"""A slider behind a machine that gives way, and behind play, against what can be said by hand."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.errors import SettingError
from slipwise.model import Model, base_model, use
from slipwise.simulation.predict import predictor

LOAD, MU = 10e3, 0.1


def coulomb(*uses: object) -> Model:
    model = base_model("pad", ())
    strength = MU * model.specimen.plastic_pressure
    return replace(model, specimen=replace(model.specimen, shear_strength=strength)).adding(*uses)


def drawn(model: Model, speed: np.ndarray, dt: float = 1e-3, across: float = 0.0) -> np.ndarray:
    """Give the force (n, 2) of a slider whose gauge moves at a speed (n,) along x, and that times `across` along y."""
    velocity = np.stack([speed, across * speed], axis=1)[:, None]
    slip = np.cumsum(velocity, axis=0) * dt
    load = np.full((len(speed), 1), LOAD)
    return predictor(model).pads(dt * np.arange(len(speed)), load, velocity, slip).force[:, 0]


def test_force_rises_along_the_machines_spring_until_the_contact_slides():
    compliance, speed = 1e-6, 0.01
    force = drawn(coulomb(use("machine_compliance", compliance=compliance)), np.full(300, speed))[:, 0]
    way = speed * 1e-3 * np.arange(300)
    np.testing.assert_allclose(
        force, np.minimum(way / compliance, MU * LOAD), atol=1e-6 * MU * LOAD + speed * 1e-3 / compliance
    )
    assert force[-1] == pytest.approx(MU * LOAD)


def test_after_a_reversal_play_is_crossed_at_hardly_any_force():
    play, push = 4e-3, 0.01
    speed = np.concatenate([np.full(1000, 0.01), np.full(1000, -0.01)])
    force = drawn(coulomb(use("backlash", play=play, push=push)), speed)[:, 0]
    crossing = np.abs(force[1000:]) <= push * LOAD * (1.0 + 1e-9)
    assert np.count_nonzero(crossing) * 1e-5 == pytest.approx(play, rel=0.02)
    assert force[999] == pytest.approx(MU * LOAD) and force[-1] == pytest.approx(-MU * LOAD)


def test_play_and_machine_stand_in_series():
    both = coulomb(use("backlash", play=2e-3, push=0.01), use("machine_compliance", compliance=1e-6))
    speed = np.concatenate([np.full(1000, 0.01), np.full(1000, -0.01)])
    force = drawn(both, speed)[:, 0]
    reversed_at = int(np.argmax(force[1000:] <= -MU * LOAD * (1.0 - 1e-9)))
    assert 1e-5 * reversed_at == pytest.approx(2e-3 + 2.0 * MU * LOAD * 1e-6, rel=0.02)


def test_the_machine_gives_way_along_the_motion_whatever_its_direction():
    model = coulomb(use("machine_compliance", compliance=1e-6))
    along = drawn(model, np.full(300, 0.01))
    slanted = drawn(model, np.full(300, 0.01) / np.sqrt(1.0 + 0.75**2), across=0.75)
    np.testing.assert_allclose(np.hypot(*slanted.T), along[:, 0], rtol=1e-9)
    np.testing.assert_allclose(slanted[1:, 1], 0.75 * slanted[1:, 0], rtol=1e-9)


def test_a_step_of_speed_relaxes_as_spring_and_slider_do():
    """Direct effect only: dF/dt = k (v - v_c), F = F_0 + a N ln(v_c / v_0): an exponential near the steady force."""
    a, compliance, speed = 0.01, 2e-7, 0.1
    effect = use("rate_and_state", direct=a, state=0.0, length=1e-5, slip=0.0, cutoff=1e-6)
    model = coulomb(use("machine_compliance", compliance=compliance), effect)
    steps = np.concatenate([np.full(4000, speed), np.full(4000, 1.02 * speed)])
    force = drawn(model, steps, dt=2e-6)[:, 0]
    rate = speed / (a * LOAD * compliance)
    time = 2e-6 * np.arange(1, 4001)
    expected = force[3999] + a * LOAD * np.log(1.02) * (1.0 - np.exp(-1.02 * rate * time))
    np.testing.assert_allclose(force[4000:], expected, atol=0.02 * a * LOAD * np.log(1.02))


def test_a_stick_beside_a_loading_train_is_refused():
    with pytest.raises(SettingError, match="none beside a loading train"):
        coulomb(use("presliding"), use("machine_compliance"))
