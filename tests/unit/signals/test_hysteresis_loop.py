"""Loop shapes against closed forms: rectangle, trapezoid, ellipse."""

import numpy as np
import pytest

from slipwise.errors import InputError, SettingError
from slipwise.signals.hysteresis_loop import branches, energy, loop_shape

HALF, LEVEL, SLOPE = 0.02, 2500.0, 15000.0


def cycles(count: float, n: int = 4000) -> tuple[np.ndarray, np.ndarray]:
    phase = np.linspace(0.0, 2.0 * np.pi * count, int(n * count) + 1)
    return -HALF * np.cos(phase), phase


def test_a_rectangle_has_no_slope_is_flat_and_has_sharp_corners() -> None:
    slip, phase = cycles(3)
    shape = loop_shape(slip, LEVEL * np.sign(np.sin(phase + 1e-9)))
    assert shape.edge_slope == pytest.approx(0.0, abs=1e-6)
    assert shape.flatness == pytest.approx(1.0, abs=1e-9)
    assert shape.corner_sharpness == pytest.approx(1.0, abs=1e-3)
    assert shape.energy_per_cycle == pytest.approx(4.0 * LEVEL * HALF, rel=1e-3)
    assert shape.energy == pytest.approx(3.0 * 4.0 * LEVEL * HALF, rel=1e-3)
    assert shape.cycles == pytest.approx(3.0)
    assert shape.half_range == pytest.approx(HALF)


def test_a_trapezoid_gives_back_its_slope_its_levels_and_its_area() -> None:
    slip, phase = cycles(2)
    growing = np.sin(phase + 1e-9) > 0
    force = np.where(growing, 1.1 * LEVEL, -0.9 * LEVEL) + np.where(growing, SLOPE, -SLOPE) * slip
    shape = loop_shape(slip, force)
    assert shape.edge_slope == pytest.approx(SLOPE, rel=1e-9)
    assert shape.force_up == pytest.approx(1.1 * LEVEL, rel=1e-9)
    assert shape.force_down == pytest.approx(0.9 * LEVEL, rel=1e-9)
    # The slope adds as much at one end as it takes at the other.
    assert shape.energy_per_cycle == pytest.approx(4.0 * LEVEL * HALF, rel=1e-3)
    assert shape.corner_sharpness == pytest.approx(1.0, abs=1e-3)
    # rms of a straight line over the fast part, |x| < sqrt(3)/2 of the half range where speed is above one half.
    fast = HALF * np.sqrt(3.0) / 2.0
    assert shape.flatness == pytest.approx(1.0 - SLOPE * fast / np.sqrt(3.0) / LEVEL, abs=1e-3)


def test_an_ellipse_has_round_corners_by_the_area_of_the_ellipse() -> None:
    slip, phase = cycles(1)
    shape = loop_shape(slip, LEVEL * np.sin(phase))
    u = np.sqrt(3.0) / 2.0
    mean_over_the_fast_part = (u * np.sqrt(1 - u**2) + np.arcsin(u)) / (2.0 * u)
    assert shape.energy == pytest.approx(np.pi * LEVEL * HALF, rel=1e-5)
    assert shape.corner_sharpness == pytest.approx(np.pi / 4.0 / mean_over_the_fast_part, rel=1e-3)
    assert shape.edge_slope == pytest.approx(0.0, abs=1e-6)


def test_slope_does_not_depend_on_how_the_speed_runs_along_the_branch() -> None:
    slip, phase = cycles(4)
    uneven = slip + 0.004 * np.sin(2.0 * phase)
    growing = branches(uneven) > 0
    force = np.append(np.where(growing, 1.0, -1.0), -1.0) * (LEVEL + SLOPE * uneven)
    assert loop_shape(uneven, force).edge_slope == pytest.approx(SLOPE, rel=2e-3)


def test_a_spring_dissipates_nothing_over_whole_cycles() -> None:
    slip, _ = cycles(2)
    assert energy(slip, 1e6 * slip) == pytest.approx(0.0, abs=1e-9)


def test_a_mirrored_motion_has_the_same_shape_with_its_levels_swapped() -> None:
    slip, phase = cycles(2)
    growing = np.sin(phase + 1e-9) > 0
    force = np.where(growing, 1.2, -0.8) * LEVEL
    shape, mirrored = loop_shape(slip, force), loop_shape(-slip, -force)
    assert mirrored.energy == pytest.approx(shape.energy)
    assert (mirrored.force_up, mirrored.force_down) == pytest.approx((shape.force_down, shape.force_up))


def test_noise_of_a_slip_gauge_does_not_make_cycles() -> None:
    slip, phase = cycles(3, n=1000)
    noisy = slip + np.random.default_rng(1).normal(0.0, 2e-5, slip.shape)
    assert loop_shape(noisy, LEVEL * np.sign(np.sin(phase))).cycles == pytest.approx(3.0, rel=0.01)


def test_branches_turn_where_slip_turns() -> None:
    slip = np.array([0.0, 1.0, 2.0, 1.5, -1.0, -0.5, 3.0])
    assert branches(slip).tolist() == [1, 1, -1, -1, 1, 1]
    assert branches(-slip).tolist() == [-1, -1, 1, 1, -1, -1]
    assert branches(np.zeros(4)).tolist() == [0, 0, 0]


def test_a_record_that_never_slides_back_has_no_loop() -> None:
    slip = np.linspace(0.0, HALF, 50)
    with pytest.raises(InputError, match="both ways"):
        loop_shape(slip, np.full(50, LEVEL))
    with pytest.raises(InputError, match="both ways"):
        loop_shape(np.zeros(50), np.zeros(50))


def test_unpaired_columns_and_a_silly_fraction_are_refused() -> None:
    with pytest.raises(SettingError, match="pairs"):
        loop_shape(np.zeros(5), np.zeros(6))
    with pytest.raises(SettingError, match="fraction"):
        loop_shape(np.zeros(5), np.zeros(5), fast=1.0)
