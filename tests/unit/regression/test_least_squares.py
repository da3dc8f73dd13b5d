"""Gauss-Newton on curves whose least squares are known."""

import numpy as np
import pytest

from slipwise.arrays import Array
from slipwise.regression.least_squares import (
    Bounds,
    LevenbergMarquardt,
    Move,
    Slopes,
    step_by_gauss_newton,
    step_within_bounds,
)

TIME = np.linspace(0.0, 2.0, 40)
WIDE = Bounds(np.array([-10.0, -10.0]), np.array([10.0, 10.0]), np.ones(2))


def residual(numbers: Array) -> Array:
    """Give a decaying curve less that of 2 exp(-3 t)."""
    return numbers[0] * np.exp(-numbers[1] * TIME) - 2.0 * np.exp(-3.0 * TIME)


def slopes(numbers: Array) -> Slopes:
    decay = np.exp(-numbers[1] * TIME)
    jacobian = np.stack([decay, -numbers[0] * TIME * decay], axis=1)
    return Slopes(jacobian, jacobian.T @ jacobian)


def fit(start: list[float], bounds: Bounds, most: int = 60) -> Array:
    rule = LevenbergMarquardt(bounds)

    def move(here: Array, linear: Slopes) -> Move[Array]:
        found = rule.step(here, residual(here), linear, lambda there: (there, residual(there)))
        return Move(None) if found is None else Move(found[0], finished=found[1] < 1e-20, keep_slopes=found[2])

    return step_by_gauss_newton(np.array(start), slopes, move, most=most)[0]


@pytest.mark.parametrize("start", [[1.0, 1.0], [5.0, 6.0], [0.1, 0.1]])
def test_a_decaying_curve_is_found_from_far(start: list[float]) -> None:
    np.testing.assert_allclose(fit(start, WIDE), [2.0, 3.0], rtol=1e-6)


def test_a_number_that_would_leave_its_bounds_ends_on_them_and_the_others_make_up_for_it() -> None:
    found = fit([1.0, 1.0], Bounds(np.array([-10.0, -10.0]), np.array([10.0, 2.0]), np.ones(2)))
    decay = np.exp(-2.0 * TIME)
    best = decay @ (2.0 * np.exp(-3.0 * TIME)) / (decay @ decay)  # linear in the first number
    np.testing.assert_allclose(found, [best, 2.0], rtol=1e-6)


def test_a_number_that_spans_decades_changes_by_a_factor_of_three_in_one_step() -> None:
    bounds = Bounds(np.array([1e-3, -1.0]), np.array([1e3, 1.0]), np.ones(2))
    low, high = bounds.near(np.array([6.0, 0.5]))
    np.testing.assert_allclose(low, [2.0, -1.0])
    np.testing.assert_allclose(high, [18.0, 1.0])


def test_the_undamped_step_of_a_linear_problem_is_its_solution() -> None:
    rng = np.random.default_rng(1)
    matrix, right = rng.normal(size=(20, 3)), rng.normal(size=20)
    far = np.full(3, 1e9)
    step = step_within_bounds(matrix.T @ matrix, matrix.T @ right, 0.0, np.zeros(3), -far, far, np.ones(3))
    np.testing.assert_allclose(step, -np.linalg.lstsq(matrix, right, rcond=None)[0], rtol=1e-9)


def test_numbers_that_nothing_depends_on_stay_where_they_are() -> None:
    normal, gradient = np.diag([4.0, 0.0]), np.array([2.0, 0.0])
    far = np.full(2, 1e9)
    step = step_within_bounds(normal, gradient, 1e-6, np.zeros(2), -far, far, np.ones(2))
    np.testing.assert_allclose(step, [-0.5, 0.0], atol=1e-5)


def test_where_no_step_is_better_the_start_is_given_back() -> None:
    assert np.array_equal(fit([2.0, 3.0], WIDE), [2.0, 3.0])


def test_moves_end_after_the_most_that_are_allowed_and_the_end_can_be_linearised() -> None:
    seen: list[float] = []

    def linearise(point: float) -> float:
        seen.append(point)
        return 0.0

    end, _ = step_by_gauss_newton(0.0, linearise, lambda p, _: Move(p + 1.0), most=3, linearised_end=True)
    assert end == 3.0 and seen == [0.0, 1.0, 2.0, 3.0]
    seen.clear()
    step_by_gauss_newton(0.0, linearise, lambda p, _: Move(p + 1.0), most=3)
    assert seen == [0.0, 1.0, 2.0]
