"""Quantities of loops in closed form come out within half a percent, whichever way they begin and wherever zero is."""

import numpy as np
import pytest

from slipwise.bearings.cycles import find_cycles
from slipwise.bearings.quantities import measure_cycle, measure_run
from unit.bearings.loops_in_closed_form import (
    AMPLITUDE,
    AREA,
    KNOWN,
    LOAD,
    RESTORING,
    STRENGTH,
    friction,
    loop_of,
    motion,
)

WITHIN = 5e-3


def third_cycle(kind: str, sign: float = 1.0, offset: float = 0.0) -> dict[str, float]:
    time, slip = motion(sign=sign)
    loop = loop_of(time, slip, friction(kind, slip) + RESTORING * slip, offset)
    found = measure_cycle(loop.of(find_cycles(slip).cycles[2]))
    return {key: float(values[0]) for key, values in found.items()}


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["as it is", "mirrored"])
@pytest.mark.parametrize("offset", [0.0, 0.1 * STRENGTH], ids=["zeroed", "zero off"])
@pytest.mark.parametrize("kind", KNOWN)
def test_a_steady_cycle_has_the_quantities_of_its_closed_form(kind, sign, offset):
    found, known = third_cycle(kind, sign, offset), KNOWN[kind]
    assert found["energy"] == pytest.approx(known.energy, rel=WITHIN)
    assert found["characteristic_strength"] == pytest.approx(known.strength, rel=WITHIN)
    assert found["effective_stiffness"] == pytest.approx(known.stiffness, rel=WITHIN)
    assert found["equivalent_damping"] == pytest.approx(known.damping, rel=WITHIN)
    # of a slope, half a percent of what it adds to the force over the stroke
    assert found["second_slope_stiffness"] * AMPLITUDE == pytest.approx(RESTORING * AMPLITUDE, abs=WITHIN * STRENGTH)
    assert found["friction_mean"] == pytest.approx(known.energy / (4.0 * LOAD * AMPLITUDE), rel=WITHIN)
    assert found["friction_peak_speed"] == pytest.approx(STRENGTH / LOAD, rel=WITHIN)
    assert found["peak_speed"] == pytest.approx(2.0 * np.pi * AMPLITUDE, rel=WITHIN)
    assert found["mean_pressure"] == pytest.approx(LOAD / AREA, rel=WITHIN)


def test_friction_that_peaks_after_each_turn_breaks_away_at_the_peak():
    time, slip = motion()
    since = np.abs(slip - np.where(np.gradient(slip) > 0, -AMPLITUDE, AMPLITUDE))
    force = friction("coulomb", slip) * (1.0 + 0.4 * np.exp(-since / 0.01))
    found = measure_cycle(loop_of(time, slip, force).of(find_cycles(slip).cycles[2]))
    assert found["friction_breakaway"][0] == pytest.approx(1.4 * STRENGTH / LOAD, rel=0.02)
    assert found["friction_peak_speed"][0] < 1.01 * STRENGTH / LOAD


def test_friction_that_falls_towards_the_turns_is_no_stiffness():
    time, slip = motion()
    speed = np.abs(np.gradient(slip, time))
    force = friction("coulomb", slip) * (0.4 + 0.6 * (1.0 - np.exp(-speed / 0.05)))
    found = measure_cycle(loop_of(time, slip, force).of(find_cycles(slip).cycles[2]))
    assert abs(found["second_slope_stiffness"][0]) * AMPLITUDE < WITHIN * STRENGTH


def test_a_loop_that_is_elastic_over_most_of_its_stroke_has_no_characteristic_strength():
    time, slip = motion()
    loop = loop_of(time, slip, friction("trapezoid", slip, elastic=1.2 * AMPLITUDE))
    found = measure_cycle(loop.of(find_cycles(slip).cycles[2]))
    for key in ("characteristic_strength", "second_slope_stiffness", "friction_breakaway"):
        assert np.isnan(found[key][0])
    assert found["energy"][0] == pytest.approx(4.0 * STRENGTH * 0.4 * AMPLITUDE, rel=WITHIN)


def test_breakaway_is_not_given_where_a_stop_pushes_back_at_the_turns():
    time, slip = motion()
    stop = 10.0 * STRENGTH / AMPLITUDE * np.sign(slip) * np.maximum(np.abs(slip) - 0.8 * AMPLITUDE, 0.0)
    found = measure_cycle(loop_of(time, slip, friction("coulomb", slip) + stop).of(find_cycles(slip).cycles[2]))
    assert np.isnan(found["friction_breakaway"][0])
    assert found["characteristic_strength"][0] == pytest.approx(STRENGTH, rel=WITHIN)


def test_a_run_that_begins_at_rest_shows_the_coefficient_of_its_first_movement():
    time, slip = motion()
    rest = 200
    slip = np.concatenate([np.zeros(rest), AMPLITUDE * (1.0 - np.cos(2.0 * np.pi * time)) / 2.0])
    time = np.arange(len(slip)) / 400.0
    velocity = np.gradient(slip)
    force = STRENGTH * np.sign(np.where(np.abs(velocity) > 1e-9, velocity, 0.0))
    force[rest + 2 : rest + 40] *= 1.5
    found = measure_run(loop_of(time, slip, force))
    assert found["friction_breakaway"][0] == pytest.approx(1.5 * STRENGTH / LOAD, rel=0.01)
    assert found["friction_mean"][0] == pytest.approx(found["energy"][0] / (LOAD * found["way"][0]), rel=1e-6)


def test_friction_of_an_earthquake_on_a_curved_face_is_told_from_its_restoring_force():
    time = np.arange(0.0, 12.0, 0.005)
    slip = 0.04 * np.sin(2.0 * np.pi * 0.7 * time) + 0.03 * np.sin(2.0 * np.pi * 1.13 * time + 1.0)
    found = measure_run(loop_of(time, slip, friction("coulomb", slip) + 1e5 * slip))
    assert found["friction_peak_speed"][0] == pytest.approx(STRENGTH / LOAD, rel=0.01)
