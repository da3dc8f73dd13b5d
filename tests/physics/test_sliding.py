"""Free sliding, weight and rocking."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import FAST, G, coulomb, shaken, sine
from slipwise.model import base_model
from slipwise.rig import load_specimen
from slipwise.rig.statics import at_rest
from slipwise.simulation.simulator import simulate

MASS = 1e4


def pushed(model, speed, seconds, dt=5e-4):
    """The table starts with a jerk: the girder slides over it at a speed [m/s]."""
    acceleration = np.zeros((round(seconds / dt), 3))
    acceleration[0, 0] = -speed / dt
    return shaken(model, acceleration, dt=dt)


@pytest.mark.parametrize("rig", ["bridge1", "bridge2", "block"])
def test_at_rest_every_pad_carries_a_quarter_of_the_weight(rig):
    replay = shaken(base_model(rig), np.zeros((400, 3)))
    loads = replay.record.stacked("pad_{}_N")
    assert loads == pytest.approx(24516.625, rel=1e-9)
    assert np.abs(replay.record["slip_x"]).max() < 1e-12


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_vertical_shaking_moves_the_loads_by_inertia_alone(rig):
    t = np.arange(8000) * 5e-4
    acceleration = np.zeros((8000, 3))
    acceleration[:, 2] = 0.2 * G * np.clip(t / 2, 0, 1) * np.sin(2 * np.pi * 0.5 * t)
    record = shaken(base_model(rig), acceleration).record
    loads = record.stacked("pad_{}_N")
    # The sum balances the girder's own acceleration always; far below the pads' 45 Hz that is the table's.
    assert loads.sum(axis=1) == pytest.approx(MASS * (G + record["girder_az"]), rel=1e-6)
    late = record.time > 2.0
    assert loads[late].sum(axis=1) == pytest.approx(MASS * (G + record["table_az"][late]), rel=2e-4)


def closed_form(v0, rate=19.7):
    """Stop time [s] and distance [m] of a block under eq. (7) without rocking."""
    pressure = load_specimen("block").rated_pressure
    a1 = 1.379e6 * (1 - np.exp(-0.102e-6 * pressure)) * G / pressure
    d = a1 + 0.046 * G
    y = np.exp(rate * v0)
    stop = np.log((y - a1 / d) / (1 - a1 / d)) / (rate * d)
    t = np.linspace(0.0, stop, 200001)
    v = np.log(a1 / d + (y - a1 / d) * np.exp(-rate * d * t)) / rate
    return stop, float(np.trapezoid(v, t))


def test_the_closed_form_of_sliding_down_is_the_one_that_was_tabulated():
    table = {0.1: (0.127392, 0.005584), 0.3: (0.311616, 0.042218), 0.5: (0.492032, 0.114381), 1.0: (0.942895, 0.452528)}
    for v0, expected in table.items():
        assert closed_form(v0) == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize("v0", [0.1, 0.3, 0.5, 1.0])
def test_a_sliding_block_stops_when_and_where_eq7_says(v0):
    # Neither rocking nor P-delta: the closed form has one load.
    low = base_model("block")
    low = replace(low, specimen=replace(low.specimen, centre_height=1e-3, pads_on="girder"))
    record = pushed(low, v0, 1.4).record
    first = 20  # past the jerk of the start
    speed, slip, time = record["slip_vx"], record["slip_x"], record.time
    stop, distance = closed_form(float(speed[first]))
    moving = np.flatnonzero(speed > 1e-3)
    # Time to fall to 1 mm/s: the rest of the way is what the closed form says for 1 mm/s.
    rest_time, rest_distance = closed_form(float(speed[moving[-1]]))
    assert time[moving[-1]] - time[first] + rest_time == pytest.approx(stop, rel=0.002)
    assert slip[moving[-1]] - slip[first] + rest_distance == pytest.approx(distance, rel=0.002)


@pytest.mark.parametrize(
    ("rig", "deceleration", "leading", "trailing"),
    [("bridge1", 0.113069, 25.193, 23.840), ("bridge2", 0.113020, 25.869, 23.164)],
)
def test_while_it_slides_the_leading_pads_carry_more(rig, deceleration, leading, trailing):
    # Without buffers and without P-delta (pads travel with the girder). The kick makes the girder nod on its
    # pads at first: the mean over the slide counts.
    model = base_model(rig)
    specimen = model.specimen.changed(buffer_stiffness=(1e-3, 1e-3), pads_on="girder", pad_damping=3e5)
    record = pushed(replace(model, specimen=specimen), 1.5, 0.9).record
    fast = (record.time > 0.45) & (record.time < 0.8)
    assert -record["girder_ax"][fast].mean() / G == pytest.approx(deceleration, rel=5e-4)
    assert record["pad_A_N"][fast].mean() / 1e3 == pytest.approx(leading, rel=5e-4)
    assert record["pad_B_N"][fast].mean() / 1e3 == pytest.approx(trailing, rel=5e-4)


@pytest.mark.parametrize(("rig", "ratio"), [("bridge1", 0.122), ("bridge2", 0.244)])
def test_a_pad_lifts_when_rocking_takes_its_whole_load(rig, ratio):
    # docs/theory.md, section 4: 2 (a/g)(h/b) = 1, the girder locked to the table by a huge friction
    locked = coulomb(rig, 50.0)
    limit = 1.0 / (2.0 * ratio)
    t = np.arange(round(3.0 / 5e-4)) * 5e-4
    acceleration = np.zeros((len(t), 3))
    acceleration[:, 0] = 1.1 * limit * G * t / 3.0
    record = shaken(locked, acceleration).record
    trailing = record["pad_A_N"]
    lifted = np.flatnonzero(trailing <= 0.0)
    assert record["table_ax"][lifted[0]] / G == pytest.approx(limit, rel=0.01)


def test_all_pads_lift_when_the_table_falls_away():
    acceleration = np.zeros((1200, 3))
    acceleration[200:600, 2] = -1.5 * G
    replay = simulate(base_model("bridge1"), acceleration)
    assert replay.uplift > 0.15
    assert np.all(np.isfinite(replay.record["girder_az"]))
    # It lands: the pads carry the weight again at the end of the run.
    assert replay.load_range["A"][1] > 24516.0


@pytest.mark.parametrize("shift", [(0.05, 0.0), (0.0, 0.1), (-0.03, 0.07)])
def test_an_eccentric_weight_loads_the_pads_as_statics_say(shift):
    # N_i = m g / 4 (1 +- x_c / (b/2) +- y_c / (l/2)).
    specimen = replace(load_specimen("bridge1"), centre_x=shift[0], centre_y=shift[1])
    sides = np.array([[1, 1], [-1, 1], [1, -1], [-1, -1]])
    expected = MASS * G / 4 * (1 + sides @ [shift[0] / 1.5, shift[1] / 2.5])
    assert at_rest(specimen).load == pytest.approx(expected, rel=1e-9)
    model = replace(base_model("bridge1"), specimen=specimen)
    assert shaken(model, np.zeros((200, 3))).record.stacked("pad_{}_N")[-1] == pytest.approx(expected, rel=1e-5)


def test_a_constant_friction_coefficient_gives_no_torque_about_an_eccentric_centre():
    # Friction is then proportional to mass; eq. (7) is concave in N and turns the girder.
    turned = {}
    for name, model in {"coulomb": coulomb("block", FAST), "eq7": base_model("block")}.items():
        specimen = replace(model.specimen, centre_y=0.3, pads_on="girder", centre_height=1e-3)
        turned[name] = abs(pushed(replace(model, specimen=specimen), 0.6, 0.4).record["yaw"][-1])
    assert turned["eq7"] > 1e-4
    assert turned["coulomb"] < 0.02 * turned["eq7"]


def test_warp_changes_no_motion_with_coulomb_friction_and_little_with_eq7():
    # Seating moves load from one diagonal to the other; equilibrium does not see it.
    from shaking import half_range, sine

    motion = sine(2.0, 0.3 * G, 6.0)
    warped = (2e-5, -2e-5, -2e-5, 2e-5)
    for model, allowed in ((coulomb("bridge1"), 2e-5), (base_model("bridge1"), 0.02)):
        flat = shaken(model, motion).record["slip_x"]
        uneven = shaken(replace(model, specimen=model.specimen.changed(seating=warped)), motion).record
        assert uneven.stacked("pad_{}_N")[0] == pytest.approx(24516.625 + 200e6 * np.array(warped), rel=1e-9)
        assert half_range(uneven["slip_x"]) == pytest.approx(half_range(flat), rel=allowed)


@pytest.mark.parametrize("dt", [5e-4, 1e-4])
def test_friction_turns_round_with_the_slip_to_a_few_steps(dt):
    """A finer step must be a better answer: a friction that let go early by a fixed time would never converge."""
    record = shaken(coulomb("bridge1"), sine(2.0, 4.0, 3.0, dt=dt), dt=dt).record
    late = record.time > 1.5
    friction, speed = record.stacked("pad_{}_Fx").sum(axis=1)[late], record["slip_vx"][late]
    turns = np.flatnonzero(np.signbit(speed[1:]) != np.signbit(speed[:-1]))
    changes = np.flatnonzero(np.signbit(friction[1:]) != np.signbit(friction[:-1]))
    assert len(turns) >= 5
    assert all(np.abs(changes - turn).min() <= 3 for turn in turns)
