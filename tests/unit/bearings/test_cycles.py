"""A run is cut into cycles by its slip: from rest to rest, through noise, wherever the gauge has its zero."""

import numpy as np
import pytest

from slipwise.bearings.cycles import find_cycles
from unit.bearings.loops_in_closed_form import AMPLITUDE, motion

RATE = 400.0


def test_a_sine_from_rest_to_rest_is_as_many_cycles_as_it_has():
    _, slip = motion()
    rest = np.zeros(300)
    found = find_cycles(np.concatenate([rest, slip, rest]))
    assert [c.start for c in found.cycles] == pytest.approx([300.0 + RATE * i for i in range(4)], abs=1.0)
    assert found.cycles[-1].end == pytest.approx(300.0 + 4.0 * RATE, abs=1.5)
    assert found.cyclic and {c.series for c in found.cycles} == {1}


@pytest.mark.parametrize("seed", range(5))
def test_noise_at_rest_and_near_zero_makes_no_cycle(seed):
    noise = np.random.default_rng(seed).normal(0.0, 1e-4 * AMPLITUDE, 600 + int(4 * RATE) + 1)
    _, slip = motion()
    found = find_cycles(np.concatenate([np.zeros(300), slip, np.zeros(300)]) + noise)
    assert len(found.cycles) == 4 and found.cyclic


def test_a_mirrored_run_is_cut_at_the_same_places():
    _, slip = motion()
    assert find_cycles(slip).cycles == find_cycles(-slip).cycles


def test_a_gauge_whose_zero_is_an_end_of_the_stroke_is_cut_at_the_middle():
    time, _ = motion()
    found = find_cycles(AMPLITUDE * (1.0 - np.cos(2.0 * np.pi * time)))
    assert found.zero == pytest.approx(AMPLITUDE, rel=1e-3)
    assert sum(c.closed for c in found.cycles) == 3 and found.cyclic


def test_each_stroke_is_a_series_of_its_own():
    time, slip = motion()
    found = find_cycles(slip * np.where(time < 2.0, 0.5, 1.0))
    assert [c.series for c in found.cycles] == [1, 1, 2, 2]
    assert len(found.longest_series) == 2


def test_in_a_run_of_one_cycle_at_each_stroke_every_cycle_is_given():
    time, slip = motion()
    found = find_cycles(slip * (1.0 + np.floor(time)))
    assert [c.series for c in found.cycles] == [1, 2, 3, 4] and found.cyclic


def test_an_earthquake_is_no_cyclic_motion():
    rng = np.random.default_rng(3)
    time = np.arange(0.0, 20.0, 1.0 / RATE)
    phases, frequencies = rng.uniform(0.0, 2.0 * np.pi, 20), rng.uniform(0.3, 3.0, 20)
    slip = np.sum(np.sin(2.0 * np.pi * frequencies * time[:, None] + phases) / frequencies, axis=1)
    assert not find_cycles(slip * np.sin(np.pi * time / 20.0)).cyclic


def test_slip_that_never_comes_back_has_no_cycle():
    assert not find_cycles(np.linspace(0.0, 1.0, 100)).cycles
    assert not find_cycles(np.zeros(100)).cycles


def test_a_cycle_without_a_neighbour_of_its_stroke_is_no_series_but_a_single_one_is():
    time, slip = motion()
    assert [c.series for c in find_cycles(slip * np.where(time < 1.0, 0.5, 1.0)).cycles] == [0, 1, 1, 1]
    assert [c.series for c in find_cycles(slip[time <= 1.0]).cycles] == [1]
