"""Curves over states: what they find, and that noise carries nothing over."""

import numpy as np
import pytest

from slipwise.residual_map.curve import ResidualCurve
from slipwise.residual_map.field import ResidualField
from slipwise.residual_map.splines import SplineBasis, choose_equal_bins, choose_knots

RNG = np.random.default_rng(7)
STATE, GROUP = RNG.uniform(0.0, 2.0, 6000), np.repeat(np.arange(4), 1500)


def field(residual: np.ndarray) -> ResidualField:
    return ResidualField("pads", residual, np.ones(len(residual)), GROUP, {}, 1)


def pieces(made: ResidualField, state: np.ndarray = STATE, count: int = 16) -> ResidualCurve:
    return made.fit(SplineBasis((choose_knots(state, count),), degree=1), (state,))


def test_straight_pieces_add_up_to_one_and_are_straight_between_knots() -> None:
    knots = choose_knots(STATE, 9)
    found = SplineBasis((knots,), degree=1).columns((STATE,))
    np.testing.assert_allclose(found.sum(axis=1), 1.0)
    np.testing.assert_allclose(found @ knots, STATE, atol=1e-12)


@pytest.mark.parametrize("degree", [0, 1])
def test_splines_over_a_plane_add_up_to_one_and_each_state_goes_along_its_own_side(degree: int) -> None:
    other = RNG.uniform(-1.0, 1.0, len(STATE))
    splines = SplineBasis((choose_knots(STATE, 5), choose_knots(other, 4)), degree)
    found = splines.columns((STATE, other))
    assert found.shape == (len(STATE), np.prod(splines.shape))
    np.testing.assert_allclose(found.sum(axis=1), 1.0)
    for place, (state, knots) in enumerate(zip((STATE, other), splines.knots, strict=True)):
        alone = SplineBasis((knots,), degree).columns((state,)).toarray()
        side = found.toarray().reshape(-1, *splines.shape).sum(axis=2 - place)
        np.testing.assert_allclose(side, alone, atol=1e-12)


def test_the_heights_of_bins_are_means_with_their_standard_errors() -> None:
    edges = choose_equal_bins(STATE, 5)
    left = 3.0 * STATE + RNG.standard_normal(len(STATE))
    found = field(left).fit(SplineBasis((edges,), degree=0), (STATE,))
    bins = [left[(STATE >= low) & (STATE < high)] for low, high in zip(edges[:-1], edges[1:], strict=True)]
    bins[-1] = left[STATE >= edges[-2]]
    np.testing.assert_allclose(found.heights(), [b.mean() for b in bins], rtol=1e-5)
    np.testing.assert_allclose(found.errors(), [b.std(ddof=1) / np.sqrt(len(b)) for b in bins], rtol=1e-5)
    np.testing.assert_allclose(found.errors(4.0), 2.0 * found.errors())


def test_bins_of_a_state_that_takes_both_signs_are_split_at_zero() -> None:
    edges = choose_equal_bins(STATE - 0.3, 4, split=True)
    assert 0.0 in edges and len(edges) == 6
    assert 0.0 not in choose_equal_bins(STATE + 0.3, 4, split=True)


def test_the_errors_are_those_of_a_curve_that_is_fitted_many_times() -> None:
    made = [pieces(field(RNG.standard_normal(len(STATE))), count=8) for _ in range(60)]
    spread = np.std([m.heights() for m in made], axis=0)
    np.testing.assert_allclose(np.mean([m.errors() for m in made], axis=0), spread, rtol=0.35)


def test_a_curve_takes_what_goes_with_its_state_and_carries_over() -> None:
    made = field(5.0 * np.sin(3.0 * STATE) + RNG.standard_normal(len(STATE)))
    found, excess = pieces(made), float(made.residual @ made.residual) - len(STATE)
    assert found.gain / excess == pytest.approx(1.0, abs=0.02)
    assert found.carried_over() / excess == pytest.approx(1.0, abs=0.02)
    np.testing.assert_allclose(found.heights(), 5.0 * np.sin(3.0 * found.knots[0]), atol=0.6)


def test_noise_gains_as_much_as_it_has_knots_and_carries_nothing_over() -> None:
    found = pieces(field(RNG.standard_normal(len(STATE))))
    assert 4.0 < found.gain < 40.0 and found.carried_over() < 10.0


def test_what_only_tells_one_motion_from_another_carries_nothing_over() -> None:
    offsets = np.array([3.0, -2.0, 1.0, -2.0])[GROUP]
    found = pieces(field(offsets + RNG.standard_normal(len(STATE))), GROUP + STATE / 20)
    assert found.gain > 10000.0 and found.carried_over() < 0.2 * found.gain


def test_the_gain_of_the_curve_itself_is_its_own() -> None:
    found = pieces(field(4.0 * STATE**2 + RNG.standard_normal(len(STATE))), count=12)
    gain, strength = found.gain_of(found.heights()[None])
    assert gain[0] == pytest.approx(found.gain, rel=1e-3) and strength[0] == pytest.approx(1.0, rel=1e-3)
