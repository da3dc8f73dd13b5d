"""Tests of bearings under a load that is held: what the bench's closed forms say, and what a diagnosis says of them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise_benchmarks.bearing import KINDS, bearing_plan, draw_bearing, is_right, make_bearing, radius_error
from slipwise_benchmarks.slider_friction import Drive


def test_a_pendulum_without_friction_is_the_load_on_its_slope() -> None:
    bearing = replace(draw_bearing("pendulum", 1), mu_fast=0.0, mu_slow=0.0)
    slip = np.linspace(-0.2, 0.2, 5) * bearing.radius
    force = bearing.force(Drive(np.arange(5.0), slip, np.zeros(5), np.full(5, 1e6)))
    np.testing.assert_allclose(force, 1e6 * np.tan(np.arcsin(slip / bearing.radius)), rtol=1e-12)


def test_a_pendulum_that_holds_still_on_its_slope_within_friction_needs_no_force() -> None:
    """Where the slope is the coefficient of friction, friction alone carries the slider."""
    bearing = replace(draw_bearing("pendulum", 1), mu_fast=0.05, mu_slow=0.05)
    slip = np.sin(np.arctan(0.05)) * bearing.radius * np.array([2.0, 1.0])  # it comes from above
    drive = Drive(np.arange(2.0), slip, np.full(2, -1.0), np.full(2, 1e6))
    assert bearing.force(drive)[-1] == pytest.approx(0.0, abs=1e-6)


def test_the_plan_holds_every_kind_and_three_of_each_for_ten_pendulums() -> None:
    kinds = [kind for kind, _ in bearing_plan(20, 7).values()]
    assert {kind: kinds.count(kind) for kind in KINDS} == {"pendulum": 20, "spring": 6, "rim": 6, "flat": 6}


@pytest.mark.slow
@pytest.mark.parametrize(
    # springs, flat faces and pendulums of other seeds are diagnosed in tests/recover, tests/unit/selection and unit/cli
    "kind",
    [pytest.param(kind, marks=pytest.mark.long if kind != "rim" else ()) for kind in KINDS],
)
def test_a_bearing_is_named_as_what_it_is(tmp_path: Path, kind: str) -> None:
    truth = make_bearing(tmp_path / kind, kind, 2)
    said = diagnose(load_campaign(tmp_path / kind)).as_json()
    assert is_right(truth, said), said["words"]
    if kind == "pendulum":
        assert abs(radius_error(truth, said)) < 0.02
