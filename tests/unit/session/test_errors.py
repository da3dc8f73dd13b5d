"""A balance by which no sample is judged has no error: zero would say that the model explains it entirely."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hypotheses import base
from slipwise.estimation.objective import Objective
from slipwise.session.evaluation import BalanceError, errors_of


def roll_of(objective: Objective, blind: Sequence[int]) -> BalanceError:
    """The error of the balance of roll where no sample of some runs judges it."""
    left = objective.layout.filled(
        {name: [np.where(of.mask, 2.0, 0.0) for of in objective.layout.blocks(name)] for name in objective.relations},
        [np.zeros(run.force.shape) for run in objective.runs],
    )
    table = tuple(
        replace(of, value=np.zeros_like(of.value), mask=np.zeros_like(of.mask))
        if of.relation == "roll" and of.run in blind
        else of
        for of in left.table
    )
    return next(e for e in errors_of(objective, replace(left, table=table)) if e.relation == "roll")


def test_a_balance_that_no_sample_judges_has_no_error() -> None:
    roll = roll_of(base().objective, (0, 1))
    assert roll.fitted is None and roll.held_out is None and roll.error is None and not roll.runs


def test_a_balance_that_only_held_out_runs_judge_has_their_error() -> None:
    objective = base().objective
    roll = roll_of(objective, objective.fitted)
    assert roll.fitted is None and roll.error == roll.held_out == 2.0
