"""Nothing in the rig prefers a direction, a side or an engine."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import G, half_range, shaken, sine
from slipwise.model import base_model
from slipwise.simulation.simulator import simulate


def test_a_mirrored_motion_gives_the_mirrored_answer():
    motion = sine(2.0, 0.3 * G, 5.0, vertical=(6.0, 0.2 * G))
    motion[:, 0] += 0.05 * G * np.sin(2 * np.pi * 0.7 * np.arange(len(motion)) * 5e-4)
    there = shaken(base_model("bridge2"), motion).record
    back = shaken(base_model("bridge2"), motion * [-1.0, 1.0, 1.0]).record
    # Not to the last digit: the solver meets the constraints in another order.
    scale = np.abs(there["slip_x"]).max()
    assert back["slip_x"] == pytest.approx(-there["slip_x"], abs=1e-6 * scale)
    assert back["pad_A_N"] == pytest.approx(there["pad_B_N"], abs=1e-6 * 24516)
    assert back["pad_C_Fx"] == pytest.approx(-there["pad_D_Fx"], abs=1e-6 * 2800)
    assert np.abs(there["slip_y"]).max() < 1e-9
    assert np.abs(there["yaw"]).max() < 1e-9


@pytest.mark.parametrize("degrees", [30.0, 45.0])
def test_friction_is_a_circle(degrees):
    # Pads in a square and low, no buffers: motion at any angle is motion along x, turned.
    model = base_model("block")
    square = ((2.0, 2.0), (-2.0, 2.0), (2.0, -2.0), (-2.0, -2.0))
    inertia = (20000.0, 20000.0, 30000.0)
    specimen = model.specimen.changed(pad_places=square, inertia=inertia, centre_height=1e-3)
    model = replace(model, specimen=specimen)
    along = sine(2.0, 0.3 * G, 5.0)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turned = np.stack([c * along[:, 0], s * along[:, 0], along[:, 2]], axis=1)
    straight, oblique = shaken(model, along).record, shaken(model, turned).record
    slip = c * oblique["slip_x"] + s * oblique["slip_y"]
    across = -s * oblique["slip_x"] + c * oblique["slip_y"]
    rms = np.sqrt(np.mean(straight["slip_x"] ** 2))
    assert np.sqrt(np.mean((slip - straight["slip_x"]) ** 2)) < 1e-4 * rms
    assert np.abs(across).max() < 1e-4 * half_range(straight["slip_x"])
    force = c * oblique["pad_A_Fx"] + s * oblique["pad_A_Fy"]
    error = np.sqrt(np.mean((force - straight["pad_A_Fx"]) ** 2)) / np.sqrt(np.mean(straight["pad_A_Fx"] ** 2))
    assert error < 0.005


def test_the_python_engine_agrees_with_the_compiled_one():
    rng = np.random.default_rng(3)
    n = 6000
    noise = np.cumsum(rng.standard_normal((n, 3)), axis=0)
    noise -= np.linspace(0, 1, n)[:, None] * noise[-1]
    motion = 6.0 * noise / np.abs(noise).max(axis=0) * [1.0, 0.5, 0.3]
    fast = simulate(base_model("bridge1"), motion, output_dt=5e-4).record
    slow = simulate(base_model("bridge1"), motion, output_dt=5e-4, engine="python").record
    for name, values in fast.channels.items():
        span = max(np.ptp(values), 1e-12)
        assert np.abs(slow[name] - values).max() <= 1e-9 * span, name


def test_the_same_motion_gives_the_same_bytes_twice(tmp_path):
    from slipwise.record import write_record

    motion = sine(2.0, 0.3 * G, 2.0)
    for name in ("one", "two"):
        write_record(simulate(base_model("bridge1"), motion).record, tmp_path / f"{name}.parquet")
    assert (tmp_path / "one.parquet").read_bytes() == (tmp_path / "two.parquet").read_bytes()
