"""Every number that follows from the paper's text alone, within its rounding; each test names its table."""

from itertools import pairwise

import numpy as np
import pytest

from slipwise.studies.paper import PaperSettings, change, paper_model
from slipwise.studies.paper.hysteresis import steady_loops
from slipwise.studies.paper.law import FAST, edge_slope, leftover, mu, per_load, vertical_loss
from slipwise.studies.paper.scaling import bridge_row, masses_that_round_to, unscaled

G = 9.80665
SETTINGS = PaperSettings()
ONE, TWO = (paper_model(bridge, SETTINGS) for bridge in ("bridge1", "bridge2"))


def test_pads_carry_the_stated_pressure_and_nothing_is_left_for_the_buffers():
    # 24.517 kN on 1452.2 mm2 is 16.882 MPa; 16.9 holds for 9.98 to 10.04 t.
    specimen = ONE.specimen
    assert specimen.weight / 4 == pytest.approx(24.517e3, abs=0.5)
    assert specimen.pad_area == pytest.approx(1452.2e-6, abs=0.05e-6)
    assert specimen.rated_pressure == pytest.approx(16.882e6, abs=500)
    low, high = masses_that_round_to(16.9e6, ONE)
    assert (low, high) == (pytest.approx(9.98e3, abs=5), pytest.approx(10.04e3, abs=5))
    assert low < specimen.mass < high


@pytest.mark.parametrize(
    ("bridge", "model", "time", "mass", "energy", "supported", "pad"),
    [("bridge1", ONE, 3.2696, 114.28, 1221.6, 1143, 0.460), ("bridge2", TWO, 3.4886, 148.11, 1802.5, 1481, 0.523)],
)
def test_scales_follow_from_length_acceleration_and_pressure(bridge, model, time, mass, energy, supported, pad):
    # Prototype over model.
    row = bridge_row(bridge, model)
    assert row["time"] == pytest.approx(time, abs=5e-5)
    assert row["velocity"] == row["time"]
    assert row["mass"] == row["force"] == pytest.approx(mass, abs=5e-3)
    assert row["energy"] == pytest.approx(energy, abs=0.05)
    assert row["stiffness"] == row["length"]
    assert row["supported_mass"] / 1e3 == pytest.approx(supported, abs=0.5)
    assert row["pad_diameter"] == pytest.approx(pad, abs=5e-4)


@pytest.mark.parametrize(
    ("bridge", "model", "each", "both", "period", "prototype", "single", "single_prototype"),
    [("bridge1", ONE, 1.7306, 3.4612, 0.3377, 1.104, 0.4776, 1.562),
     ("bridge2", TWO, 1.1257, 2.2514, 0.4187, 1.461, 0.5922, 2.066)],
)  # fmt: skip
def test_buffers_and_periods(bridge, model, each, both, period, prototype, single, single_prototype):
    # Model buffers.
    row = bridge_row(bridge, model)
    assert row["buffer_each"] / 1e6 == pytest.approx(each, abs=5e-5)
    assert row["buffers"] / 1e6 == pytest.approx(both, abs=1.01e-4)
    assert row["period_model"] == pytest.approx(period, abs=5e-5)
    assert row["period_prototype"] == pytest.approx(prototype, abs=5e-4)
    assert row["period_one_buffer"] == pytest.approx(single, abs=5e-5)
    assert row["period_one_buffer"] * row["time"] == pytest.approx(single_prototype, abs=5e-4)


def test_mu_over_pressure_and_what_load_does_to_friction():
    # mu and dF/dN over P; and local exponents.
    pressure = np.array([1e-6, 2, 5, 10, 16.88, 25, 50]) * 1e6
    assert mu(ONE, pressure, FAST) == pytest.approx([0.1867, 0.1732, 0.1562, 0.1342, 0.1131, 0.0969, 0.0734], abs=5e-5)
    slopes = [0.1867, 0.1607, 0.1305, 0.0967, 0.0711, 0.0570, 0.0469]
    assert per_load(ONE, pressure) == pytest.approx(slopes, abs=6e-5)
    tested = np.array([5, 10, 16.9, 25]) * 1e6
    exponents = per_load(ONE, tested) / mu(ONE, tested, FAST)
    assert exponents == pytest.approx([0.835, 0.721, 0.629, 0.588], abs=6e-4)


@pytest.mark.parametrize(
    ("unit", "expected"),
    [("s/cm", [0.0523, 0.0580, 0.0678, 0.0880, 0.1037, 0.1118, 0.1129]),
     ("s/mm", [0.0880, 0.1037, 0.1118, 0.1131, 0.1131, 0.1131, 0.1131])],
)  # fmt: skip
def test_mu_over_speed_in_both_readings_of_n(unit, expected):
    # mu over V.
    model = paper_model("bridge1", PaperSettings(n_unit=unit))
    speed = np.array([0.5, 1, 2, 5, 10, 20, 30]) * 1e-2
    assert mu(model, model.specimen.rated_pressure, speed) == pytest.approx(expected, abs=6e-5)


