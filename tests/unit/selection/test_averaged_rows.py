"""Averages of residuals: noise keeps its size, slow signals their sum of squares, and hum goes."""

import numpy as np
import pytest

from measured import fit_base
from slipwise.arrays import Array
from slipwise.selection.averaged_rows import BAND, AveragedRows, make_averaged_rows
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def made() -> tuple[AveragedRows, Array, Array]:
    """Give how a campaign's rows are averaged, the time of every stacked residual, and which of them are judged."""
    base = fit_base(as_campaign(build_campaign(54000, effects=())))
    objective = base.objective
    blocks = [block for _, block in objective.layout.rows(objective.fitted)]
    time = np.concatenate([np.repeat(b.time, b.value.size // len(b.time)) for b in blocks])
    masks = [np.broadcast_to(b.mask.reshape(len(b.time), -1), b.columns.shape).ravel() for b in blocks]
    return make_averaged_rows(objective), time, np.concatenate(masks)


def test_noise_keeps_its_deviation(made: tuple[AveragedRows, Array, Array]) -> None:
    rows, time, _ = made
    averaged = rows.average(np.random.default_rng(0).standard_normal(len(time)))
    assert np.std(averaged) == pytest.approx(1.0, abs=0.02)


def test_a_slow_signal_keeps_its_sum_of_squares_over_the_samples_that_are_judged(
    made: tuple[AveragedRows, Array, Array],
) -> None:
    rows, time, judged = made
    signal = np.sin(2.0 * np.pi * 2.0 * time)
    assert np.sum(rows.average(signal) ** 2) == pytest.approx(np.sum(signal[judged] ** 2), rel=0.02)


def test_hum_of_the_mains_is_taken_out(made: tuple[AveragedRows, Array, Array]) -> None:
    rows, time, judged = made
    hum = np.sin(2.0 * np.pi * 50.0 * time + 0.3)
    assert np.sum(rows.average(hum) ** 2) < 1e-3 * np.sum(hum[judged] ** 2)


def test_several_columns_are_averaged_as_each_alone(made: tuple[AveragedRows, Array, Array]) -> None:
    rows, time, _ = made
    both = np.random.default_rng(1).standard_normal((len(time), 2))
    assert np.allclose(rows.average(both)[:, 1], rows.average(both[:, 1]))


def test_rows_are_no_denser_than_the_band(made: tuple[AveragedRows, Array, Array]) -> None:
    rows, time, _ = made
    assert len(rows.relation) < len(time)
    assert BAND < 100.0
