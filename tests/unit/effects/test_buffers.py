"""Effects on the buffers against their equations and the area of their loops."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from shaking import coulomb, shaken
from slipwise.model import Model, base_model, use
from slipwise.simulation.predict import predictor

STIFFNESS = base_model("bridge1").specimen.buffer_stiffness[0]
AMPLITUDE = 0.02


def bridge(name: str, **values: float) -> Model:
    return base_model("bridge1").adding(use(name, **values))


def sine(frequency: float = 1.0, cycles: int = 2, count: int = 4001) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    time = np.linspace(0.0, cycles / frequency, count)
    angle = 2 * np.pi * frequency * time
    return time, AMPLITUDE * np.sin(angle), AMPLITUDE * 2 * np.pi * frequency * np.cos(angle)


def force(model: Model, time: np.ndarray, deflection: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Force along x of both buffers, (n, 2)."""
    both = [np.stack([np.stack([a, 0.0 * a], axis=1)] * 2, axis=1) for a in (deflection, rate)]
    return predictor(model).buffers(time, *both)[:, :, 0]


def area(deflection: np.ndarray, values: np.ndarray) -> float:
    """Work over the second of two cycles."""
    half = len(values) // 2
    return float(np.sum(0.5 * (values[half + 1 :] + values[half:-1]) * np.diff(deflection[half:])))


@pytest.mark.parametrize("frequency", [0.5, 3.0])
def test_damping_dissipates_pi_c_omega_times_amplitude_squared(frequency: float) -> None:
    time, x, v = sine(frequency)
    found = area(x, force(bridge("buffer_damping", damping=7e3), time, x, v)[:, 0])
    assert found == pytest.approx(np.pi * 7e3 * 2 * np.pi * frequency * AMPLITUDE**2, rel=1e-4)


def test_a_dashpot_of_smaller_exponent_is_flatter_and_odd() -> None:
    rates = np.array([-0.2, -0.1, 0.0, 0.1, 0.2])
    found = force(bridge("buffer_damping", damping=1e4, exponent=0.5), np.arange(5.0), 0.0 * rates, rates)[:, 0]
    np.testing.assert_allclose(found, 1e4 * 0.1 * np.sign(rates) * np.sqrt(np.abs(rates) / 0.1), rtol=1e-12)


@pytest.mark.parametrize("frequency", [0.5, 8.0])
def test_a_dashpot_with_a_spring_in_series_has_the_loss_of_zeners_solid(frequency: float) -> None:
    """Loss modulus c w / (1 + (w t_r)^2)."""
    omega, relaxation = 2 * np.pi * frequency, 0.02
    time, x, v = sine(frequency, cycles=2)
    found = area(x, force(bridge("buffer_damping", damping=7e3, relaxation=relaxation), time, x, v)[:, 0])
    expected = np.pi * 7e3 * omega / (1.0 + (omega * relaxation) ** 2) * AMPLITUDE**2
    assert found == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize("frequency", [0.5, 3.0])
def test_hysteresis_has_the_same_loop_at_every_frequency(frequency: float) -> None:
    """Elastic-plastic: a parallelogram 4 H (X - u)."""
    time, x, v = sine(frequency)
    found = area(x, force(bridge("buffer_hysteresis", strength=2e3, length=2e-3, exponent=0.0), time, x, v)[:, 0])
    assert found == pytest.approx(4.0 * 2e3 * (AMPLITUDE - 2e-3), rel=1e-3)


def test_hysteresis_of_dahls_form_is_bouc_and_wens_with_exponent_one() -> None:
    time, x, v = sine(1.0, count=2001)
    found = force(bridge("buffer_hysteresis", strength=2e3, length=3e-3), time, x, v)[:, 0] - STIFFNESS * x

    def rate(t: float) -> float:
        return AMPLITUDE * 2 * np.pi * np.cos(2 * np.pi * t)

    wen = solve_ivp(
        lambda t, z: (rate(t) - abs(rate(t)) * z) / 3e-3,
        (0.0, time[-1]), [0.0], t_eval=time, rtol=1e-9, atol=1e-12, max_step=1e-3,
    )  # fmt: skip
    np.testing.assert_allclose(found / 2e3, wen.y[0], atol=5e-4)


def test_hardening_adds_its_share_at_thirty_millimetres() -> None:
    x = np.array([-0.03, -0.015, 0.0, 0.03])
    found = force(bridge("buffer_hardening", gain=0.1, power=2.0), np.arange(4.0), x, 0.0 * x)[:, 0]
    np.testing.assert_allclose(found, STIFFNESS * x * [1.1, 1.025, 1.0, 1.1], rtol=1e-12)


@pytest.mark.parametrize("shape", [1.0, 2.0])
def test_softening_is_spent_by_the_largest_stroke_so_far(shape: float) -> None:
    x = np.array([0.0, 0.01, 0.02, 0.01, -0.01, -0.02, 0.03, 0.01])
    largest = np.maximum.accumulate(np.abs(x))
    found = force(bridge("buffer_softening", rise=0.2, length=0.015, shape=shape), np.arange(8.0), x, 0.0 * x)[:, 0]
    np.testing.assert_allclose(found, STIFFNESS * x * (1.0 + 0.2 * np.exp(-((largest / 0.015) ** shape))), rtol=1e-12)


