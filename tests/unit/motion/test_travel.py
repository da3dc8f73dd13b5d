"""How far the table goes: closed forms, and the warning when that is too far."""

import warnings

import numpy as np
import pytest

from slipwise.errors import SettingError, SlipwiseWarning
from slipwise.motion import (
    TableMotion,
    displacement_peak,
    parse_motion,
    table_displacement,
    velocity_peak,
    warn_beyond_stroke,
)


def test_a_steady_sine_goes_a_over_omega_squared():
    motion = parse_motion("sine:2Hz,0.3g,cycles=40,vertical=5Hz,0.2g")
    omega, a = 2 * np.pi * np.array([2.0, 5.0]), 9.80665 * np.array([0.3, 0.2])
    inside = (motion.time > motion.steady.start) & (motion.time < motion.steady.end)
    travel = table_displacement(motion, "none")[inside][:, [0, 2]]
    np.testing.assert_allclose(np.abs(travel).max(axis=0), a / omega**2, rtol=1e-4)
    np.testing.assert_allclose(velocity_peak(motion, "none")[[0, 2]], a / omega, rtol=5e-3)


def test_a_recorders_offset_and_a_start_in_motion_do_not_become_travel():
    t = np.arange(4001) * 0.005
    values = np.stack([np.sin(2 * np.pi * t), 0 * t, 0 * t], axis=1)
    clean = displacement_peak(TableMotion(0.005, values, "clean", ("a", "", "")))
    drifting = displacement_peak(TableMotion(0.005, values + 0.01, "offset", ("a", "", "")))
    assert clean[0] == pytest.approx(1 / (2 * np.pi) ** 2, rel=0.05)
    # A constant 0.01 m/s2 over 20 s would be 2 m; taken as a line from the velocity it is gone.
    assert drifting[0] == pytest.approx(clean[0], rel=1e-3)


def test_a_motion_beyond_the_stroke_is_warned_of_and_one_within_is_not():
    motion = parse_motion("sine:1Hz,0.3g,vertical=5Hz,0.1g")
    with pytest.warns(SlipwiseWarning, match=r"74\.\d mm in x, its stroke is 50\.0 mm"):
        warn_beyond_stroke(motion, 0.05)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_beyond_stroke(motion, 0.08)


@pytest.mark.parametrize("stroke", [0.0, -1.0, float("nan")])
def test_a_stroke_must_be_positive(stroke):
    with pytest.raises(SettingError, match="stroke"):
        warn_beyond_stroke(parse_motion("quake:seed=1"), stroke)
