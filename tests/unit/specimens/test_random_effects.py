"""Random effects against what is known in closed form where all errors are alike."""

import numpy as np
import pytest
from scipy.stats import chi2, norm
from scipy.stats import t as student

from slipwise.specimens.random_effects import combine


def test_of_equal_errors_mean_and_spread_are_those_of_the_sample():
    values, error = np.array([1.0, 1.4, 0.7, 1.9, 1.2]), 0.1
    found = combine(values, np.full(5, error))
    variance = np.var(values, ddof=1)
    assert found.mean == pytest.approx(values.mean())
    assert found.spread == pytest.approx(np.sqrt(variance - error**2))
    half = student.ppf(0.975, 4) * np.sqrt(variance / 5)
    assert (found.low, found.high) == pytest.approx((values.mean() - half, values.mean() + half))
    ends = [np.sqrt(4 * variance / chi2.ppf(p, 4) - error**2) for p in (0.975, 0.025)]
    assert (found.spread_low, found.spread_high) == pytest.approx(ends)


def test_values_that_agree_have_no_spread_and_an_interval_no_narrower_than_their_errors_say():
    found = combine([2.0, 2.0, 2.0], [0.3, 0.3, 0.3])
    assert found.spread == 0.0 and found.differ == pytest.approx(1.0)
    assert found.high - found.low > 2.0 * norm.ppf(0.975) * 0.3 / np.sqrt(3.0)


def test_what_is_known_badly_weighs_little_and_units_do_not_matter():
    found = combine([1.0, 1.1, 50.0], [0.1, 0.1, 100.0])
    assert found.mean == pytest.approx(1.05, abs=0.01)
    small = combine([1.0e-9, 1.1e-9, 50.0e-9], [0.1e-9, 0.1e-9, 100.0e-9])
    assert small.mean == pytest.approx(1.0e-9 * found.mean)


def test_the_interval_of_the_mean_holds_the_truth_in_nearly_all_drawn_sets_of_specimens():
    rng = np.random.default_rng(0)
    errors = np.array([0.1, 0.2, 0.3, 0.5])
    inside = 0
    for _ in range(400):
        found = combine(1.0 + 0.3 * rng.standard_normal(4) + errors * rng.standard_normal(4), errors)
        inside += found.low <= 1.0 <= found.high
    assert inside / 400 > 0.92
