"""Normal equations by relation against all rows at once, and the projection beside them."""

import numpy as np
import pytest

from slipwise.regression.normal_equations import build_equations, get_left_over, invert_regularised, weigh_equations
from slipwise.regression.projection import make_projector

RNG = np.random.default_rng(3)
RESIDUAL = {"pads": RNG.normal(size=30), "girder": RNG.normal(size=20)}
BLOCKS = [
    {"pads": RNG.normal(size=(30, 2))},
    {"pads": RNG.normal(size=(30, 1)), "girder": RNG.normal(size=(20, 1))},
]
WEIGHT = {"pads": 0.5, "girder": 3.0}


@pytest.fixture
def stacked() -> tuple[np.ndarray, np.ndarray]:
    """Give all rows, weighed: columns (50, 3) and the residual (50,)."""
    matrix = np.zeros((50, 3))
    matrix[:30, :2], matrix[:30, 2:], matrix[30:, 2:] = BLOCKS[0]["pads"], BLOCKS[1]["pads"], BLOCKS[1]["girder"]
    weight = np.repeat([WEIGHT["pads"], WEIGHT["girder"]], [30, 20])
    return matrix * weight[:, None], np.concatenate(list(RESIDUAL.values())) * weight


def test_equations_by_relation_are_those_of_all_rows(stacked) -> None:
    parts, first = build_equations(BLOCKS, RESIDUAL)
    matrix, right = stacked
    squares, along = weigh_equations(parts, WEIGHT, 3)
    assert list(first) == [0, 2, 3]
    np.testing.assert_allclose(squares, matrix.T @ matrix)
    np.testing.assert_allclose(along, matrix.T @ right)
    solution = invert_regularised(squares) @ along
    np.testing.assert_allclose(solution, np.linalg.lstsq(matrix, right, rcond=None)[0], rtol=1e-9)
    left = (right - matrix @ solution)[30:] / WEIGHT["girder"]
    assert get_left_over(parts["girder"], solution) == pytest.approx(float(np.mean(left**2)))


def test_a_direction_that_no_data_determine_gets_no_step() -> None:
    column = RNG.normal(size=(30, 1))
    parts, _ = build_equations([{"pads": column}, {"pads": column}], {"pads": RESIDUAL["pads"]})
    squares, along = weigh_equations(parts, WEIGHT, 2)
    one, two = invert_regularised(squares) @ along
    assert one == pytest.approx(two)  # the shortest of all solutions
    nothing = invert_regularised(np.diag([2.0, 0.0])) @ np.array([4.0, 0.0])
    np.testing.assert_allclose(nothing, [2.0, 0.0])


def test_a_relation_without_columns_is_left_as_it_is() -> None:
    parts, _ = build_equations([BLOCKS[0]], RESIDUAL)
    assert get_left_over(parts["girder"], np.ones(2)) == pytest.approx(float(np.mean(RESIDUAL["girder"] ** 2)))


def test_what_columns_can_do_is_projected_away_and_nothing_else() -> None:
    columns = np.column_stack([BLOCKS[0]["pads"], BLOCKS[0]["pads"].sum(axis=1), np.zeros(30)])
    project = make_projector(columns)
    np.testing.assert_allclose(project(columns @ [1.0, -2.0, 0.5, 3.0]), 0.0, atol=1e-12)
    left = project(RESIDUAL["pads"])
    np.testing.assert_allclose(columns.T @ left, 0.0, atol=1e-12)
    np.testing.assert_allclose(project(left), left)
