"""Why a campaign cannot test an effect is true of its data: what is left of its column beside what it is said to be.

A column is what an effect of its usual size changes in the residual. Where a reason says that it is one thing with
others, those others must be able to make nearly all of it; where no reason is given, they must not.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.effects import NEEDS, catalogue, scaled
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.preparation.signs import find_wrong_signs
from slipwise.record import Record
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import Term
from slipwise.rig import load_specimen
from slipwise.selection.candidates import list_candidates
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.sensitivities import compute_change, compute_stacked_with, small

STEP, SECONDS, STROKE = 0.005, 8.0, 0.05
#: Less than this of a column is left by what makes all of it, more of one that is a thing of its own [1].
NOTHING, SOMETHING = 0.03, 0.3


def sine(speed: float = 0.2) -> np.ndarray:
    time = np.arange(0.0, SECONDS, STEP)
    return STROKE * np.sin(speed / STROKE * time)


def ramp(way: float = 1.0) -> np.ndarray:
    """A slider that goes one way, at a speed that rises."""
    time = np.arange(0.0, SECONDS, STEP)
    return way * (0.01 * time + 0.005 * time**2)


def run(name: str, slip: np.ndarray, load: float = 25e3, **changes: np.ndarray) -> Run:
    """The paper's law under a load that stays, with noise."""
    rng, area = np.random.default_rng(len(name)), load_specimen("pad").pad_area
    velocity = np.gradient(slip, STEP)
    fast = 1.379e6 * area * -np.expm1(-19.7 * np.abs(velocity)) * -np.expm1(-0.102e-6 * load / area)
    true = {"slip_x": slip, "pad_A_N": np.full(slip.size, load), "pad_A_Fx": np.sign(velocity) * (fast + 0.046 * load)}
    noise = {"slip_x": 1e-6, "pad_A_N": 10.0, "pad_A_Fx": 5.0}
    read = {n: changes.get(n, x + rng.normal(0.0, noise[n], x.size)) for n, x in true.items()}
    return Run(name, "fit", Record(np.arange(slip.size) * STEP, read), None, None, f"{name}.csv", name)


def campaign_of(*runs: Run) -> Campaign:
    specimen = load_specimen("pad")
    return Campaign("made", "pad", specimen, Logger(known=True), runs, Path())


def term(base: BaseFit, name: str, target: str = "") -> Term:
    scales = base.objective.runs[0].scales
    effect = scaled(catalogue()[name], scales.of, scales.room)
    return Term(effect, (target,), target)


def columns(base: BaseFit, of: Term) -> list[np.ndarray]:
    """What it changes for every shape that is tried, each strength alone."""
    off = compute_stacked_with(base, of, of.effect.neutral())
    assert off is not None
    points = [(p, small(of.effect, shape, p)) for shape in shapes(of.effect) for p in strengths(of.effect)]
    found = [
        c
        for c in (compute_change(lambda v: compute_stacked_with(base, of, v), of, p, v, off) for p, v in points)
        if c is not None
    ]
    longest = max(float(np.linalg.norm(c)) for c in found)
    return [c for c in found if np.linalg.norm(c) > 0.05 * longest > 0.0]  # a cell zeroed under load reads noise only


def left(base: BaseFit, of: Term, *beside: Term) -> float:
    """The largest share of a column that neither the base's numbers nor what stands beside can make [1]."""
    project = make_projector(np.column_stack([base.solution.inside, *(c for t in beside for c in columns(base, t))]))
    found = [float(np.linalg.norm(project(c)) / np.linalg.norm(c)) for c in columns(base, of)]
    assert found, f"{of.label} changes nothing here"
    return max(found)


@pytest.fixture(scope="module")
def steady() -> BaseFit:
    """Two speeds to and fro under one load."""
    return fit_base(campaign_of(run("slow", sine(0.05)), run("fast", sine(0.3))))


@pytest.fixture(scope="module")
def one_way() -> BaseFit:
    return fit_base(campaign_of(run("there", ramp())))


OF_LOAD = {"slide_tilt": "", "load_crosstalk": "pad_A_Fx", "pressure_law": ""}


def test_every_effect_that_needs_a_changing_load_is_looked_at_here() -> None:
    assert {e.name for e in catalogue().values() if "changing load" in e.needs} == OF_LOAD.keys()