def test_a_loop_is_forgotten_in_a_long_pause_wherever_the_girder_is_set_then() -> None:
    time, x, v = sine()
    law = predictor(bridge("buffer_hysteresis", strength=2e3, length=2e-3))
    states = [np.repeat(np.stack([a, 0.0 * a], axis=1)[:, None], 2, axis=1) for a in (x, v)]
    first = law.buffers(time, *states)
    law.rest(1800.0)
    np.testing.assert_allclose(law.buffers(time, *states), first, rtol=1e-9, atol=1e-6)
    law.rest(1800.0)
    moved = law.buffers(time, states[0] + 5e-3, states[1]) - first
    np.testing.assert_allclose(moved[:, :, 0], STIFFNESS * 5e-3, rtol=1e-9)


def test_a_mismatch_moves_force_from_one_buffer_to_the_other() -> None:
    time, x, v = sine()
    found, plain = (
        force(bridge("buffer_mismatch", difference=0.1), time, x, v),
        force(base_model("bridge1"), time, x, v),
    )
    np.testing.assert_allclose(found.sum(axis=1), plain.sum(axis=1), atol=1e-9)
    np.testing.assert_allclose(found[:, 0], 1.1 * plain[:, 0], rtol=1e-12)


def test_nothing_is_felt_inside_the_gap_of_a_key() -> None:
    time, x, v = sine()
    found = force(bridge("key_clearance", clearance=2e-3).adding(use("buffer_damping")), time, x, v)[:, 0]
    inside = (np.abs(x) < 2e-3) & (time > 0.0)
    assert np.all(found[inside] == 0.0), "neither spring nor dashpot acts on a buffer that is not touched"
    beyond = np.abs(x) > 2e-3
    elastic = force(bridge("key_clearance", clearance=2e-3), time, x, v)[:, 0]
    np.testing.assert_allclose(elastic[beyond], STIFFNESS * (x - 2e-3 * np.sign(x))[beyond], rtol=1e-9)


def test_the_blow_of_a_key_never_pulls() -> None:
    time, x, v = sine(2.0)
    found = force(bridge("key_clearance", clearance=2e-3, impact=5e5), time, x, v)[:, 0]
    assert np.all(found * x >= 0.0)
    assert area(x, found) > 0.0


def test_a_key_that_springs_back_freely_is_damped_on_its_way_in_only() -> None:
    time, x, v = sine(2.0)
    elastic = force(bridge("key_clearance", clearance=2e-3), time, x, v)[:, 0]
    found = force(bridge("key_clearance", clearance=2e-3, impact=5e5, release=0.0), time, x, v)[:, 0]
    out, closed = x * v < 0.0, np.abs(x) > 2e-3
    np.testing.assert_allclose(found[out], elastic[out], rtol=1e-12, atol=1e-9)
    blow = 5e5 * np.sqrt(np.abs(x) - 2e-3, where=closed, out=np.zeros_like(x)) * v
    np.testing.assert_allclose((found - elastic)[closed & ~out], blow[closed & ~out], rtol=1e-9, atol=1e-6)


def test_a_girder_behind_a_gap_moves_as_the_piecewise_linear_equation_says() -> None:
    """m x'' = -m a - k dz(x, c), without friction: an integrator that stops at every edge of the gap."""
    clearance, dt = 2e-3, 2.5e-4
    time = np.arange(round(3.0 / dt)) * dt
    shake = np.zeros((len(time), 3))
    shake[:, 0] = 1.5 * np.clip(time / 0.5, 0.0, 1.0) * np.sin(2 * np.pi * 1.7 * time)
    # A low centre of gravity: the girder's pitch on its pads gives way too, and is no part of the equation.
    model = coulomb("bridge1", 1e-7, centre_height=0.01).adding(use("key_clearance", clearance=clearance))
    ours = shaken(model, shake, dt=dt).record
    mass, stiffness = model.specimen.mass, sum(model.specimen.buffer_stiffness)

    def table(t: float) -> float:
        return 1.5 * min(t / 0.5, 1.0) * np.sin(2 * np.pi * 1.7 * t)

    def equation(side: int):  # side: -1, 0, +1 of the gap
        return lambda t, y: [y[1], -table(t) - stiffness / mass * (y[0] - side * clearance) * abs(side)]

    def edge(where: float):
        crossing = lambda t, y: y[0] - where  # noqa: E731
        crossing.terminal = True
        return crossing

    t, y, side, pieces = 0.0, np.array([0.0, 0.0]), 0, []
    while t < time[-1]:
        edges = [edge(-clearance), edge(clearance)] if side == 0 else [edge(side * clearance)]
        found = solve_ivp(equation(side), (t, time[-1]), y, "DOP853", dense_output=True, events=edges,
                          rtol=1e-11, atol=1e-14, max_step=0.01)  # fmt: skip
        pieces.append((t, found.t[-1], found.sol))
        t, y = found.t[-1], found.y[:, -1]
        if found.status == 1:
            side = int(np.sign(y[0])) if side == 0 else 0
            y = y + [np.sign(y[1]) * 1e-13, 0.0]
    exact = np.zeros(len(time))
    for start, end, solution in pieces:
        inside = (time >= start) & (time <= end)
        exact[inside] = solution(time[inside])[0]
    assert np.abs(exact).max() > 3 * clearance, "it must strike"
    error = np.sqrt(np.mean((ours["slip_x"] - exact) ** 2)) / np.sqrt(np.mean(exact**2))
    assert error < 1e-4
