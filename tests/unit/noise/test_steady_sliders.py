"""Gauges of a slider that never rests: their noise is that of the force gauge, however coarsely the test was logged."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.noise.gauges import measure_gauge_noise, measure_steady_level
from slipwise.record import Record
from slipwise_benchmarks import make_bearing
from slipwise_benchmarks.bearing import KINDS, draw_bearing

#: Seeds of campaigns that were logged at 20 to 200 Hz: reversals, walls and half a stroke lie within a few samples.
COARSE = (53011, 54301, 54309)


@pytest.mark.parametrize("seed", COARSE)
@pytest.mark.parametrize("kind", KINDS)
def test_friction_that_turns_round_between_two_samples_is_no_noise(tmp_path, kind, seed):
    make_bearing(tmp_path / "slider", kind=kind, seed=seed)
    fitted = [run.record for run in load_campaign(tmp_path / "slider").runs if run.role == "fit"]
    planted = draw_bearing(kind, seed).noise[0] * np.mean([np.max(np.abs(r["pad_A_Fx"])) for r in fitted])
    assert measure_gauge_noise(fitted)["pad_A_Fx"].level == pytest.approx(planted, rel=0.3)


def drawn(step: float, hum: float) -> Record:
    """A slider drawn to and fro at 20 mm/s over 200 mm; friction of 10 kN with a hum of 3 Hz, and noise of 5 N."""
    time = np.arange(0.0, 60.0, step)
    way = np.abs((0.02 * time / 0.2 + 0.5) % 2.0 - 1.0) * 0.2
    direction = np.sign(np.gradient(way))
    rng = np.random.default_rng(6)
    force = 1e4 * direction + hum * np.sin(2.0 * np.pi * 3.0 * time) + 5.0 * rng.standard_normal(len(time))
    return Record(time, {"slip_x": way + 1e-5 * rng.standard_normal(len(time)), "pad_A_Fx": force})


def test_noise_of_the_contact_that_is_slower_than_the_gauge_counts_as_noise():
    assert measure_steady_level([drawn(0.01, hum=0.0)], "pad_A_Fx") == pytest.approx(5.0, rel=0.15)
    assert measure_steady_level([drawn(0.01, hum=40.0)], "pad_A_Fx") == pytest.approx(
        np.hypot(5.0, 40.0 / np.sqrt(2.0)), rel=0.2
    )


def test_a_test_logged_too_coarsely_to_show_a_steady_stretch_shows_none():
    assert measure_steady_level([drawn(0.5, hum=0.0)], "pad_A_Fx") == 0.0
