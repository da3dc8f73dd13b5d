"""A law is added to a slider whose base fit has ended far from its material for want of that law."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import make_base_hypothesis, refit
from slipwise.selection.search_state import Search
from slipwise.selection.select import _never_above_fewer_terms
from slipwise_benchmarks.bearing import Bearing, draw_bearing, drive_of, record, write_bearing


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Bearing, BaseFit]:
    folder: Path = tmp_path_factory.mktemp("test") / "pendulum"
    drawn = draw_bearing("pendulum", 4)
    bearing = replace(drawn, mu_fast=0.105, mu_slow=0.057, rate=27.0, varying=0.4, step=0.05, zero=0.0)
    rng = np.random.default_rng(4)
    tests = {name: record(bearing, rng, drive_of(bearing, rng, 1.0, v)) for name, v in (("one", 0.15), ("two", 0.5))}
    write_bearing(folder, bearing, {"one": "fit", "two": "holdout"}, tests)
    return bearing, fit_base(load_campaign(folder))


def test_the_curvature_of_a_pendulum_under_a_swinging_load_is_found_with_its_friction(
    made: tuple[Bearing, BaseFit],
) -> None:
    """Friction in proportion to the load stands in for the slope before; from there no small steps lead back."""
    bearing, base = made
    term = Term(catalogue()["slide_curvature"])
    found = refit(base, [term], {term.label: term.effect.typical()})
    assert found.solution.values["slide_curvature.curvature"] == pytest.approx(1.0 / bearing.radius, rel=0.01)
    assert found.solution.values["contact_area.saturation"] == pytest.approx(0.102e-6, rel=0.3)


def test_a_model_that_is_fitted_worse_than_with_fewer_terms_begins_again_from_there(
    made: tuple[Bearing, BaseFit],
) -> None:
    _, base = made
    curvature, delay = Term(catalogue()["slide_curvature"]), Term(catalogue()["channel_delay"], ("pad_A_Fx",))
    fewer = refit(base, [curvature], {curvature.label: curvature.effect.typical()})
    starts = {curvature.label: curvature.effect.typical(), delay.label: {"delay": 0.02}}
    far = refit(base, [curvature, delay], starts, fewer, most=0)
    assert far.solution.cost > 1.2 * fewer.solution.cost
    state = Search(base, {}, [curvature, delay], (), (make_base_hypothesis(base),))
    _, found, steps = _never_above_fewer_terms(state, far, [fewer])
    assert found.solution.cost <= fewer.solution.cost
    assert steps == ([fewer] if len(found.terms) == 2 else [])
    assert _never_above_fewer_terms(state, fewer, [])[1] is fewer
