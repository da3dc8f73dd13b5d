"""Locate: noise accuses nobody, and error that is put into one state of motion is found there and said in words."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.comparison.cells import Cell, Samples, correct_for_many_tests, judge_cells
from slipwise.comparison.motion_states import STATES
from slipwise.comparison.odd_even import split_odd_and_even
from slipwise.comparison.patterns import find_patterns
from slipwise.comparison.sentences import describe_places

COUNT = 24000


def samples(residual, since, direction, speed, relation="pads"):
    count = len(residual)
    values = {
        "state": np.where(since < 0.001, STATES.index("reversal"), STATES.index("steady +")).astype(float),
        "speed": speed,
        "since reversal": since,
        "direction": direction + 1.0,
        "time": np.linspace(0.0, 40.0, count),
    }
    labels = {"state": STATES, "direction": ("sliding to −x", "at rest", "sliding to +x")}
    frequency = np.linspace(0.0, 250.0, 500)
    return Samples(relation, residual**2, residual, values, labels, 4.0, 4.0, (frequency, np.ones(500)))


@pytest.fixture
def motion():
    """Ways of 40 mm to and fro: way since the reversal, direction, speed."""
    rng = np.random.default_rng(7)
    since = rng.uniform(0.0, 0.04, COUNT)
    direction = np.where(np.arange(COUNT) % 2000 < 1000, 1.0, -1.0)
    return since, direction, rng.uniform(0.0, 0.3, COUNT), rng.standard_normal(COUNT)


def located(one):
    cells = correct_for_many_tests(judge_cells(one))
    found = {p.relation: p for p in [split_odd_and_even(one)] if p is not None}
    return cells, describe_places(cells, find_patterns(one), found, {one.relation: float(np.sqrt(one.squared.mean()))})


def test_at_most_one_in_a_hundred_of_the_cells_named_is_above_by_chance():
    rng = np.random.default_rng(9)
    chances = np.where(rng.random(400) < 0.1, 10.0 ** rng.uniform(-9.0, -1.0, 400), rng.random(400))
    plain = Cell("pads", "speed", "", 0.0, 1.0, 1.2, 100, 50.0, 1.0, False, 1.0)
    above = [c.chance for c in correct_for_many_tests(replace(plain, chance=float(p)) for p in chances) if c.above]
    # Benjamini and Hochberg (1995): the largest k for which the k-th smallest chance is at most 0.01 k/m
    ordered = np.sort(chances)
    k = np.flatnonzero(ordered <= 0.01 * np.arange(1, 401) / 400)[-1] + 1
    assert sorted(above) == pytest.approx(ordered[:k])


def test_noise_at_the_floor_accuses_no_cell(motion):
    since, direction, speed, noise = motion
    cells, found = located(samples(noise, since, direction, speed))
    assert not any(c.above for c in cells)
    assert found == ()


def test_noise_ten_percent_above_the_floor_is_within_what_is_known_of_the_floor(motion):
    since, direction, speed, noise = motion
    assert located(samples(1.1 * noise, since, direction, speed))[1] == ()


def test_error_after_reversals_is_found_there_and_nowhere_else(motion):
    since, direction, speed, noise = motion
    residual = np.where(since < 0.004, 5.0, 1.0) * noise
    cells, found = located(samples(residual, since, direction, speed))
    assert found[0].words.startswith("pad friction, both directions, equal: above the floor only within 4 mm after a")
    assert found[0].share > 0.95
    beyond = [c for c in cells if c.kind == "since reversal" and c.low >= 0.004]
    assert beyond and not any(c.above for c in beyond)


def test_friction_that_the_law_lacks_after_reversals_is_reported_with_its_sign(motion):
    since, direction, speed, noise = motion
    residual = noise - 6.0 * direction * (since < 0.004)
    _, found = located(samples(residual, since, direction, speed))
    words = found[0].words
    assert "after reversals" in words and "both directions, equal" in words and "below the model's" in words
    assert "within 4 mm" in words


def test_a_force_in_one_direction_only_is_reported_so(motion):
    since, direction, speed, noise = motion
    residual = noise + 6.0 * (direction > 0) * (speed < 0.05)
    _, found = located(samples(residual, since, direction, speed))
    assert found[0].direction == "only sliding to +x"
    assert found[0].kind == "speed"


def test_unequal_directions_are_reported_so(motion):
    since, direction, speed, noise = motion
    residual = noise + np.where(direction > 0, -4.0, 8.0) * (since < 0.004)
    _, found = located(samples(residual, since, direction, speed))
    assert "after reversals, both directions, unequal" in found[0].words


def test_friction_is_odd_and_a_constant_pull_is_even_in_the_direction_of_sliding(motion):
    since, direction, speed, noise = motion
    friction = split_odd_and_even(samples(noise + 3.0 * direction, since, direction, speed))
    pull = split_odd_and_even(samples(noise + 3.0, since, direction, speed))
    assert friction.odd == pytest.approx(3.0, rel=0.05) and friction.even < 0.3
    assert pull.even == pytest.approx(3.0, rel=0.05) and pull.odd < 0.3


def test_a_single_run_of_bad_luck_among_many_cells_is_not_named(motion):
    since, direction, speed, _ = motion
    rng = np.random.default_rng(11)
    named = [
        any(c.above for c in located(samples(rng.standard_normal(COUNT), since, direction, speed))[0])
        for _ in range(20)
    ]
    assert sum(named) == 0
