"""A curve is described without a form: which way it goes, how it ends, and its values there."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.discovery.curve_shape import CurveShape, describe_curve
from slipwise.residual_map.curve import ResidualCurve, fit_curve
from slipwise.residual_map.splines import SplineBasis, choose_knots
from slipwise.residual_map.states import DrivingState

RNG = np.random.default_rng(11)
SIZES, BOTH_SIGNS = RNG.uniform(0.0, 2.0, 8000), RNG.uniform(-2.0, 2.0, 8000)


def curve(over: np.ndarray, height: np.ndarray, knots: int = 14) -> ResidualCurve:
    residual = 10.0 * height + RNG.standard_normal(len(over))
    return fit_curve(SplineBasis((choose_knots(over, knots),), 1), (over,), np.full(len(over), 10.0), residual)


def shape(over: np.ndarray, height: np.ndarray, knots: int = 14) -> CurveShape:
    name = "slip" if over.min() < 0.0 else "speed"
    found = describe_curve(curve(over, height, knots), DrivingState(name, 0.0, ()))
    assert found is not None
    return found


def test_a_curve_that_decays_falls_and_levels_off_from_its_first_value() -> None:
    found = shape(SIZES, np.exp(-SIZES / 0.4))
    assert found.direction == "falls" and found.saturates and not found.begins_flat and not found.periodic
    (_, first, low, high), (_, last, *_) = found.ends
    assert low < first < high and first == pytest.approx(1.0, abs=0.1) and last == pytest.approx(0.0, abs=0.1)


def test_a_curve_that_begins_at_a_place_has_a_threshold() -> None:
    found = shape(SIZES, np.maximum(SIZES - 1.2, 0.0))
    assert found.direction == "rises" and found.begins_flat and not found.saturates


@pytest.mark.parametrize(
    ("height", "parity"), [(BOTH_SIGNS**2, "even"), (BOTH_SIGNS**3, "odd"), (BOTH_SIGNS + 1, "neither")]
)
def test_parity_is_told_of_a_state_that_takes_both_signs(height: np.ndarray, parity: str) -> None:
    assert shape(BOTH_SIGNS, height).parity == parity
    assert shape(SIZES, SIZES).parity == ""


def test_a_curve_that_repeats_is_no_curve_that_rises() -> None:
    found = shape(BOTH_SIGNS, np.sin(9.0 * BOTH_SIGNS), knots=50)
    assert found.periodic and found.direction == "neither"


def test_noise_has_no_direction() -> None:
    assert shape(SIZES, 0.0 * SIZES).direction == "flat"


def test_over_two_states_there_is_no_such_description() -> None:
    splines = SplineBasis((np.linspace(0.0, 2.0, 4), np.linspace(-2.0, 2.0, 4)), 1)
    found = fit_curve(splines, (SIZES, BOTH_SIGNS), np.ones(len(SIZES)), SIZES * BOTH_SIGNS)
    assert describe_curve(found, DrivingState("speed", 0.0, ())) is None


def test_a_curve_whose_mean_base_numbers_make_up_for_is_counted_from_it() -> None:
    found = curve(SIZES, 0.3 * SIZES * (2.0 - SIZES))
    normal, drive = found.normal[0], found.drive[0]
    along, pull = normal.sum(axis=1), float(drive.sum())
    taken = 0.9999 / float(along.sum())
    made_up = replace(
        found, normal=(normal - taken * np.outer(along, along))[None], drive=(drive - taken * along * pull)[None]
    )
    told = describe_curve(made_up, DrivingState("speed", 0.0, ()))
    assert told is not None and told.about_mean and told.direction == "neither"
    (_, lowest), (place, highest) = told.extremes
    assert lowest < 0.0 < highest and place == pytest.approx(1.0, abs=0.3)
    assert "counted from its mean" in told.words
    assert all(low < value < high for _, value, low, high in told.ends)
