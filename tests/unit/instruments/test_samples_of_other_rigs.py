"""Faults of samples are told on rigs whose pads stand in rows, and carry more or less than those of bridge1."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.record import Record
from slipwise.rig import load_specimen


def rocking(mass: float, digits: int = 9, dead: str = "") -> Campaign:
    """Six pads of which two stand in the middle: heave of 0.15 g and, five times as large, pitch; so many digits."""
    rng, specimen = np.random.default_rng(6), replace(load_specimen("six_pads"), mass=mass)
    time, share = np.arange(4000) * 0.002, specimen.weight / 6.0
    heave, pitch = 0.006 * np.sin(9.0 * time), 0.3 * np.sin(12.0 * time)
    channels = {"table_az": 0.06 * np.sin(9.0 * time) + rng.normal(0.0, 0.02, time.size)}
    for pad, (x, _) in zip(specimen.pads, specimen.pad_places, strict=True):
        moved = 0.0 if pad == dead else heave + pitch * x / 2.0
        load = share * (1.0 + moved + rng.normal(0.0, 0.0016, time.size))
        channels[f"pad_{pad}_N"] = np.array([float(f"{value:.{digits}g}") for value in load])
    run = Run("only", "fit", Record(time, channels), 0.0, None, "only.csv", "")
    return Campaign("made", "six_pads", specimen, Logger(), (run,), specimen.path.parent)


def test_a_pad_in_the_middle_of_a_row_is_not_dead_because_the_girder_rocks_over_it():
    assert find_sample_faults(rocking(15e3)) == []


@pytest.mark.parametrize("pad", ["A", "F"])
def test_a_cell_at_the_end_of_a_row_that_shows_noise_alone_is_dead(pad):
    (fault,) = find_sample_faults(rocking(15e3, dead=pad))
    assert (fault.kind, fault.channels) == ("dead", (f"pad_{pad}_N",))


@pytest.mark.parametrize("mass", [6e3, 15e3, 60e3, 62e3])
def test_values_on_both_sides_of_a_power_of_ten_do_not_repeat_for_their_digits(mass):
    assert find_sample_faults(rocking(mass, digits=5)) == []


@pytest.mark.parametrize("dead", ["", "C"])
def test_of_three_pads_one_in_the_middle_is_idle_only_where_the_weight_says_that_it_is(dead):
    rng, specimen = np.random.default_rng(7), load_specimen("three_pads")
    places = [replace(p, x=x, y=y) for p, x, y in zip(specimen.places, (1.5, -1.5, 0.0), (0.8, 0.8, -1.6), strict=True)]
    specimen = replace(specimen, places=tuple(places))
    time, share = np.arange(4000) * 0.002, specimen.weight / 3.0
    heave, pitch = 0.02 * np.sin(9.0 * time), 0.4 * np.sin(12.0 * time)
    channels = {"girder_az": specimen.gravity * heave + rng.normal(0.0, 0.03, time.size)}
    for pad, side in zip("ABC", (1.0, -1.0, 0.0), strict=True):
        moved = 0.0 if pad == dead else heave + pitch * side
        channels[f"pad_{pad}_N"] = share * (1.0 + moved + rng.normal(0.0, 0.001 * (pad != dead) + 1e-5, time.size))
    run = Run("only", "fit", Record(time, channels), 0.0, None, "only.csv", "")
    found = find_sample_faults(Campaign("made", "rig", specimen, Logger(), (run,), specimen.path.parent))
    assert [fault.channels for fault in found if fault.kind == "dead"] == ([(f"pad_{dead}_N",)] if dead else [])
