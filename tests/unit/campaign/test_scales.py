"""Forces and masses that are looked for go with what a pad carries; slip and speed do not."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from slipwise.campaign.scales import Scales, pad_load_scale, scales_of
from slipwise.effects import catalogue, scaled
from slipwise.instruments.suspects import suspects
from slipwise.record import Record
from slipwise.rig import load_specimen

HEAVY = replace(load_specimen("six_pads"), mass=150e3)


@pytest.mark.parametrize("rig", ["bridge1", "bridge2", "block", "six_pads"])
def test_a_girder_with_the_reference_load_on_a_pad_is_of_its_scale(rig):
    assert scales_of(SimpleNamespace(specimen=load_specimen(rig))) == Scales()  # pyright: ignore[reportArgumentType]


def test_bounds_of_forces_and_masses_grow_with_the_load_of_a_pad_and_no_others():
    scales = scales_of(SimpleNamespace(specimen=HEAVY))  # pyright: ignore[reportArgumentType]
    factors = {"buffer_hysteresis": 10.0, "buffer_damping": 10.0, "guide_drag": 10.0, "cell_inertia": 10.0}
    factors |= {"breakaway": 1.0, "slide_curvature": 1.0, "key_clearance": 1.0, "mass_eccentricity": 1.0}
    for name, factor in factors.items():
        rated = catalogue()[name].parameters[0]
        first = scaled(catalogue()[name], scales.of, scales.room).parameters[0]
        assert (first.typical, first.high) == pytest.approx((factor * rated.typical, factor * rated.high))


def test_the_least_fault_of_a_cell_goes_with_the_load_of_a_pad():
    time = 0.002 * np.arange(50)
    names = [f"pad_{pad}_{kind}" for pad in HEAVY.pads for kind in ("N", "Fx")]
    record = Record(time, {name: time for name in (*names, "table_ax", "table_az", "girder_ax", "slip_x")})
    light, heavy = (
        {one.key: one for one in suspects(record, rig, catalogue().values())}
        for rig in (load_specimen("six_pads"), HEAVY)
    )
    assert pad_load_scale(HEAVY) == pytest.approx(10.0)
    for key, factor in {
        ("channel_offset", "pad_A_N"): 10.0,
        ("channel_drift", "pad_A_Fx"): 10.0,
        ("cell_inertia", "all cells"): 10.0,
        ("channel_offset", "slip_x"): 1.0,
        ("channel_gain", "pad_A_N"): 1.0,
    }.items():
        assert heavy[key].least == pytest.approx(factor * light[key].least)
        assert heavy[key].step == pytest.approx(factor * light[key].step)
