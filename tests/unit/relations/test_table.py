"""One table knows how residuals are stacked, which samples count, and which runs are of one motion."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base, table_of
from slipwise.estimation.objective import make_objective
from slipwise.relations.table import Block, Residuals

LEFT = {"pads": [np.array([[3.0, 0.0], [0.0, 4.0]]), np.ones((3, 2))], "heave": [np.array([1.0, 2.0]), np.zeros(3)]}


def test_a_level_is_the_rms_over_the_samples_that_are_judged() -> None:
    table = table_of(LEFT)
    assert table.level("pads", [0]) == pytest.approx(2.5)
    assert table.level("pads", [0, 1]) == pytest.approx(np.sqrt(31.0 / 10.0))
    mask = np.array([[True, False], [False, True]])
    judged = Residuals((replace(table.block("pads", 0), mask=mask),))
    assert judged.level("pads", [0]) == pytest.approx(np.sqrt(12.5))
    assert judged.squares("pads", []) == 0.0 and judged.level("pads", []) == 0.0


def test_stacked_residuals_come_by_relation_then_by_run_and_their_rows_say_so() -> None:
    table = table_of(LEFT)
    stacked = table.stacked([1, 0])
    assert stacked.tolist() == [1.0] * 6 + [3.0, 0.0, 0.0, 4.0] + [0.0] * 3 + [1.0, 2.0]
    for rows, block in table.rows([1, 0]):
        assert np.array_equal(stacked[rows], block.value.ravel())
    assert table.cost([0], "pads") == 25.0
    assert table.stacked([0], "heave").tolist() == [1.0, 2.0]


def test_what_is_added_to_a_prediction_is_taken_from_its_residual_only() -> None:
    table = table_of(LEFT)
    less = table.less({"heave": [np.array([1.0, 1.0]), np.ones(3)]})
    assert less.of("heave")[0].tolist() == [0.0, 1.0] and less.of("heave")[1].tolist() == [-1.0] * 3
    assert less.of("pads") == table.of("pads")
    assert less.changes_by_run(table) == [2.0, 3.0]


def test_a_table_of_the_first_runs_has_no_blocks_of_the_others() -> None:
    layout = base().objective.layout
    first = {name: [np.ones_like(layout.of(name)[0])] for name in layout.relations}
    filled = layout.filled(first, [np.zeros(1)])
    assert {block.run for block in filled.table} == {0}
    with pytest.raises(KeyError):
        filled.stacked([0, 1])


def test_a_repeat_is_of_the_motion_that_it_repeats_and_a_held_out_run_of_its_own() -> None:
    objective = base().objective
    assert objective.held_out == [1]
    again = make_objective(
        [*objective.runs, replace(objective.runs[0], role="repeat")], objective.specimen, objective.terms
    )
    by_motion = {motion: [block.run for block in of] for motion, of in again.layout.by_motion("pads").items()}
    assert by_motion == {0: [0, 2]}
    assert {block.run: block.motion for block in again.layout.blocks("pads")} == {0: 0, 1: 1, 2: 0}


def test_noise_has_the_shape_of_the_residual_it_belongs_to() -> None:
    block = Block("pads", 0, "run", 0, "fit", np.arange(2.0), 1.0, np.ones((2, 3)), np.full(3, 5.0), np.ones(2, bool))
    assert block.noise.shape == (2, 3) and block.columns.shape == (2, 3) and block.fitted
