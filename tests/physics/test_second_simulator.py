"""The replay in MuJoCo against a second simulator of the same rig, written apart from it."""

from dataclasses import replace

import numpy as np
import pytest

from bench import simulate as second
from bench.motions import draw_quake
from bench.settings import rated
from slipwise.model import base_model
from slipwise.simulation.simulator import simulate

DT = 5e-4


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_slip_and_loads_follow_a_second_simulator_through_an_earthquake(rig):
    settings = rated(rig)
    motion = draw_quake(np.random.default_rng(5))
    other = second(settings, motion)
    specimen = base_model(rig).specimen.changed(
        pad_stiffness=settings.pad_stiffness,
        pad_damping=settings.pad_damping,
        buffer_stiffness=(settings.buffer_stiffness / 2,) * 2,
        inertia=(settings.inertia_roll, settings.inertia_pitch, settings.inertia_yaw),
    )
    every = round(DT / motion.step)
    table = np.stack([motion.ax, motion.ay, motion.az], axis=1)[::every]
    record = simulate(replace(base_model(rig), specimen=specimen), table, dt=DT, output_dt=2e-3).record
    time = np.asarray(other["time"])
    for name, allowed in (("slip_x", 0.01), ("pad_A_N", 0.03), ("girder_ax", 0.03)):
        theirs = np.interp(record.time, time, other[name])
        error = np.sqrt(np.mean((record[name] - theirs) ** 2)) / np.std(theirs)
        assert error < allowed, (name, error)
