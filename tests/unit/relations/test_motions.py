"""Runs of one motion belong together whatever their role says; runs of others do not."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base
from slipwise.estimation.objective import make_objective
from slipwise.evidence.residual_summary import summarise_residuals
from slipwise.relations.motions import group_by_motion
from slipwise.relations.run_data import FitRun
from slipwise.relations.setting import Weighing


@pytest.fixture
def runs() -> list[FitRun]:
    return list(base(held_out=False).objective.runs)


def test_a_run_that_is_given_twice_is_of_one_motion(runs) -> None:
    again = [replace(run, name=f"{run.name}_again") for run in runs]
    assert group_by_motion([*runs, *again], range(4)) == [[0, 2], [1, 3]]


def test_a_path_that_is_gone_through_again_more_slowly_is_another_motion(runs) -> None:
    run = runs[0]
    slow = replace(run.states, record=replace(run.record, time=2.0 * run.time))
    assert group_by_motion([run, replace(run, states=slow)], range(2)) == [[0], [1]]


def test_runs_of_two_motions_are_apart_unless_one_is_said_to_repeat_the_other(runs) -> None:
    assert group_by_motion(runs, range(2)) == [[0], [1]]
    said = [runs[0], replace(runs[1], role="repeat")]
    assert group_by_motion(said, range(2)) == [[0, 1]]


def test_runs_that_are_given_twice_add_no_independent_block() -> None:
    once = base(held_out=False)
    objective, solution = once.objective, once.solution
    runs = (*objective.runs, *objective.runs)
    sigmas = {name: (*of, *of) for name, of in objective.weighing.sigmas.items()}
    again = replace(make_objective(runs, objective.specimen, objective.terms), weighing=Weighing(sigmas))
    left = solution.residuals
    values = {name: [*left.of(name), *left.of(name)] for name in left.relations}
    doubled = again.layout.filled(values, [*left.pad_forces, *left.pad_forces])
    slopes = rows_twice(once, solution.jacobian)
    twice = summarise_residuals(again, replace(solution, residuals=doubled, jacobian=slopes))
    single = summarise_residuals(objective, solution)
    assert all(len(twice.blocks[name]) == len(blocks) for name, blocks in single.blocks.items())


def rows_twice(once, jacobian):
    """Slopes of all runs of a relation, then again, relation after relation."""
    objective, start, out = once.objective, 0, []
    for name in objective.relations:
        size = sum(block.value.size for block in once.solution.residuals.blocks(name, objective.fitted))
        out += [jacobian[start : start + size]] * 2
        start += size
    return np.concatenate(out)