def test_total_friction_and_the_width_of_the_stick_band():
    # 11.09 kN fast, 4.51 kN slow; F/k = 3.20 and 4.93 mm; 532 kN cm is a path of 48.0 cm.
    rated, weight = ONE.specimen.rated_pressure, ONE.specimen.weight
    fast, slow = float(mu(ONE, rated, FAST)) * weight, float(mu(ONE, rated, 0.0)) * weight
    assert (fast, slow) == (pytest.approx(11.09e3, abs=5), pytest.approx(4.51e3, abs=5))
    assert fast / sum(ONE.specimen.buffer_stiffness) == pytest.approx(3.20e-3, abs=5e-6)
    assert fast / sum(TWO.specimen.buffer_stiffness) == pytest.approx(4.93e-3, abs=5e-6)
    assert 5320.0 / fast == pytest.approx(0.480, abs=5e-4)


@pytest.mark.parametrize(
    ("bridge", "model", "swing", "uplift"), [("bridge1", ONE, 4.12, 4.10), ("bridge2", TWO, 8.24, 2.05)]
)
def test_rocking_per_g_and_the_acceleration_that_lifts_a_pad(bridge, model, swing, uplift):
    # Swing of pressure.
    row = bridge_row(bridge, model)
    assert row["pressure_per_g"] / 1e6 == pytest.approx(swing, abs=5e-3)
    assert row["uplift"] == pytest.approx(uplift, abs=5e-3)


def test_edges_of_the_trapezoids():
    # 0.0150 and 0.0195 kN/mm; with P-delta 0.0162 and 0.0207; constant mu 0.0239 and 0.0311.
    assert [edge_slope(m, p_delta=False) / 1e6 for m in (ONE, TWO)] == pytest.approx([0.0150, 0.0195], abs=5.5e-5)
    assert [edge_slope(m, p_delta=True) / 1e6 for m in (ONE, TWO)] == pytest.approx([0.0162, 0.0207], abs=5.5e-5)
    coulomb = [
        edge_slope(m, p_delta=False)
        * float(mu(m, m.specimen.rated_pressure, FAST) / per_load(m, np.array([m.specimen.rated_pressure]))[0])
        for m in (ONE, TWO)
    ]
    assert np.array(coulomb) / 1e6 == pytest.approx([0.0239, 0.0311], abs=5.5e-5)


def test_buffers_at_the_height_of_the_centre_leave_no_trapezoid():
    # With zb = h only friction loads the pads, and the loops are offset rectangles.
    half = paper_model("bridge1", change(SETTINGS, ["buffer_height=0.183 m", "pads_on=girder"]))
    whole = paper_model("bridge1", change(SETTINGS, ["buffer_height=0.366 m", "pads_on=girder"]))
    slope = edge_slope(ONE, p_delta=False)
    assert edge_slope(half, p_delta=False) == pytest.approx(0.5 * slope, rel=1e-9)
    assert edge_slope(whole, p_delta=False) == pytest.approx(0.0, abs=1e-9 * slope)
    pads, _, _ = steady_loops(half)
    assert np.mean([abs(pad.edge_slope) for pad in pads.values()]) == pytest.approx(0.5 * slope, rel=0.05)
    pads, _, _ = steady_loops(whole)
    assert np.mean([abs(pad.edge_slope) for pad in pads.values()]) < 0.1 * slope


def test_what_rocking_takes_from_the_sum():
    # The deficit over d/P0; 10 MPa is 0.6 there.
    swings = np.array([0.05, 0.1, 0.2, 0.3, 0.5, 0.6, 0.8, 1.0])
    expected = np.array([0.05, 0.19, 0.77, 1.8, 5.1, 7.5, 14.3, 24.4]) / 100
    rounding = np.array([0.005, 0.005, 0.005, 0.05, 0.05, 0.05, 0.05, 0.05]) / 100
    assert np.all(np.abs(leftover(ONE, swings) - expected) <= 1.01 * rounding)


def test_the_deficit_vanishes_at_rest_and_grows_with_speed():
    lost = [float(leftover(ONE, np.array([0.5]), speed)[0]) for speed in (1e-9, 0.02, 0.1, 1.0)]
    assert lost[0] == pytest.approx(0.0, abs=1e-8)
    assert all(a < b for a, b in pairwise(lost))


def test_vertical_motion_costs_a_second_order_of_friction():
    # -0.05, -0.19, -0.77 % at rms 0.05, 0.1, 0.2 g to second order; the Gaussian mean adds the fourth.
    loss = vertical_loss(ONE, np.array([0.05, 0.1, 0.2]) * G)
    k_p = 0.102e-6 * ONE.specimen.rated_pressure
    second = -0.5 * k_p**2 * np.exp(-k_p) * 1.379e6 * np.array([0.05, 0.1, 0.2]) ** 2
    second /= float(mu(ONE, ONE.specimen.rated_pressure, FAST)) * ONE.specimen.rated_pressure
    assert second == pytest.approx([-0.0005, -0.0019, -0.0077], abs=6e-5)
    x = 0.5 * (k_p * np.array([0.05, 0.1, 0.2])) ** 2  # of a Gaussian: exp(x) - 1 instead of x
    assert loss == pytest.approx(second * np.expm1(x) / x, rel=1e-4)


def test_what_does_not_scale():
    # The model heats 0.17 of Bridge 1.
    lost = unscaled("bridge1", ONE)
    assert lost["heating_model_over_bridge"] == pytest.approx(0.17, abs=5e-3)
    assert lost["speed_saturation"] > 1.1
