"""Intervals of fitted numbers: right for noise that remembers, silent for numbers that ended on a bound."""

import numpy as np

from slipwise.estimation.intervals import compute_fit_intervals
from slipwise.relations.parameters import Free

ROWS, RUNS = 4000, 200


def fitted(rng, memory):
    """Fit a line to noise with a memory; gives the fit's interval of the slope, and its usual standard error."""
    columns = np.stack([np.ones(ROWS), np.sin(np.arange(ROWS) / 37.0)], axis=1)
    noise = np.empty(ROWS)
    noise[0] = rng.standard_normal()
    fresh = rng.standard_normal(ROWS) * np.sqrt(1.0 - memory**2)
    for i in range(1, ROWS):
        noise[i] = memory * noise[i - 1] + fresh[i]
    measured = columns @ [1.0, 2.0] + noise
    found = np.linalg.lstsq(columns, measured, rcond=None)[0]
    free = [Free("offset", 0.0, -9.0, 9.0, 1.0, "N"), Free("slope", 0.0, -9.0, 9.0, 1.0, "N")]
    left = measured - columns @ found
    blocks = np.arange(ROWS) // 100
    got = compute_fit_intervals(free, {"offset": found[0], "slope": found[1]}, -columns, left, blocks)
    usual = np.sqrt(left.var() * np.linalg.inv(columns.T @ columns)[1, 1])
    return got.entries[1], found[1], usual


def covered(memory):
    rng = np.random.default_rng(4)
    inside = usual_inside = 0
    for _ in range(RUNS):
        entry, found, usual = fitted(rng, memory)
        inside += entry.low <= 2.0 <= entry.high
        usual_inside += abs(found - 2.0) <= 1.96 * usual
    return inside / RUNS, usual_inside / RUNS


def test_the_interval_covers_the_truth_when_noise_is_white():
    assert 0.90 <= covered(0.0)[0] <= 0.99


def test_the_interval_covers_the_truth_when_noise_remembers_where_the_usual_formula_does_not():
    ours, usual = covered(0.9)
    assert 0.90 <= ours <= 0.99
    assert usual < 0.7


def test_a_number_on_its_bound_has_no_interval_and_says_which_bound():
    columns = np.stack([np.ones(400), np.linspace(-1, 1, 400)], axis=1)
    free = [Free("a", 0.0, -1.0, 1.0, 1.0, "1"), Free("b", 0.0, 0.0, 5.0, 1.0, "1")]
    left = np.random.default_rng(1).standard_normal(400)
    got = compute_fit_intervals(free, {"a": 0.3, "b": 0.0}, -columns, left, np.arange(400) // 20)
    assert got.entries[1].bound == "lower"
    assert np.isnan(got.entries[1].low)
    assert got.keys == ("a",)
    assert got.entries[0].low < 0.3 < got.entries[0].high


def test_two_numbers_that_do_the_same_are_reported_as_correlated():
    rng = np.random.default_rng(2)
    first = rng.standard_normal(2000)
    columns = np.stack([first, first + 0.1 * rng.standard_normal(2000)], axis=1)
    free = [Free(k, 0.0, -9.0, 9.0, 1.0, "1") for k in "ab"]
    got = compute_fit_intervals(free, {"a": 1.0, "b": 1.0}, -columns, rng.standard_normal(2000), np.arange(2000) // 20)
    a, b, correlation = got.strongest(1)[0]
    assert {a, b} == {"a", "b"}
    assert correlation < -0.9


def test_what_a_whole_run_shares_widens_the_interval_by_what_it_could_do():
    column = np.sin(np.arange(400) / 9.0)[:, None]
    free = [Free("a", 0.0, -9.0, 9.0, 1.0, "1")]
    left, blocks = np.random.default_rng(1).standard_normal(400), np.arange(400) // 20
    whose = np.arange(400) // 200
    pulled = [float(np.sum(column[whose == w, 0] ** 2) / np.sum(column**2)) for w in (0, 1)]
    plain = compute_fit_intervals(free, {"a": 0.3}, -column, left, blocks).covariance[0, 0]
    for kinds in (1, 2):
        shared = (np.tile(0.2 * column[:, 0], (kinds, 1)), whose)
        wider = compute_fit_intervals(free, {"a": 0.3}, -column, left, blocks, shared).covariance[0, 0]
        assert np.isclose(wider - plain, kinds * 0.2**2 * np.sum(np.square(pulled)))
