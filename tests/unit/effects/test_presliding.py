"""The bristle against closed forms of Dahl's law and of elastic-plastic slip."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from slipwise.model import base_model, use
from slipwise.simulation.predict import predictor

LOAD = 24.5e3
U = 0.3e-3


def _share(
    slip_x: np.ndarray, exponent: float = 1.0, slip_y: np.ndarray | None = None, spectrum: float = 0.0
) -> np.ndarray:
    """Drive pad A along a path of slip at constant load without speed term; force over bound, (n, 2)."""
    model = base_model("bridge1", [use("presliding", length=U, exponent=exponent, spectrum=spectrum)])
    time = 0.002 * np.arange(len(slip_x))
    slip = np.zeros((len(time), 4, 2))
    slip[:, :, 0] = slip_x[:, None]
    slip[:, :, 1] = (np.zeros_like(slip_x) if slip_y is None else slip_y)[:, None]
    forces = predictor(model).pads(time, np.full((len(time), 4), LOAD), np.gradient(slip, time, axis=0), slip)
    return forces.force[:, 0] / forces.bound[:, :1]


def test_the_first_slip_follows_dahls_exponential() -> None:
    slip = np.linspace(0.0, 5 * U, 200)
    np.testing.assert_allclose(_share(slip)[:, 0], 1.0 - np.exp(-slip / U), rtol=1e-9, atol=1e-12)


def test_after_a_reversal_friction_turns_round_over_a_distance_not_a_time() -> None:
    """F/F_b = 2 exp(-s/u) - 1 from full friction, however the way back is sampled."""
    way = np.concatenate([np.linspace(0.0, 40 * U, 50), 40 * U - np.geomspace(1e-3 * U, 8 * U, 31)])
    back = 40 * U - way[50:]
    np.testing.assert_allclose(_share(way)[50:, 0], 2.0 * np.exp(-back / U) - 1.0, atol=1e-9)


def test_with_exponent_zero_it_is_a_spring_that_slips() -> None:
    amplitude, n = 4 * U, 4000
    slip = amplitude * np.sin(np.linspace(0.0, 4 * np.pi, n))
    share = _share(slip, 0.0)[:, 0]
    np.testing.assert_allclose(
        share[slip.argmax() + 1], share[slip.argmax()] - (slip.max() - slip[slip.argmax() + 1]) / U
    )
    assert np.abs(share).max() == pytest.approx(1.0, abs=1e-12)
    half = slice(n // 2, n)
    work = np.sum(0.5 * (share[half][1:] + share[half][:-1]) * np.diff(slip[half]))
    assert work == pytest.approx(4.0 * (amplitude - U), rel=1e-3), "area of a parallelogram 4 F_b (X - u)"


@pytest.mark.parametrize("exponent", [0.3, 0.5, 0.9])
def test_between_them_the_exact_step_agrees_with_a_differential_equation(exponent: float) -> None:
    slip = np.concatenate([np.linspace(0.0, 1.2 * U, 7), np.linspace(1.2 * U, -0.7 * U, 9)[1:]])
    z = 0.0
    exact = [0.0]
    for step in np.diff(slip):
        sign = np.sign(step)
        found = solve_ivp(
            lambda s, z, sign=sign: sign * max(1.0 - sign * z[0] / U, 0.0) ** exponent, (0.0, abs(step)), [z],
            rtol=1e-10, atol=1e-13,
        )  # fmt: skip
        z = found.y[0, -1]
        exact.append(z / U)
    np.testing.assert_allclose(_share(slip, exponent)[:, 0], exact, atol=1e-6)


def test_an_even_spectrum_is_iwans_parabola_and_follows_masings_rule() -> None:
    """First loading F/F_b = s/u - (s/2u)^2 up to 2u; a branch after a reversal is twice as large in both directions."""
    s = np.linspace(0.0, 1.5 * U, 301)
    first = _share(s, 0.0, spectrum=1.0)[:, 0]
    np.testing.assert_allclose(first, s / U - (s / (2 * U)) ** 2, atol=0.005)
    path = np.concatenate([s, s[-1] - 2.0 * s[1:]])
    back = _share(path, 0.0, spectrum=1.0)[len(s) :, 0]
    np.testing.assert_allclose(back, first[-1] - 2.0 * first[1:], atol=1e-9)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0])
def test_friction_never_exceeds_its_circle_and_ends_up_along_the_motion(exponent: float) -> None:
    angle = np.linspace(0.0, 2.0, 400)
    radius = 30 * U
    share = _share(radius * np.sin(angle), exponent, radius * (1.0 - np.cos(angle)))
    assert np.hypot(*share.T).max() <= 1.0 + 1e-12
    across = share[-1] - share[-1] @ [np.cos(2.0), np.sin(2.0)] * np.array([np.cos(2.0), np.sin(2.0)])
    assert share[-1] @ [np.cos(2.0), np.sin(2.0)] > 0.99 and np.hypot(*across) < 0.1


def test_a_closed_path_always_costs_work() -> None:
    rng = np.random.default_rng(5)
    for exponent in (0.0, 0.4, 1.0):
        steps = rng.normal(0.0, U, (500, 2))
        path = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
        path = np.concatenate([path, np.linspace(path[-1], [0.0, 0.0], 50)[1:]])
        share = _share(path[:, 0], exponent, path[:, 1])
        assert np.sum(share[1:] * np.diff(path, axis=0)) > 0.0


def test_a_new_run_goes_on_with_the_bent_bristle_wherever_its_gauge_stands() -> None:
    model = base_model("bridge1", [use("presliding", length=U)])
    law = predictor(model)
    time, load, still = 0.002 * np.arange(40), np.full((40, 4), LOAD), np.zeros((40, 4, 2))
    slip = still.copy()
    slip[:, :, 0] = np.linspace(0.0, 5 * U, 40)[:, None]
    end = law.pads(time, load, still, slip).force[-1]
    np.testing.assert_allclose(law.pads(time, load, still, still - 0.01).force, np.tile(end, (40, 1, 1)), rtol=1e-12)


def test_a_gauge_that_does_not_start_at_zero_bends_no_bristle() -> None:
    assert np.all(_share(np.full(5, 0.01)) == 0.0)
    shifted = _share(0.01 + np.linspace(0.0, U, 20))
    np.testing.assert_allclose(shifted, _share(np.linspace(0.0, U, 20)), atol=1e-12)


@pytest.mark.parametrize("load", [6e3, 24.5e3])
def test_a_spring_in_series_is_as_stiff_under_any_load(load: float) -> None:
    """q = 1: dF/dx = F_0 / u_0 from the first step on, however much friction there is."""
    model = base_model("bridge1", [use("presliding", length=U, exponent=0.0, growth=1.0)])
    slip = np.zeros((20, 4, 2))
    slip[:, :, 0] = np.linspace(0.0, 0.1 * U, 20)[:, None]
    found = predictor(model).pads(0.002 * np.arange(20), np.full((20, 4), load), np.gradient(slip, 0.002, axis=0), slip)
    np.testing.assert_allclose(found.force[:, 0, 0], 2770.0 * slip[:, 0, 0] / U, rtol=1e-9)


def test_a_damped_bristle_pushes_back_while_it_bends_and_no_longer() -> None:
    """F/F_b = (z + t_d dz/dt)/u, never more than one."""
    model = base_model("bridge1", [use("presliding", length=U, exponent=0.0, damping=4e-3)])
    time = 0.002 * np.arange(60)
    slip = np.zeros((60, 4, 2))
    slip[:, :, 0] = (0.05 * U * np.arange(60))[:, None]
    found = predictor(model).pads(time, np.full((60, 4), LOAD), np.gradient(slip, time, axis=0), slip)
    share = (found.force[:, 0] / found.bound[:, :1])[:, 0]
    bending = slip[1:, 0, 0] < 0.85 * U
    np.testing.assert_allclose(share[1:][bending], slip[1:, 0, 0][bending] / U + 4e-3 * 0.05 / 0.002, rtol=1e-9)
    assert share[-1] == pytest.approx(1.0, abs=1e-12) and share.max() <= 1.0 + 1e-12


def test_a_contact_that_slips_has_its_whole_friction_while_that_falls() -> None:
    """A damper that followed the shrinking bristle took a third of the friction just before a reversal."""
    model = base_model("bridge1", [use("presliding", length=U, exponent=0.0, growth=1.0, damping=2e-3)])
    time = 0.0005 * np.arange(200)
    slip = np.zeros((200, 4, 2))
    slip[:, :, 0] = (10.0 * U * time / time[-1])[:, None]
    load = np.linspace(LOAD, 0.4 * LOAD, 200)[:, None] * np.ones((1, 4))
    found = predictor(model).pads(time, load, np.gradient(slip, time, axis=0), slip)
    share = (found.force[:, 0] / found.bound[:, :1])[:, 0]
    np.testing.assert_allclose(share[slip[:, 0, 0] > 2.0 * U], 1.0, rtol=1e-12)


@pytest.mark.parametrize("spectrum", [0.0, 0.8])
@pytest.mark.parametrize("share", [(0.4, 0.0), (-1.0, 0.0), (1.2, 0.9)])
def test_a_record_may_begin_with_a_bristle_that_is_bent_already(share: tuple[float, float], spectrum: float) -> None:
    law = predictor(base_model("bridge1", [use("presliding", length=U, growth=0.5, spectrum=spectrum)]))
    still, load = np.zeros((4, 2)), np.full(4, 0.2 * LOAD)
    time, path = 0.002 * np.arange(2), np.zeros((2, 4, 2))
    bound = law.pads(time, np.stack([load, load]), path, path).bound[0]
    law.begin(load, still, still, np.asarray(share) * bound[:, None])
    bent = law.pads(time, np.stack([load, load]), path, path)
    length = max(np.hypot(*share), 1.0)
    np.testing.assert_allclose(bent.force[0] / bound[:, None], np.tile(share, (4, 1)) / length, atol=1e-12)
