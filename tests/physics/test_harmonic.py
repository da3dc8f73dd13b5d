"""Harmonic shaking against closed forms and an event-driven integrator; docs/theory.md, section 4."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import FAST, G, coulomb, half_range, last_cycles, shaken, sine
from slipwise.model import base_model


@pytest.mark.parametrize(
    ("rig", "frequency", "amplitude", "millimetres"),
    [("block", 2.0, 0.3, 16.0111), ("bridge1", 2.0, 0.3, 14.4045), ("bridge2", 4.0, 0.5, 11.4747)],
)
def test_eq7_with_rocking_reaches_the_event_driven_answer_within_half_a_percent(rig, frequency, amplitude, millimetres):
    replay = shaken(base_model(rig), sine(frequency, amplitude * G, 20.0))
    slip = replay.record["slip_x"][last_cycles(replay, frequency)]
    assert half_range(slip) * 1e3 == pytest.approx(millimetres, rel=0.005)


@pytest.mark.parametrize(
    ("rig", "frequency", "amplitude", "millimetres"),
    [("block", 2.0, 0.3, 15.0134), ("bridge1", 2.0, 0.3, 14.7959), ("bridge2", 4.0, 0.5, 11.3766)],
)
def test_coulomb_reaches_the_event_driven_answer_within_half_a_percent(rig, frequency, amplitude, millimetres):
    replay = shaken(coulomb(rig), sine(frequency, amplitude * G, 20.0))
    slip = replay.record["slip_x"][last_cycles(replay, frequency)]
    assert half_range(slip) * 1e3 == pytest.approx(millimetres, rel=0.005)


@pytest.mark.parametrize(("mu", "amplitude", "frequency"), [(0.1, 0.5, 2.0), (0.1, 0.3, 2.0), (0.05, 0.4, 3.0)])
def test_a_free_block_slides_as_its_closed_form_says(mu, amplitude, frequency):
    # Continuous sliding: half range sqrt(a0^2 - (pi mu g / 2)^2) / w^2, energy per cycle 4 mu m g x0.
    replay = shaken(coulomb("block", mu), sine(frequency, amplitude * G, 16.0))
    expected = np.sqrt((amplitude * G) ** 2 - (np.pi * mu * G / 2) ** 2) / (2 * np.pi * frequency) ** 2
    window = last_cycles(replay, frequency)
    slip = replay.record["slip_x"][window]
    assert half_range(slip) == pytest.approx(expected, rel=0.005)
    force = sum(replay.record[f"pad_{p}_Fx"][window] for p in "ABCD")
    energy = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(slip)) / 4
    assert energy == pytest.approx(4 * mu * 1e4 * G * expected, rel=0.01)


def test_a_free_block_sticks_while_the_table_stays_below_friction():
    replay = shaken(coulomb("block", 0.1), sine(2.0, 0.09 * G, 6.0))
    assert np.abs(replay.record["slip_x"]).max() < 1e-5


def _den_hartog(r: float, ratio: float) -> float:
    v = 1.0 / (1.0 - r**2)
    u = np.sin(np.pi / r) / (r * (1.0 + np.cos(np.pi / r)))
    return float(np.sqrt(v**2 - (ratio * u) ** 2))


@pytest.mark.parametrize(
    ("r", "ratio", "table"),
    [
        (0.8, 0.3, 2.62610),
        (1.25, 0.3, 1.61706),
        (1.25, 0.5, 1.28256),
        (2.0, 0.3, 0.29768),
        (2.0, 0.5, 0.22048),
        (3.0, 0.3, 0.11087),
    ],
)
def test_a_girder_on_buffers_moves_as_den_hartog_says(r, ratio, table):
    # Base motion of amplitude a0 = F / (ratio m); a low centre of gravity, as his oscillator does not rock.
    assert _den_hartog(r, ratio) == pytest.approx(table, abs=1e-5)
    low = coulomb("bridge1", FAST, centre_height=0.01)
    amplitude = FAST * G / ratio
    frequency = r * low.specimen.frequency
    replay = shaken(low, sine(frequency, amplitude, 30.0 / frequency + 12.0))
    expected = table * amplitude / (2 * np.pi * low.specimen.frequency) ** 2
    slip = replay.record["slip_x"][last_cycles(replay, frequency)]
    assert half_range(slip) == pytest.approx(expected, rel=0.005)


def test_free_decay_loses_four_friction_forces_over_stiffness_per_cycle_and_keeps_its_period():
    # A kick of the table sets the girder swinging on its buffers.
    low = coulomb("bridge1", FAST, centre_height=0.01)
    dt = 1e-4
    acceleration = np.zeros((round(2.0 / dt), 3))
    acceleration[:10, 0] = -0.9 / (10 * dt)
    replay = shaken(low, acceleration, dt=dt)
    slip, time = replay.record["slip_x"], replay.record.time
    peaks = [i for i in range(1, len(slip) - 1) if slip[i] > slip[i - 1] and slip[i] >= slip[i + 1] and slip[i] > 5e-3]
    stiffness = sum(low.specimen.buffer_stiffness)
    assert np.diff(slip[peaks][:3]) == pytest.approx(-4 * FAST * low.specimen.weight / stiffness, rel=0.005)
    assert np.diff(time[peaks][:3]) == pytest.approx(1.0 / low.specimen.frequency, rel=0.005)
    assert abs(slip[-1]) <= FAST * low.specimen.weight / stiffness * 1.001


def test_with_eq7_the_girder_stops_within_the_band_of_slow_friction():
    model = base_model("bridge1")
    acceleration = np.zeros((8000, 3))
    acceleration[:10, 0] = -0.5 / (10 * 5e-4)
    replay = shaken(model, acceleration)
    stop_band = 0.046 * model.specimen.weight / sum(model.specimen.buffer_stiffness)
    assert abs(replay.record["slip_x"][-1]) <= stop_band * 1.01
    assert np.abs(replay.record["slip_vx"][-500:]).max() < 1e-4


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_halving_the_step_changes_the_slip_by_less_than_half_a_percent(rig):
    model = base_model(rig)
    coarse = shaken(model, sine(2.0, 0.3 * G, 8.0))
    fine = shaken(model, sine(2.0, 0.3 * G, 8.0, dt=2.5e-4), dt=2.5e-4)
    assert half_range(coarse.record["slip_x"]) == pytest.approx(half_range(fine.record["slip_x"]), rel=0.005)


def test_stiffer_pads_do_not_change_the_slip():
    model = base_model("bridge1")
    stiff = replace(model, specimen=model.specimen.changed(pad_stiffness=330e6))
    motion = sine(2.0, 0.3 * G, 8.0)
    assert half_range(shaken(stiff, motion).record["slip_x"]) == pytest.approx(
        half_range(shaken(model, motion).record["slip_x"]), rel=0.002
    )
