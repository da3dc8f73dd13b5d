"""A strength that may be absent: its interval is one-sided, from the profile, and holds where the usual one cannot."""

from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest

from hypotheses import base, table_of
from slipwise.campaign.scales import Scales
from slipwise.effects import find_effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import compute_intervals
from slipwise.estimation.least_squares import compute_jacobian, solve
from slipwise.record import Record
from slipwise.relations.parameters import Free, Term
from slipwise.relations.run_data import FitRun

DT, COUNT, SIGMA = 0.01, 4000, 1.0
LEVEL = Free("rig.mass", 0.0, -9.0, 9.0, 0.1, "kg")
TIME = DT * np.arange(COUNT)
ALL = np.ones((COUNT, 1), dtype=bool)
COLUMNS = np.stack([np.ones(COUNT), 1.0 + np.sin(1.7 * TIME) + 0.5 * np.sin(11.0 * TIME)], axis=1)


@cache
def only_run() -> list[FitRun]:
    """A run as long as the line, all of whose samples are judged."""
    run = base().objective.runs[0]
    states = replace(run.states, time=TIME, record=Record(TIME, {"slip_x": 0.0 * TIME}))
    return [replace(run, states=states, judged={"pads": ALL})]


@dataclass
class Line:
    """Noise on a level and a strength that cannot be negative; it bends when `bent`."""

    measured: np.ndarray
    term: Term
    bent: float = 0.0
    fitted: tuple[int, ...] = (0,)
    relations: tuple[str, ...] = ("pads",)
    runs: list[FitRun] = field(default_factory=only_run)
    balanced: bool = False

    @property
    def motions(self) -> list[list[int]]:
        return [list(self.fitted)]

    @property
    def fitted_runs(self) -> list[FitRun]:
        return self.runs

    @property
    def scales(self) -> Scales:
        return self.runs[0].scales

    def run(self, place: int) -> FitRun:
        return self.runs[place]

    @property
    def terms(self) -> tuple[Term, ...]:
        return (self.term,)

    def near(self, values):
        return self

    def residuals(self, values, *, fitted_only=False):
        strength = values["heating.share"]
        predicted = COLUMNS @ [values["rig.mass"], strength + self.bent * strength**2]
        steady = np.zeros((COUNT, 1))  # a force that does not change knows no timing
        return table_of({"pads": [(self.measured - predicted)[:, None]]}, [steady], DT)


def fitted(rng: np.random.Generator, truth: float, bent: float = 0.0) -> BaseFit:
    term = Term(find_effect("heating"))
    strength = Free("heating.share", 0.1, 0.0, 2.0, 0.1, "1")
    predicted = COLUMNS @ [0.3, truth + bent * truth**2]
    line = Line(predicted + SIGMA * rng.standard_normal(COUNT), term, bent)
    free = (LEVEL, strength)
    found = solve(line, {"rig.mass": 0.0, "heating.share": 0.1}, free, enough=1e-6)
    slopes = compute_jacobian(line, found.values, free, found.residuals)
    found = type(found)(found.values, free, found.residuals, slopes, found.cost, found.evaluations)
    return BaseFit(None, None, line, free, found)


def test_a_strength_far_from_zero_keeps_its_two_sided_interval() -> None:
    entry = compute_intervals(fitted(np.random.default_rng(1), 0.5)).entries[1]
    assert entry.limit == ""
    assert 0.0 < entry.low < 0.5 < entry.high


@pytest.mark.parametrize("truth", [0.0, 0.02])
def test_near_zero_the_limit_lies_above_the_truth_in_ninety_five_of_a_hundred(truth: float) -> None:
    rng = np.random.default_rng(2)
    found = [compute_intervals(fitted(rng, truth)).entries[1] for _ in range(120)]
    near = [e for e in found if e.limit == "upper"]
    assert len(near) > 60
    assert all(e.low == 0.0 for e in near)
    assert np.mean([e.low <= truth <= e.high for e in found]) >= 0.92
    assert np.median([e.high for e in near]) < truth + 0.1, "a limit that says nothing covers everything"


def test_of_a_strength_that_ended_on_its_bound_it_is_said_how_large_it_may_be() -> None:
    rng = np.random.default_rng(3)
    on_bound = next(
        e for e in (compute_intervals(fitted(rng, 0.0)).entries[1] for _ in range(20)) if e.bound == "lower"
    )
    assert on_bound.limit == "upper"
    assert 0.0 < on_bound.high < 0.1


def test_the_limit_follows_the_likelihood_where_the_strength_acts_more_than_in_proportion() -> None:
    straight = compute_intervals(fitted(np.random.default_rng(5), 0.0)).entries[1]
    bent = compute_intervals(fitted(np.random.default_rng(5), 0.0, bent=30.0)).entries[1]
    assert straight.limit == bent.limit == "upper"
    assert bent.high + 30.0 * bent.high**2 == pytest.approx(straight.high, rel=0.1)
