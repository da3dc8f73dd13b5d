"""Where a refit begins; what is no longer there leaves no trace."""

from dataclasses import replace

import pytest

from measured import fit_base
from slipwise.effects import catalogue
from slipwise.model import base_model, use
from slipwise.relations.parameters import Term, list_base_numbers
from slipwise.selection.hypothesis import make_base_hypothesis, refit
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def base():
    campaign = as_campaign(build_campaign(31, effects=(), rig="bridge1"))
    return fit_base(replace(campaign, runs=(campaign.runs[1], campaign.runs[4])))


def test_an_effect_that_was_taken_out_is_begun_from_its_start_not_from_what_it_was(base):
    term = Term(catalogue()["run_in"])
    before = make_base_hypothesis(base)
    start = {**term.effect.typical(), "rise": 0.1}
    left = {**{f"run_in.{name}": 0.9 * value for name, value in start.items()}, "rig.yaw_inertia": 1.0}
    solution = replace(before.solution, values={**before.solution.values, **left})
    found = refit(base, [term], {"run_in": start}, replace(before, solution=solution), most=0)
    assert found.values_of(term) == pytest.approx(start)
    assert "rig.yaw_inertia" not in found.solution.values


def test_cards_that_lag_by_effects_of_their_own_have_no_lag_beside_them():
    model = base_model("bridge1")
    for pad in "ABCD":
        model = model.adding(use("channel_delay", f"pad_{pad}_Fx", delay=2e-3))
    assert "rig.late_force" not in [f.key for f in list_base_numbers(model, balances=True)]
    one = base_model("bridge1").adding(use("channel_delay", "pad_A_Fx", delay=2e-3))
    assert "rig.late_force" in [f.key for f in list_base_numbers(one, balances=True)]
