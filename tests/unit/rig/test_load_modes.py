"""Factor A, Factor B and the four modes against statics by hand."""

import numpy as np
import pytest

from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.rig.load_basis import load_basis
from slipwise.rig.load_modes import load_factors, load_modes, pad_loads, rest_shares, rigid_modes

MASS, GRAVITY, HEIGHT, HALF = 10e3, 9.80665, 0.366, (1.5, 2.5)
SIGN_X, SIGN_Y = np.array([1, -1, 1, -1]), np.array([1, 1, -1, -1])
BASIS = load_basis(list(zip(1.5 * SIGN_X, 2.5 * SIGN_Y, strict=True)))


def rig(az: np.ndarray, ax: np.ndarray, warp: float = 0.0, drop: float = 0.0) -> Record:
    """A rigid girder on pads of equal share: N = m (g + az) / 4 -+ m ax h / (4 half spacing) + warp."""
    heave = MASS * (GRAVITY + az) - drop
    loads = heave[:, None] / 4 - np.outer(MASS * ax * HEIGHT / HALF[0], SIGN_X) / 4 + warp * SIGN_X * SIGN_Y
    channels = {f"pad_{pad}_N": loads[:, i] for i, pad in enumerate("ABCD")}
    time = np.arange(len(az)) * 0.005
    return Record(time, {**channels, "girder_az": az, "girder_ax": ax, "table_az": az})


TIME = np.arange(400) * 0.005
QUIET_START = np.where(TIME < 0.5, 0.0, 1.0)
AZ = 3.0 * np.sin(8.0 * TIME) * QUIET_START
AX = 6.0 * np.sin(5.0 * TIME) * QUIET_START


def test_modes_and_loads_are_two_views_of_the_same_forces() -> None:
    loads = np.random.default_rng(2).normal(25e3, 3e3, (50, 4))
    np.testing.assert_allclose(pad_loads(load_modes(loads, BASIS), BASIS), loads, rtol=1e-12)


def test_each_mode_is_its_own_pattern_of_pads() -> None:
    for row, pattern in zip("heave pitch roll warp".split(), (SIGN_X**2, SIGN_X, SIGN_Y, SIGN_X * SIGN_Y), strict=True):
        modes = load_modes(pattern[None, :].astype(float), BASIS)
        assert [float(np.ravel(getattr(modes, name))[0]) for name in ("heave", "pitch", "roll", "warp")] == [
            4.0 * (name == row) for name in ("heave", "pitch", "roll", "warp")
        ]


def test_a_rigid_girder_leaves_nothing_beside_inertia_and_rocking() -> None:
    factors = load_factors(rig(AZ, AX), MASS, GRAVITY, BASIS)
    np.testing.assert_allclose(factors.shares, 0.25, rtol=1e-12)
    np.testing.assert_allclose(factors.inertia, np.outer(MASS * (GRAVITY + AZ), factors.shares))
    np.testing.assert_allclose(factors.rocking[:, 0], -MASS * AX * HEIGHT / HALF[0] / 4, atol=1e-8)
    np.testing.assert_allclose(factors.rest, 0.0, atol=1e-8)
    np.testing.assert_allclose(factors.inertia_swing, np.ptp(AZ) / 2 / GRAVITY)


def test_rocking_swing_is_twice_the_acceleration_in_g_times_slenderness() -> None:
    """docs/theory.md, section 1.2: |dN| / N0 = 2 (|a| / g) (h / b)."""
    factors = load_factors(rig(AZ, AX), MASS, GRAVITY, BASIS)
    expected = 2.0 * (np.ptp(AX) / 2 / GRAVITY) * HEIGHT / (2 * HALF[0])
    np.testing.assert_allclose(factors.rocking_swing, expected, rtol=1e-9)


def test_another_path_of_the_load_and_a_moving_warp_show_in_the_rest() -> None:
    plain = load_factors(rig(AZ, AX), MASS, GRAVITY, BASIS)
    lifted = load_factors(rig(AZ, AX, drop=4000.0), MASS, GRAVITY, BASIS, shares=plain.shares)
    np.testing.assert_allclose(lifted.rest, -1000.0, atol=1e-8)
    warped = load_factors(rig(AZ, AX, warp=500.0), MASS, GRAVITY, BASIS, shares=plain.shares)
    np.testing.assert_allclose(warped.rest[:, 1], -500.0, atol=1e-8)
    np.testing.assert_allclose(warped.rocking, plain.rocking, atol=1e-8)


def test_unequal_seating_at_rest_sets_the_shares() -> None:
    shares = rest_shares(rig(AZ, AX, warp=2451.6625))
    np.testing.assert_allclose(shares, [0.275, 0.225, 0.225, 0.275], rtol=1e-9)


def test_a_record_that_begins_in_motion_takes_shares_from_its_mean() -> None:
    shaken = rig(3.0 + 0.0 * AZ, AX)
    mean = shaken.stacked("pad_{}_N").mean(axis=0)
    np.testing.assert_allclose(rest_shares(shaken), mean / mean.sum())


def test_equilibrium_predicts_the_modes_of_a_rigid_girder() -> None:
    record = rig(AZ, AX)
    measured, rigid = load_modes(record.stacked("pad_{}_N"), BASIS), rigid_modes(record, MASS, GRAVITY, HEIGHT, HALF)
    np.testing.assert_allclose(measured.heave, rigid.heave)
    np.testing.assert_allclose(measured.pitch, rigid.pitch, atol=1e-8)


def test_weight_moves_over_pads_that_stand_on_the_table() -> None:
    """The slipped girder weighs on one side: dN = m g x / (2 b) = 0.33 kN a pad at 20 mm and b = 3 m."""
    still = rig(0.0 * AZ, 0.0 * AX).replaced(slip_x=np.full(len(AZ), 0.020))
    moved = rigid_modes(still, MASS, GRAVITY, HEIGHT, HALF)
    assert moved.pitch[0] / 4 == pytest.approx(0.02 * MASS * GRAVITY / (2 * 3.0))
    assert moved.pitch[0] / 4 == pytest.approx(330.0, abs=5.0)
    travelling = rigid_modes(still, MASS, GRAVITY, HEIGHT, HALF, pads_on="girder")
    assert np.all(travelling.pitch == 0.0)


def test_two_edges_stand_in_for_the_centre_and_nothing_at_all_is_said() -> None:
    record = rig(AZ, AX)
    edges = dict(record.channels)
    az = edges.pop("girder_az")
    turned = Record(record.time, {**edges, "girder_az_1": az + 1.0, "girder_az_2": az - 1.0})
    np.testing.assert_allclose(
        load_factors(turned, MASS, GRAVITY, BASIS).inertia, load_factors(record, MASS, GRAVITY, BASIS).inertia
    )
    with pytest.raises(InputError, match="girder_az"):
        load_factors(Record(record.time, edges), MASS, GRAVITY, BASIS)
