"""What an effect changes, as a share of what is measured."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.estimation.base_fit import fit_base
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import fit_prepared
from slipwise.selection.hypothesis import make_base_hypothesis
from slipwise.selection.importance import build_answering_model, choose_shown, compute_share_of_channel, is_replayable
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign
from unit.campaign.slider import RUNS, slider, text


def test_a_channel_that_stands_has_no_share_whatever_round_off_makes_of_its_deviation() -> None:
    stands = np.full(683, 186.53)
    assert np.std(stands) > 0.0
    assert compute_share_of_channel(np.ones(683), stands) == 0.0
    assert compute_share_of_channel(np.ones(4), np.array([1.0, -1.0, 1.0, -1.0])) == pytest.approx(1.0)


@pytest.mark.parametrize("dead", [False, True])
def test_a_held_out_run_in_which_the_gauge_is_dead_does_not_tell_what_matters(dead: bool, tmp_path: Path) -> None:
    one, two = slider(1), slider(2)
    if dead:
        two[:, 3] = 0.18653
    (tmp_path / "one.csv").write_text(text(one))
    (tmp_path / "two.csv").write_text(text(two))
    (tmp_path / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{RUNS}')
    base = fit_prepared(prepare(load_campaign(tmp_path)), None)
    assert base.objective.held_out == [1] and choose_shown(base) == (0 if dead else 1)
    summary = make_base_hypothesis(base).summary
    assert summary.judged_apart is not dead


def test_a_fit_with_the_inertias_of_no_rigid_body_is_not_replayed() -> None:
    base = fit_base(as_campaign(build_campaign(31, effects=(), rig="bridge1")))
    place, model = choose_shown(base), build_answering_model(base)
    assert is_replayable(model, base, place)
    none = replace(model, specimen=replace(model.specimen, inertia=(1.0, 1.0, 3.0)))
    assert not is_replayable(none, base, place)
