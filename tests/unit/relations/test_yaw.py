"""Yaw that is made from measured forces is the yaw that the girder did."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from measured import fit_base
from slipwise.effects import catalogue, load_effect
from slipwise.model import base_model, use
from slipwise.relations.kinematics import YAW
from slipwise.relations.parameters import YAW_INERTIA, Term
from slipwise.selection.hypothesis import refit
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.slow
@pytest.mark.parametrize("seed", [5001, 5003])
def test_unequal_buffers_turn_the_made_girder_as_far_as_the_true_one(seed: int) -> None:
    made = build_campaign(seed, effects=("buffer_mismatch",), size="medium")
    campaign, true = as_campaign(made), made.truth.base
    difference = made.truth.as_dict()["details"]["buffer_mismatch"]["mismatch"]
    model = base_model(campaign.specimen).adding(use("buffer_mismatch", difference=difference))
    base = fit_base(campaign, model)
    values = {**base.solution.values, "buffer_mismatch.difference": difference, YAW_INERTIA: true.inertia_yaw}
    values |= {"rig.buffer_stiffness": true.buffer_stiffness, "rig.mass": true.mass}
    for name, (angle, rate) in zip(made.true, base.objective.evaluation(values).of(YAW), strict=True):
        there = made.at_samples(name)["yaw"]
        there = there - there[0]
        np.testing.assert_allclose(angle @ there / (there @ there), 1.0, atol=0.015)
        assert np.std(angle - there) < 0.04 * np.std(there)
        turning = np.gradient(there, campaign.runs[0].record.dt)
        assert np.std(rate - turning) < 0.03 * np.std(turning)


@pytest.mark.slow
def test_a_users_own_effect_that_turns_the_girder_is_estimated_with_yaw_as_the_catalogues_is(tmp_path: Path) -> None:
    path = tmp_path / "my_pads.py"
    shutil.copy(catalogue()["pad_spread"].path, path)
    ours, theirs = Term(load_effect(path)), Term(catalogue()["pad_spread"])
    base = fit_base(as_campaign(build_campaign(5001, effects=("pad_spread",), size="medium")))
    fits = [refit(base, [term], {term.label: term.effect.typical()}, most=2) for term in (ours, theirs)]
    assert all(YAW_INERTIA in (f.key for f in fit.solution.free) for fit in fits)
    assert fits[0].solution.cost == fits[1].solution.cost
    assert fits[0].values_of(ours) == fits[1].values_of(theirs)


def test_effects_turn_the_girder_that_know_its_sides_or_say_so() -> None:
    turning = {name for name, effect in catalogue().items() if effect.turns}
    assert turning == {"buffer_mismatch", "mass_eccentricity", "pad_spread", "position_patch"}
