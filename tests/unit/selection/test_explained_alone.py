"""What a candidate could explain alone, and where a refit of it alone begins."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.effects import catalogue
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import list_candidates
from slipwise.selection.explained_alone import explain_alone, list_least_sizes
from slipwise.selection.hypothesis import polish, refit
from slipwise.selection.inclusion import SEEN
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def base():
    campaign = as_campaign(build_campaign(31, effects=(), rig="bridge1"))
    return fit_base(replace(campaign, runs=(campaign.runs[1], campaign.runs[4])))


def test_every_candidate_with_a_strength_has_a_least_size_whichever_way_the_residual_points(base):
    terms = [
        Term(catalogue()[name]) for name in ("heating", "run_in", "breakaway", "buffer_damping", "buffer_hysteresis")
    ]
    sizes = list_least_sizes(explain_alone(base, terms))
    assert set(sizes) == {t.effect.name for t in terms}
    assert all(size > 0.0 for size, _ in sizes.values())


def test_a_least_size_is_one_that_a_relation_shows(base):
    term = Term(catalogue()["buffer_damping"])
    found = explain_alone(base, [term])
    size, unit = list_least_sizes(found)["buffer_damping"]
    assert unit == "N*s/m"
    left = base.solution.residuals.stacked(base.objective.fitted)
    shape = {f"buffer_damping.{k}": v for k, v in found[0].values.items()}
    moved = {**base.solution.values, **shape, "buffer_damping.damping": size}
    there = base.objective.adding(term).residuals(moved, fitted_only=True)
    rows = make_averaged_rows(base.objective)
    step = make_projector(rows.average(base.solution.jacobian))(
        rows.average(there.stacked(base.objective.fitted) - left)
    )
    fallen = np.bincount(rows.relation, step**2, minlength=len(rows.samples))
    assert np.sqrt(max(fallen / rows.samples)) == pytest.approx(SEEN, rel=0.1)


@pytest.mark.slow
def test_a_lag_of_many_milliseconds_is_found_at_its_size_though_a_straight_line_sees_a_tenth_of_it() -> None:
    made = build_campaign(46178, effects=("channel_delay",), size="large")
    base = fit_base(as_campaign(made))
    fault = made.truth.as_dict()["details"]["channel_delay"]
    delays = [t for t in list_candidates(base)[0] if t.effect.name == "channel_delay"]
    best = explain_alone(base, delays)[0]
    assert set(best.term.targets) == set(fault["channels"])
    assert best.values["delay"] == pytest.approx(fault["size"], rel=0.1)
    assert best.gain > 0.5 * base.solution.cost


@pytest.mark.slow
def test_unlike_buffers_are_found_where_friction_holds_the_girder_until_they_are_unlike_enough() -> None:
    made = build_campaign(48062, effects=("buffer_mismatch",), size="large")
    base = fit_base(as_campaign(made))
    mismatch = next(t for t in list_candidates(base)[0] if t.effect.name == "buffer_mismatch")
    start = explain_alone(base, [mismatch])[0].values
    found = polish(refit(base, [mismatch], {mismatch.label: start}))
    truth = made.truth.as_dict()["details"]["buffer_mismatch"]["mismatch"]
    assert found.values_of(mismatch)["difference"] == pytest.approx(truth, rel=0.1)
    assert found.solution.cost < 0.5 * base.solution.cost
