"""The replay in MuJoCo against a second simulator of the same rig, written apart from it."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.model import base_model
from slipwise.rig import Specimen
from slipwise.simulation.simulator import simulate
from slipwise_benchmarks import simulate as second
from slipwise_benchmarks.motions import draw_quake
from slipwise_benchmarks.parts import Buffer, Pad
from slipwise_benchmarks.settings import Settings

DT = 5e-4


def settings_of(specimen: Specimen) -> Settings:
    """Give the rig of the second simulator that a specimen is."""
    inertia = dict(zip(("inertia_roll", "inertia_pitch", "inertia_yaw"), specimen.inertia, strict=True))
    count = len(specimen.places)
    pads = [
        Pad(p.name, p.x, p.y, np.pi * p.radius**2, p.stiffness, p.damping, p.z, p.curvature) for p in specimen.places
    ]
    buffers = [Buffer(b.name, b.x, b.y, b.z, b.stiffness_x, b.stiffness_y) for b in specimen.buffers]
    nothing = {"seating": (0.0,) * count, "patch": (0.0,) * count, "pad_factor": (1.0,) * count}
    return Settings().changed(
        mass=specimen.mass, height=specimen.centre_height, **inertia, pads=pads, buffers=buffers,
        law_pads=(1.0,) * count, **nothing,
    )  # fmt: skip


def followed(specimen: Specimen, settings: Settings) -> dict[str, float]:
    """Give how far slip, load and acceleration are off in an earthquake, channel -> rms over the standard deviation.

    Loads and acceleration are held against each other while the girder slides: where it sticks the second simulator's
    elastic stick rings.
    """
    motion = draw_quake(np.random.default_rng(5))
    other = second(settings, motion)
    every = round(DT / motion.step)
    table = np.stack([motion.ax, motion.ay, motion.az], axis=1)[::every]
    model = replace(base_model("bridge1"), specimen=specimen)
    record = simulate(model, table, dt=DT, output_dt=2e-3).record
    time, errors = np.asarray(other["time"]), {}
    sliding = np.abs(np.interp(record.time, time, other["slip_vx"])) > 0.02
    for name in ("slip_x", f"pad_{specimen.pads[0]}_N", "girder_ax"):
        theirs, at = np.interp(record.time, time, other[name]), sliding | (name == "slip_x")
        errors[name] = float(np.sqrt(np.mean((record[name] - theirs)[at] ** 2)) / np.std(theirs[at]))
    return errors


@pytest.mark.parametrize("rig", ["bridge1", "bridge2", "three_pads", "six_pads", "pendulum"])
def test_slip_and_loads_follow_a_second_simulator_through_an_earthquake(rig):
    specimen = base_model(rig).specimen.changed(pad_stiffness=2.5e8, pad_damping=6.0e4)
    errors = followed(specimen, settings_of(specimen))
    assert errors.pop("slip_x") < 0.01
    assert errors.pop("girder_ax") < 0.01
    assert max(errors.values()) < 0.03
