"""Noise of gauges from the rests of all runs: coloured noise, short rests, cells that feel the girder early."""

import numpy as np
import pytest
from scipy.signal import lfilter

from slipwise.noise.gauges import measure_gauge_noise
from slipwise.record import Record

DT = 0.002


def run(rng: np.random.Generator, rest: int, correlation: float = 0.0, early: int = 0) -> Record:
    """Noise of 0.02 m/s2 and 15 N, at rest for so many samples; the cell feels the girder some samples earlier."""
    count = rest + 2000
    time = DT * np.arange(count)

    def noise(level: float) -> np.ndarray:
        white = rng.standard_normal(count + 200)
        return level * lfilter([np.sqrt(1.0 - correlation**2)], [1.0, -correlation], white)[200:]

    moving = np.where(time > time[rest], 2.0 * np.sin(12.0 * (time - time[rest])), 0.0)
    felt = np.where(time > time[rest - early], 900.0 * (time - time[rest - early]), 0.0)
    return Record(time, {"table_ax": moving + noise(0.02), "pad_A_Fx": felt + noise(15.0)})


def test_short_rests_are_put_together():
    rng = np.random.default_rng(1)
    found = measure_gauge_noise([run(rng, 50, correlation=0.6) for _ in range(5)])
    assert found["table_ax"].rested
    assert found["table_ax"].level == pytest.approx(0.02, rel=0.2)


@pytest.mark.parametrize("correlation", [0.0, 0.3, 0.6])
def test_colour_is_the_density_at_low_frequency(correlation):
    rng = np.random.default_rng(2)
    gauge = measure_gauge_noise([run(rng, 500, correlation) for _ in range(5)])["table_ax"]
    assert gauge.level == pytest.approx(0.02, rel=0.06)
    assert gauge.colour == pytest.approx((1.0 + correlation) / (1.0 - correlation), rel=0.2)
    assert gauge.slow_level == pytest.approx(gauge.level * np.sqrt(gauge.colour))


def test_a_cell_that_feels_the_girder_before_the_table_moves_is_no_noisier_for_it():
    rng = np.random.default_rng(3)
    gauge = measure_gauge_noise([run(rng, 500, early=45) for _ in range(5)])["pad_A_Fx"]
    assert gauge.level == pytest.approx(15.0, rel=0.06)
    assert gauge.colour == pytest.approx(1.0, abs=0.2)


def test_without_rest_the_top_of_the_spectrum_must_do():
    rng = np.random.default_rng(4)
    gauge = measure_gauge_noise([run(rng, 10)])["table_ax"]
    assert not gauge.rested
    assert gauge.level == pytest.approx(0.02, rel=0.15)
