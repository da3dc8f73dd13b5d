"""Derived states against closed forms along a known path, and the same in records and in a simulation."""

import textwrap
from pathlib import Path

import numpy as np
import pytest

from slipwise.effects import DERIVED, load_effect
from slipwise.errors import SettingError
from slipwise.model import EffectUse, base_model
from slipwise.motion import load_motion
from slipwise.simulation.kernel import derived_states
from slipwise.simulation.predict import predictor
from slipwise.simulation.replay import replay

FREQUENCY, AMPLITUDE, LAG = 1.0, 0.03, 0.05


def observed(velocity: np.ndarray, slip: np.ndarray, load: np.ndarray, dt: float) -> dict[str, np.ndarray]:
    """States at every instant of one pad, along a path (n, 2)."""
    memory = np.zeros(derived_states.SIZE)
    out = np.zeros((len(load), len(DERIVED)))
    for i, (v, x) in enumerate(zip(velocity, slip, strict=True)):
        derived_states.observe(memory, 100.0, load[i], 0.01, *v, *x, i * dt, dt, LAG)
        out[i] = memory[: len(DERIVED)]
    return dict(zip(DERIVED, out.T, strict=True))


def along(position: np.ndarray, rate: np.ndarray, load: np.ndarray, dt: float) -> dict[str, np.ndarray]:
    nothing = np.zeros_like(position)
    return observed(np.stack([rate, nothing], axis=1), np.stack([position, nothing], axis=1), load, dt)


@pytest.fixture(scope="module")
def sine() -> tuple[np.ndarray, dict[str, np.ndarray]]:
    dt = 0.5e-3
    time = np.arange(6000) * dt
    angle = 2 * np.pi * FREQUENCY * time
    load = 1e4 * (1.0 + 0.2 * np.sin(angle))
    rate = AMPLITUDE * 2 * np.pi * FREQUENCY * np.cos(angle)
    return time, along(AMPLITUDE * np.sin(angle), rate, load, dt)


def test_a_stroke_of_a_sine_is_twice_its_amplitude_at_its_largest_speed(sine) -> None:
    time, states = sine
    later = time > 1.3
    np.testing.assert_allclose(states["last_stroke"][later], 2 * AMPLITUDE, rtol=2e-3)
    np.testing.assert_allclose(states["last_peak_speed"][later], AMPLITUDE * 2 * np.pi * FREQUENCY, rtol=1e-5)


def test_time_and_way_are_counted_from_the_turning_point(sine) -> None:
    time, states = sine
    settled = (time > 0.3) & (np.abs(np.cos(2 * np.pi * FREQUENCY * time)) > 0.02)
    since = np.mod(time - 0.25, 0.5)
    np.testing.assert_allclose(states["time_since_reversal"][settled], since[settled], atol=1.1e-3)
    way = AMPLITUDE * (1.0 - np.cos(2 * np.pi * FREQUENCY * since))
    np.testing.assert_allclose(states["distance_since_reversal"][settled], way[settled], atol=5e-5)


def test_rates_and_lags_are_those_of_a_first_order_lag(sine) -> None:
    time, states = sine
    later = (time > 1.0) & (np.abs(np.cos(2 * np.pi * FREQUENCY * time)) > 0.02)
    omega = 2 * np.pi * FREQUENCY
    speed_rate = -AMPLITUDE * omega**2 * np.sin(omega * time) * np.sign(np.cos(omega * time))
    np.testing.assert_allclose(states["speed_rate"][later], speed_rate[later], atol=0.01)
    gain, phase = 1.0 / np.hypot(1.0, omega * LAG), np.arctan(omega * LAG)
    lagged = 1e4 * (1.0 + 0.2 * gain * np.sin(omega * time - phase))
    np.testing.assert_allclose(states["lagged_load"][later], lagged[later], rtol=1e-3)
    rate = 1e4 * 0.2 * gain * omega * np.cos(omega * time - phase)
    np.testing.assert_allclose(states["load_rate"][later], rate[later], atol=60.0)


