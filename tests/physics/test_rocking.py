"""Shape of the loops: trapezoids at the pads, a sagging rectangle in the sum (physics of rocking)."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import G, shaken, sine
from slipwise.model import base_model

S, N, K, ALPHA = 1.379e6, 19.7, 0.102e-6, 0.046


def edge_slope(record, pad, fast=0.1):
    """Slope of a pad's friction against slip [N/m] on the branches on which it slides faster than `fast` [m/s].

    The part of the strength that speed has not added yet is filled up, so that the slope is the load's alone.
    """
    late = record.time > record.time[-1] / 2
    area = np.pi * 0.0215**2
    slopes = []
    for sign in (1.0, -1.0):
        branch = late & (sign * record["slip_vx"] > fast)
        saturated = 1 - np.exp(-K * record[f"pad_{pad}_N"][branch] / area)
        missing = area * S * saturated * np.exp(-N * np.abs(record["slip_vx"][branch]))
        force = record[f"pad_{pad}_Fx"][branch] + sign * missing
        slopes.append(np.polyfit(record["slip_x"][branch], force, 1)[0])
    return np.array(slopes)


@pytest.mark.parametrize(
    ("rig", "frequency", "amplitude", "on_girder", "on_table"),
    [("bridge1", 2.0, 0.3, 0.0150e6, 0.0162e6), ("bridge2", 1.6, 0.25, 0.0195e6, 0.0207e6)],
)
def test_the_edges_of_the_trapezoid_slope_as_rocking_says(rig, frequency, amplitude, on_girder, on_table):
    model = base_model(rig)
    for side, expected in (("girder", on_girder), ("table", on_table)):
        specimen = replace(model.specimen, pads_on=side)
        record = shaken(replace(model, specimen=specimen), sine(frequency, amplitude * G, 12.0)).record
        slopes = np.concatenate([edge_slope(record, "A"), -edge_slope(record, "B")])
        # On the way out pad A is loaded (upper branch rises), on the way back its friction is negative and falls.
        assert np.abs(slopes).mean() == pytest.approx(expected, rel=0.05), side


@pytest.mark.parametrize(("swing", "deficit"), [(0.2, 0.0077), (0.6, 0.075)])
def test_the_sum_of_the_loops_lacks_what_the_concave_law_says(swing, deficit):
    from slipwise.simulation.predict import predictor

    model = base_model("bridge1")
    load0 = model.specimen.weight / 4
    n = 2
    load = load0 * (1 + swing * np.array([[1, -1, 1, -1]] * n))
    velocity = np.zeros((n, 4, 2))
    velocity[:, :, 0] = 5.0
    time = np.arange(n) * 1e-3
    rocked = predictor(model).pads(time, load, velocity, np.zeros((n, 4, 2))).force[-1, :, 0].sum()
    flat = predictor(model).pads(time, np.full((n, 4), load0), velocity, np.zeros((n, 4, 2))).force[-1, :, 0].sum()
    assert 1 - rocked / flat == pytest.approx(deficit, rel=0.1)


def test_the_girder_replay_shows_the_same_deficit_as_its_own_load_swing():
    # The deficit of the sum at each instant follows from the swing at that instant: s' phi exp(-kP0)(cosh kd - 1).
    record = shaken(base_model("bridge2"), sine(1.6, 0.28 * G, 12.0)).record
    fast = (record.time > 6.0) & (np.abs(record["slip_vx"]) > 0.15)
    area = np.pi * 0.0215**2
    loads = record.stacked("pad_{}_N")[fast]
    mean, half = loads.mean(axis=1) / area, (loads[:, 0] - loads[:, 1]) / 2 / area
    phi = 1 - np.exp(-N * np.abs(record["slip_vx"][fast]))
    flat = 4 * area * (S * phi * (1 - np.exp(-K * mean)) + ALPHA * mean)
    force = np.abs(record.stacked("pad_{}_Fx")[fast].sum(axis=1))
    expected = 4 * area * S * phi * np.exp(-K * mean) * (np.cosh(K * half) - 1)
    assert (flat - force).mean() == pytest.approx(expected.mean(), rel=0.1)


def test_pads_on_opposite_sides_rock_against_each_other_and_more_with_a_higher_centre():
    swings = {}
    for rig, frequency in (("bridge1", 2.0), ("bridge2", 1.6)):
        record = shaken(base_model(rig), sine(frequency, 0.25 * G, 8.0)).record
        late = record.time > 4.0
        a, b = record["pad_A_N"][late], record["pad_B_N"][late]
        assert np.corrcoef(a, b)[0, 1] < -0.999
        swings[rig] = np.ptp(a) / np.ptp(record["girder_ax"][late])
    assert swings["bridge2"] > 1.5 * swings["bridge1"]
