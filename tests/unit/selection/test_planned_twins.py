"""Twins of a planned campaign, drawn from products of columns: what is loud is named, what is alike is not."""

import numpy as np
import pytest

from slipwise.evidence.calibration import load_calibration
from slipwise.evidence.statistics import Statistics
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.planned_twins import TwinWeighing, decide_twins, draw_pulls, prepare_weighing, weigh

ROWS = 4000


def column(label: str, *, two_sided: bool = True) -> CandidateColumn:
    return CandidateColumn(label, label, False, 0, "size", {"size": 1.0}, 0.0, two_sided, 1.0, np.zeros(0, np.float32))


def statistics_of(columns: np.ndarray, slope: np.ndarray) -> Statistics:
    every = np.column_stack([slope, columns])
    count = np.array([float(len(every))])
    nothing = np.zeros((1, every.shape[1]))
    of_base = np.array([True])
    return Statistics((every.T @ every)[None], nothing, count, count, count, count, 1, of_base)


def weighing_of(columns: np.ndarray, **kind) -> TwinWeighing:
    slope = np.random.default_rng(2).standard_normal(ROWS)
    return prepare_weighing(statistics_of(columns, slope), [column(label, **kind) for label in "abc"], {})


def named(size: float, loudness: float, mixed: float = 0.0, **kind) -> dict[str, float]:
    """Give how often each of three effects is named where the first is there; the second is like it, but for a part.

    "listed": how often any of them is said to be there.
    """
    rng = np.random.default_rng(1)
    columns = loudness * rng.standard_normal((ROWS, 3))
    columns[:, 1] = mixed * columns[:, 0] + np.sqrt(1.0 - mixed**2) * columns[:, 1]
    weighing = weighing_of(columns, **kind)
    evidence = weigh(weighing, draw_pulls(weighing, 0, size, 200, rng))
    said = decide_twins(weighing, evidence, {label: label for label in "abc"}, load_calibration())
    out = {label: said.named.count(label) / 200 for label in "abc"}
    return out | {"listed": sum(map(bool, said.listed)) / 200}


def test_an_effect_far_above_the_noise_is_named_and_no_other():
    found = named(2.0, 2.0)
    assert found["a"] > 0.95 and found["b"] == found["c"] == 0.0


def test_an_effect_below_the_noise_is_not_named_although_there_are_many_samples():
    assert named(1.0, 0.3)["a"] == 0.0


def test_a_trifle_is_not_named():
    assert named(0.1, 2.0)["a"] < 0.05


def test_an_effect_that_is_there_and_does_not_matter_is_listed():
    found = named(0.75, 3.0)
    assert found["a"] < 0.5 < found["listed"]


def test_of_two_effects_that_change_the_same_neither_is_named():
    found = named(2.0, 2.0, mixed=1.0)
    assert found["a"] < 0.1 and found["b"] < 0.1


def test_the_more_two_effects_are_alike_the_rarer_the_right_one_is_named():
    chances = [named(1.3, 1.5, mixed=mixed)["a"] for mixed in (0.0, 0.999, 0.99999)]
    assert chances == sorted(chances, reverse=True)
    assert chances[0] > chances[-1] + 0.2


def test_what_can_only_add_is_named_too():
    assert named(2.0, 2.0, two_sided=False)["a"] > 0.95


@pytest.mark.parametrize("planted", [0, 1, 2])
def test_chances_of_one_place_never_exceed_one(planted):
    rng = np.random.default_rng(0)
    weighing = weighing_of(rng.standard_normal((ROWS, 3)))
    found = weigh(weighing, draw_pulls(weighing, planted, 3.0, 50, rng))
    assert np.all(sum(one.matters for one in found.values()) <= 1.0 + 1e-9)
