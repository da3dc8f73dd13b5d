"""What is told of the noise of a gauge: its level in the unit that people read, and what has shown it."""

import numpy as np
import pytest
from scipy.signal import lfilter

from slipwise.noise.gauges import find_rest_before_motion, measure_gauge_noise
from slipwise.record import Record
from slipwise.signals.filters import LowPass, lowpass
from slipwise.view.words.gauge_rows import gauge_rows

TIME = 0.002 * np.arange(3000)


def moved(rest: int, noise: float, step: float = 0.0) -> Record:
    """Slip of 20 mm after a rest, with noise, rounded to steps; a load that never changes."""
    rng = np.random.default_rng(8)
    moving = np.where(TIME > TIME[rest], np.sin(12.0 * (TIME - TIME[rest])), 0.0)
    slip = 0.02 * moving + noise * rng.standard_normal(len(TIME))
    slip = np.round(slip / step) * step if step else slip
    table = 2.0 * moving + 0.02 * rng.standard_normal(len(TIME))
    return Record(TIME, {"table_ax": table, "slip_x": slip, "pad_A_N": np.full(len(TIME), 24e3)})


def test_a_level_is_told_in_the_unit_that_people_read():
    gauges = measure_gauge_noise([moved(800, 5e-5)])
    (row,) = [row for row in gauge_rows(gauges) if row["channel"] == "slip_x"]
    assert row["unit"] == "mm" and row["from"] == "rest before the motion"
    assert float(row["noise"]) == pytest.approx(0.05, rel=0.1)


@pytest.mark.parametrize(
    ("record", "basis"),
    [
        (moved(800, 5e-5), "rest before the motion"),
        (moved(10, 5e-5), "top of the spectrum"),
        (moved(800, 1e-6, step=2e-4), "its resolution"),
        (moved(800, 1e-9), "0.1% of what it measures"),
    ],
)
def test_the_basis_of_a_level_is_told(record, basis):
    assert measure_gauge_noise([record])["slip_x"].basis.startswith(
        (basis, "differences" if basis[0] == "t" else basis)
    )


def test_hum_and_slow_noise_of_the_tables_gauge_do_not_end_a_rest():
    record = moved(800, 5e-5)
    slow = 0.02 * lfilter([0.4], [1.0, -0.9], np.random.default_rng(3).standard_normal(len(TIME)))
    humming = record.replaced(table_ax=record["table_ax"] + 0.05 * np.sin(2.0 * np.pi * 50.0 * TIME) + slow)
    assert np.count_nonzero(find_rest_before_motion(humming)) == pytest.approx(800, abs=30)


@pytest.mark.parametrize("beginning", [0.0, 0.4, 0.8])
def test_a_record_that_begins_in_motion_has_no_rest(beginning):
    record = moved(0, 5e-5)
    table = 2.0 * np.sin(12.0 * TIME + beginning)
    assert np.count_nonzero(find_rest_before_motion(record.replaced(table_ax=table))) < 24


def test_a_constant_is_no_measurement_and_the_reason_is_told():
    (row,) = [row for row in gauge_rows(measure_gauge_noise([moved(800, 5e-5)])) if row["channel"] == "pad_A_N"]
    assert row["noise"] == "unknown" and "constant of the campaign" in row["from"]


@pytest.mark.parametrize("memory", [0.0, 0.4])
def test_a_filter_leaves_of_a_gauge_what_its_noise_has_below_the_edge(memory):
    rng = np.random.default_rng(5)
    slip = lfilter([1.0], [1.0, -memory], rng.standard_normal(30_000))
    still = Record(TIME, {"table_ax": rng.standard_normal(len(TIME)), "slip_x": slip[: len(TIME)]})
    gauge = measure_gauge_noise([still])["slip_x"]
    left = lowpass(slip, 0.002, LowPass(25.0, 6, "aligned"))
    assert gauge.rested and gauge.level_below(25.0, 0.002) == pytest.approx(np.std(left), rel=0.1)
