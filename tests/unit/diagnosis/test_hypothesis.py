"""Where a refit begins, what is no longer there leaves no trace, and how little of an effect would have been seen."""

from dataclasses import replace

import numpy as np
import pytest

from bench import build_campaign
from measured import as_campaign, fit_base
from slipwise.diagnosis.detectable_size import estimate_least_sizes
from slipwise.diagnosis.hypothesis import make_base_hypothesis, refit
from slipwise.diagnosis.screening import screen
from slipwise.effects import catalogue
from slipwise.evidence.acceptance import LEAST
from slipwise.model import base_model, use
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import Term, list_base_numbers


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


def test_every_candidate_with_a_strength_has_a_least_size_whichever_way_the_residual_points(base):
    terms = [
        Term(catalogue()[name]) for name in ("heating", "run_in", "breakaway", "buffer_damping", "buffer_hysteresis")
    ]
    sizes = estimate_least_sizes(screen(base, terms), make_base_hypothesis(base))
    assert set(sizes) == {t.effect.name for t in terms}
    assert all(size > 0.0 for size, _ in sizes.values())


def test_a_least_size_is_one_at_which_a_relation_falls_by_what_is_material(base):
    """Of the true size s the screen's column is s times that of the unit: its drop per sample is what is material."""
    term = Term(catalogue()["buffer_damping"])
    found = screen(base, [term])
    size, unit = estimate_least_sizes(found, make_base_hypothesis(base))["buffer_damping"]
    assert unit == "N*s/m"
    left = base.solution.residuals.stacked(base.objective.fitted)
    shape = {f"buffer_damping.{k}": v for k, v in found[0].values.items()}
    moved = {**base.solution.values, **shape, "buffer_damping.damping": size}
    there = base.objective.adding(term).residuals(moved, fitted_only=True)
    step = make_projector(base.solution.jacobian)(there.stacked(base.objective.fitted) - left)
    fallen = dict.fromkeys(base.objective.relations, 0.0)
    for rows, block in base.solution.residuals.rows(base.objective.fitted):
        fallen[block.relation] += float(np.sum(step[rows] ** 2))
    counts = make_base_hypothesis(base).summary.counts
    drops = [fall / counts[relation][0] for relation, fall in fallen.items()]
    assert max(drops) == pytest.approx(LEAST.law, rel=0.1)