def test_heat_of_a_constant_flux_rises_to_flux_times_time_constant() -> None:
    n, dt = 4000, 1e-3
    states = along(0.1 * np.arange(n) * dt, np.full(n, 0.1), np.full(n, 1e4), dt)
    time = dt * np.arange(n)
    np.testing.assert_allclose(states["heat"], 100.0 * 0.1 / 0.01 * LAG * (1.0 - np.exp(-time / LAG)), rtol=1e-9)
    np.testing.assert_allclose(states["slid"], 0.1 * time, rtol=1e-9, atol=1e-12)
    assert np.all(states["outward"][1:] == 1.0)


def test_a_circle_has_the_curvature_of_its_radius_and_no_reversal() -> None:
    angle, radius, dt = np.linspace(0.0, 6.0, 3000), 0.02, 1e-3
    slip = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    velocity = radius * 6.0 / 3.0 * np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    states = observed(velocity, slip, np.full(3000, 1e4), dt)
    np.testing.assert_allclose(states["path_curvature"][10:], 1.0 / radius, rtol=2e-3)
    assert np.all(states["last_stroke"] == 0.0)


def test_a_pad_that_trembles_while_it_sticks_begins_no_stroke() -> None:
    n, dt = 2000, 1e-3
    time = dt * np.arange(n)
    rate = np.where(time < 0.5, 0.2 * np.sin(2 * np.pi * time), 1e-4 * np.sin(2 * np.pi * 90.0 * time))
    states = along(np.cumsum(rate) * dt, rate, np.full(n, 1e4), dt)
    assert np.all(states["last_stroke"] == 0.0) and states["time_since_reversal"][-1] == pytest.approx(time[-1])


FILE = '''
"""Friction that is higher just after a reversal.

    mu += c exp(-t_r / t_0)

Valid: a test.
Source: assumed.
"""

from math import exp

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def coefficient(coefficient, time_since_reversal, rise, decay):
    """Add to the coefficient of friction [1]."""
    return coefficient + rise * exp(-time_since_reversal / decay)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("rise", "1", 0.05, -0.2, 0.2, 0.0, "assumed", "c"),
        Parameter("decay", "s", 0.03, 1e-3, 1.0, None, "assumed", "t_0"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu += c exp(-t_r/t_0)",
        moves=RESPONSE,
        signature="odd",
        confused_with={},
    ),
)
'''


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("own") / "after_reversal.py"
    path.write_text(FILE, encoding="utf-8")
    return path


@pytest.mark.parametrize("engine", ["python", "compiled"])
def test_a_law_of_them_is_the_same_in_a_simulation_and_driven_by_its_record(written: Path, engine: str) -> None:
    effect = load_effect(written)
    model = base_model("bridge1").adding(EffectUse(effect, effect.typical()))
    seen = replay(model, load_motion("sine:4Hz,1.2g,cycles=9"), dt=0.0005, output_dt=0.0005, engine=engine).record
    load = np.stack([seen[f"pad_{p}_N"] for p in "ABCD"], axis=1)
    nothing = np.zeros_like(load)
    slip = np.stack([np.repeat(seen["slip_x"][:, None], 4, axis=1), nothing], axis=2)
    velocity = np.gradient(slip, seen.dt, axis=0)
    driven = predictor(model, engine=engine).pads(seen.time, load, velocity, slip)
    plain = predictor(base_model("bridge1"), engine=engine).pads(seen.time, load, velocity, slip)
    extra = (driven.bound - plain.bound) / load
    assert extra.max() > 0.045, "the law acts, up to its full size"
    fast = np.abs(velocity[:, 0, 0]) > 0.05
    force = np.stack([seen[f"pad_{p}_Fx"] for p in "ABCD"], axis=1)[fast]
    away, without = (np.abs(x.force[fast][:, :, 0] / force - 1.0) for x in (driven, plain))
    assert np.quantile(away, 0.98) < 0.02 < np.quantile(without, 0.5), "it is reversals that a record blurs"


def test_a_lagging_state_asks_for_a_time_constant(tmp_path: Path) -> None:
    path = tmp_path / "lag.py"
    path.write_text(textwrap.dedent(FILE).replace("time_since_reversal", "load_rate"), encoding="utf-8")
    with pytest.raises(SettingError, match=r"coefficient\(\) asks for 'load_rate': it needs .*time_constant"):
        load_effect(path)
