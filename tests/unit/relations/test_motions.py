"""Runs of one motion belong together whatever their role says; runs of others do not."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base
from slipwise.evidence.residual_summary import summarised
from slipwise.relations.motions import by_motion
from slipwise.relations.run_data import FitRun


@pytest.fixture
def runs() -> list[FitRun]:
    return base(held_out=False).problem.runs


def test_a_run_that_is_given_twice_is_of_one_motion(runs) -> None:
    again = [replace(run, name=f"{run.name}_again") for run in runs]
    assert by_motion([*runs, *again], range(4)) == [[0, 2], [1, 3]]


def test_runs_of_two_motions_are_apart_unless_one_is_said_to_repeat_the_other(runs) -> None:
    assert by_motion(runs, range(2)) == [[0], [1]]
    said = [runs[0], replace(runs[1], role="repeat")]
    assert by_motion(said, range(2)) == [[0, 1]]


def test_runs_that_are_given_twice_add_no_independent_block() -> None:
    once = base(held_out=False)
    problem, solution = once.problem.adding(), once.solution
    residuals = solution.residuals
    problem.runs = [*problem.runs, *problem.runs]
    problem.sigmas = {name: [*of, *of] for name, of in problem.sigmas.items()}
    parts = {name: [*of, *of] for name, of in residuals.parts.items()}
    doubled = replace(residuals, parts=parts, pad_forces=[*residuals.pad_forces, *residuals.pad_forces])
    slopes = rows_twice(once, solution.jacobian)
    twice = summarised(problem, replace(solution, residuals=doubled, jacobian=slopes))
    single = summarised(once.problem, solution)
    assert all(len(twice.blocks[name]) == len(blocks) for name, blocks in single.blocks.items())


def rows_twice(once, jacobian):
    """Slopes of all runs of a relation, then again, relation after relation."""
    problem, start, out = once.problem, 0, []
    for name in problem.relations:
        size = sum(problem.runs[i].judged[name].size for i in problem.fitted)
        out += [jacobian[start : start + size]] * 2
        start += size
    return np.concatenate(out)
