"""The number of samples for one independent one is what theory says of noise of a known colour."""

import numpy as np
import pytest
from scipy.signal import lfilter, resample_poly

from slipwise.noise.independent_samples import measure_block_length, sum_correlations, sum_sure_correlations


def coloured(memory: float, seed: int, count: int = 40_000) -> np.ndarray:
    return lfilter([1.0], [1.0, -memory], np.random.default_rng(seed).normal(size=count))


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.9])
def test_first_order_noise_counts_as_theory_says(memory):
    theory = (1.0 + memory) / (1.0 - memory)
    assert sum_correlations([coloured(memory, 1), coloured(memory, 2)]) == pytest.approx(theory, rel=0.1)


def test_a_record_that_is_sampled_finer_holds_no_more_independent_samples():
    noise = coloured(0.5, 6, 4000)
    for finer in (2, 4):
        series = resample_poly(noise, finer, 1)
        assert len(series) / sum_correlations([series]) == pytest.approx(
            len(noise) / sum_correlations([noise]), rel=0.05
        )


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_sums_over_blocks_scatter_as_sums_of_independent_samples_do(memory):
    noise = coloured(memory, 7)
    length = measure_block_length([noise])
    blocks = noise[: len(noise) // length * length].reshape(-1, length).sum(axis=1)
    expected = np.var(noise) * len(noise) * sum_correlations([noise])
    assert np.sum(blocks**2) == pytest.approx(expected, rel=0.15)


def test_samples_that_are_not_judged_do_not_shorten_the_memory():
    noise = coloured(0.9, 3)
    hidden = np.where(np.random.default_rng(4).random(noise.size) < 0.5, noise, 0.0)
    assert sum_correlations([hidden]) == pytest.approx(sum_correlations([noise]), rel=0.15)


def test_the_variance_of_a_mean_follows():
    means = [float(np.mean(coloured(0.8, seed, 2000))) for seed in range(300)]
    level = np.std(coloured(0.8, 999))
    assert np.std(means) == pytest.approx(level * np.sqrt(sum_correlations([coloured(0.8, 5)]) / 2000), rel=0.15)


@pytest.mark.parametrize(("memory", "allowed"), [(0.0, 0.0), (0.5, 0.2), (0.7, 0.3)])
def test_a_few_hundred_samples_show_what_is_sure(memory, allowed):
    found = [sum_sure_correlations([coloured(memory, seed, 300)]) for seed in range(40)]
    assert np.median(found) == pytest.approx((1.0 + memory) / (1.0 - memory), rel=allowed)


def test_nothing_known_counts_every_sample():
    assert sum_correlations([]) == sum_sure_correlations([]) == sum_sure_correlations([np.zeros(50)]) == 1.0
    assert sum_correlations([np.zeros(50)]) == 1.0