@pytest.mark.parametrize(("name", "target"), OF_LOAD.items())
def test_what_needs_a_changing_load_is_an_offset_or_the_base_law_under_one_that_stays(
    steady: BaseFit, name: str, target: str
) -> None:
    beside = [term(steady, "channel_offset", "pad_A_Fx")] if "offset" in catalogue()[name].steady else []
    assert left(steady, term(steady, name, target), *beside) < NOTHING
    assert (
        list_candidates(steady)[1][name]
        == f"the load never changes, and it is then one with {catalogue()[name].steady}"
    )


@pytest.mark.parametrize("name", ["slide_curvature", "restrainer"])
def test_what_leans_with_the_slip_is_neither_under_a_load_that_stays(steady: BaseFit, name: str) -> None:
    beside = [term(steady, "channel_offset", "pad_A_Fx"), term(steady, "direction_asymmetry")]
    assert left(steady, term(steady, name), *beside) > SOMETHING
    assert name in {t.effect.name for t in list_candidates(steady)[0]}


@pytest.mark.parametrize("name", ["slide_tilt", "load_crosstalk", "direction_asymmetry"])
def test_what_is_even_in_velocity_is_friction_where_the_slider_goes_one_way(one_way: BaseFit, name: str) -> None:
    assert left(one_way, term(one_way, name, OF_LOAD.get(name, ""))) < NOTHING
    assert list_candidates(one_way)[1][name] == NEEDS["both directions"]


def test_what_leans_with_the_slip_is_friction_that_changes_with_distance_where_the_slider_goes_one_way(
    one_way: BaseFit, steady: BaseFit
) -> None:
    for base, alike in ((one_way, True), (steady, False)):
        share = left(base, term(base, "slide_curvature"), term(base, "run_in"))
        assert share < NOTHING if alike else share > SOMETHING
    assert list_candidates(one_way)[1]["slide_curvature"] == NEEDS["both directions"]


def test_one_run_there_and_one_back_are_both_directions() -> None:
    there_and_back = fit_base(campaign_of(run("there", ramp()), run("back", ramp(-1.0))))
    assert {"slide_curvature", "direction_asymmetry"} <= {t.effect.name for t in list_candidates(there_and_back)[0]}
    held_out = campaign_of(run("there", ramp()), replace(run("back", ramp(-1.0)), role="holdout"))
    assert "slide_curvature" in list_candidates(fit_base(held_out))[1], "no fit has seen the way back"


@pytest.mark.parametrize("channel", ["pad_A_Fx", "pad_A_N", "slip_x"])
def test_a_gain_of_a_sliders_gauge_is_one_with_its_friction(steady: BaseFit, channel: str) -> None:
    assert left(steady, term(steady, "channel_gain", channel)) < NOTHING
    assert "one with the numbers of the friction law" in list_candidates(steady)[1]["channel_gain"]


def test_an_actuator_that_rests_at_its_ends_has_neither_a_rail_nor_lost_samples() -> None:
    """The same plateau is a rail in a gauge of force, and there it is said."""
    resting = np.clip(1.5 * sine(), -STROKE, STROKE)
    assert find_sample_faults(campaign_of(run("rests", resting, slip_x=resting))) == []
    force = run("plain", sine()).record["pad_A_Fx"]
    cut = np.clip(force + np.random.default_rng(1).normal(0.0, 50.0, force.size), -2.0e3, 2.0e3)
    found = find_sample_faults(campaign_of(run("cut", sine(), pad_A_Fx=cut)))
    assert {f.kind for f in found} == {"upper rail", "lower rail"}
    assert "only its slip" in list_candidates(fit_base(campaign_of(run("rests", resting))))[1]["channel_clipping"]


def test_a_force_that_drives_the_slip_is_reversed_and_a_spring_is_not() -> None:
    plain = run("plain", sine())
    assert find_wrong_signs(campaign_of(plain)) == []
    assert find_wrong_signs(campaign_of(run("turned", sine(), pad_A_Fx=-plain.record["pad_A_Fx"]))) == ["pad_A_Fx"]
    slip = sine()
    for way in (1.0, -1.0):
        assert find_wrong_signs(campaign_of(run("spring", slip, pad_A_Fx=way * 4e5 * slip))) == []


def test_load_is_told_from_speed_by_two_runs_of_unlike_load_at_one_speed() -> None:
    mixed = campaign_of(run("a", sine(0.1), 10e3), run("bb", sine(0.3), 30e3))
    crossed = campaign_of(*mixed.runs, run("ccc", sine(0.1), 30e3), run("dddd", sine(0.3), 10e3))
    assert "speed differs between these runs too" in list_candidates(fit_base(mixed))[1]["load against speed"]
    assert "load against speed" not in list_candidates(fit_base(crossed))[1]
