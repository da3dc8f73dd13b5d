"""Of a long campaign the best slopes are kept; a whole run confirms what was found."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.diagnosis.full_length_errors import compute_full_length_errors
from slipwise.record import Record
from slipwise.selection import jacobian_memory as kept_slopes
from slipwise.selection.hypothesis import make_base_hypothesis
from slipwise.session.evaluation import errors_of
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def base():
    campaign = as_campaign(build_campaign(31, effects=("breakaway",), rig="bridge1"))
    return fit_base(replace(campaign, runs=(campaign.runs[1], campaign.runs[4])))


def test_slopes_of_the_best_are_kept_and_the_others_are_taken_anew_where_they_are_asked_for(base, monkeypatch):
    found = make_base_hypothesis(base)
    tried = [replace(found, terms=()) for _ in range(3)]
    worth = {id(h): number for h, number in zip(tried, (1.0, 3.0, 2.0), strict=True)}
    monkeypatch.setattr(kept_slopes, "ROOM", int(2.5 * kept_slopes.size_of(found.solution)))
    kept = kept_slopes.lightened(tried, lambda h: worth[id(h)])
    assert [kept_slopes.size_of(h.solution) > 0 for h in kept] == [False, True, True]
    assert all(kept_slopes.size_of(h.solution) > 0 for h in tried)
    again = kept_slopes.complete_jacobian(kept[0])
    assert again.solution.cost == found.solution.cost
    assert again.summary is found.summary
    for one, other in zip(again.solution.residuals.table, found.solution.residuals.table, strict=True):
        np.testing.assert_array_equal(one.value, other.value)
    length = np.linalg.norm(found.solution.jacobian, axis=0)
    assert again.solution.jacobian == pytest.approx(found.solution.jacobian, abs=0.2 * length.max())
    assert kept_slopes.complete_jacobian(again) is again


def test_a_held_out_run_of_which_a_stretch_was_judged_is_predicted_over_all_its_samples(base):
    whole, found = base.campaign, make_base_hypothesis(base)
    last = whole.runs[-1]
    record = Record(last.record.time[:900], {name: values[:900] for name, values in last.record.channels.items()})
    cut = replace(whole, runs=(*whole.runs[:-1], replace(last, record=record)))
    assert last.role == "holdout" and compute_full_length_errors(whole, {}, whole, [found]) == {}
    both = compute_full_length_errors(whole, {}, cut, [found, found])
    assert list(both) == list(base.objective.relations)
    again = base.objective.weigh(base.solution.values)
    for error in errors_of(again, again.residuals(base.solution.values)):
        assert both[error.relation][0] == pytest.approx(error.held_out, rel=0.01)
        assert both[error.relation][0] == both[error.relation][1]
    bad = {last.name: {"pad_A_Fx": np.arange(len(last.record)) % 2 == 0}}
    assert compute_full_length_errors(whole, bad, cut, [found])["pads"] != both["pads"][:1]
