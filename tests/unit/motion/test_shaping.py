"""Scaled, trimmed, tapered: what the motion is afterwards, and that it says so."""

import numpy as np
import pytest

from slipwise.errors import InputError, SettingError
from slipwise.motion import (
    Steady,
    TableMotion,
    parse_motion,
    scale,
    scale_time,
    scale_to_peak,
    table_displacement,
    table_velocity,
    taper,
    treat_baseline,
    trim,
)


@pytest.fixture
def motion():
    t = np.arange(1001) * 0.01
    values = np.stack([np.sin(3 * t), 0 * t, 0.5 * np.cos(5 * t)], axis=1)
    return TableMotion(0.01, values, "test", ("a", "", "c"), ("made",), steady=Steady(2.0, 8.0, 1.0))


def test_similarity_keeps_accelerations_and_divides_time_by_the_root_of_length(motion):
    model = scale_time(motion, 10.69)
    np.testing.assert_array_equal(model.acceleration, motion.acceleration)
    assert model.duration == pytest.approx(motion.duration / np.sqrt(10.69))
    assert model.steady.period == pytest.approx(1 / np.sqrt(10.69))
    assert "similarity" in model.treatment[-1]


def test_similarity_divides_velocity_by_the_root_of_length_and_displacement_by_length():
    prototype = parse_motion("quake:seed=2,f=1Hz,strong=8s,vertical=0.1g")
    model = scale_time(prototype, 12.17)
    for integral, share in ((table_velocity, np.sqrt(12.17)), (table_displacement, 12.17)):
        np.testing.assert_allclose(integral(model, "none"), integral(prototype, "none") / share, atol=1e-12)


def test_scaling_keeps_the_ratio_of_the_components(motion):
    halved = scale(motion, 0.5)
    np.testing.assert_allclose(halved.acceleration, motion.acceleration / 2)
    to_peak = scale_to_peak(motion, 4.0, "z")
    assert to_peak.peaks[2] == pytest.approx(4.0)
    np.testing.assert_allclose(to_peak.acceleration, 8 * motion.acceleration, rtol=1e-12)
    assert halved.treatment == ("made", "accelerations scaled by 0.5")


def test_scaling_to_the_peak_of_an_axis_at_rest_or_by_nonsense_is_refused(motion):
    with pytest.raises(InputError, match="nothing moves in y"):
        scale_to_peak(motion, 1.0, "y")
    for call in (
        lambda: scale_to_peak(motion, 1.0, "w"),
        lambda: scale_to_peak(motion, -1.0),
        lambda: scale(motion, float("nan")),
        lambda: scale(motion, 0.0),
        lambda: scale_time(motion, 0.0),
    ):
        with pytest.raises(SettingError):
            call()


def test_trimming_keeps_the_samples_between_and_starts_at_zero(motion):
    part = trim(motion, 2.0, 5.0)
    assert len(part) == 301
    np.testing.assert_array_equal(part.acceleration, motion.acceleration[200:501])
    assert (part.steady.start, part.steady.end) == pytest.approx((0.0, 3.0))
    assert trim(motion, 8.5).steady is None
    assert len(trim(motion)) == len(motion)
    with pytest.raises(InputError, match=r"lasts 10 s"):
        trim(motion, 11.0, 12.0)


def test_a_baseline_is_taken_from_every_component(motion):
    drifting = TableMotion(0.01, motion.acceleration + motion.time[:, None] * 0.1 + 3, "t", ("a", "b", "c"))
    level = treat_baseline(drifting, "linear")
    for column in range(3):
        assert np.polyfit(level.time, level.acceleration[:, column], 1) == pytest.approx([0, 0], abs=1e-10)
    assert np.abs(treat_baseline(drifting, "mean").acceleration.mean(axis=0)).max() < 1e-12
    with pytest.raises(SettingError, match="mean, linear and none"):
        treat_baseline(drifting, "cubic")  # type: ignore[arg-type]


def test_a_taper_touches_only_the_ends(motion):
    ends = taper(motion, 1.0)
    assert np.all(ends.acceleration[[0, -1]] == 0)
    np.testing.assert_array_equal(ends.acceleration[100:901], motion.acceleration[100:901])
    assert ends.acceleration[50, 2] == pytest.approx(0.5 * motion.acceleration[50, 2])
    with pytest.raises(SettingError, match="at most half"):
        taper(motion, 6.0)


def test_shaping_leaves_the_given_motion_as_it_was(motion):
    before = motion.acceleration.copy()
    for shaped in (scale(motion, 2), trim(motion, 1, 2), taper(motion, 1), scale_time(motion, 4)):
        assert shaped.treatment[0] == "made"
    np.testing.assert_array_equal(motion.acceleration, before)
    assert motion.treatment == ("made",)
