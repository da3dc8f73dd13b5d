"""Buffers off the middle turn the girder: replay, law and balances against three lines of mechanics."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from shaking import G, coulomb, shaken, sine
from slipwise.campaign import Campaign, Logger, Run
from slipwise.model import Model
from slipwise.record import Record
from slipwise.relations.run_data import fit_runs
from slipwise.relations.yaw import compute_yaw
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes
from slipwise.rig.places import Buffer

#: One buffer at one corner, another elsewhere, unequal along and across, above the sliding plane.
BUFFERS = (Buffer("1", 0.9, 0.8, 0.15, 2.0e6, 1.2e6), Buffer("2", -0.5, 0.1, 0.05, 0.8e6, 2.0e6))
DT = 5e-4


def eccentric(mu: float) -> Model:
    model = coulomb("bridge1", mu)
    return replace(model, specimen=replace(model.specimen, buffers=BUFFERS))


def in_plane(table: np.ndarray, specimen, parts: int = 4) -> np.ndarray:
    """x, y and yaw (n, 3) of a rigid plate on springs without friction: M u'' + K u = -M (a, 0, 0)."""
    rows = [np.array([[1.0, 0.0, -(b.y - specimen.centre_y)], [0.0, 1.0, b.x - specimen.centre_x]]) for b in BUFFERS]
    springs = sum(row.T @ np.diag([b.stiffness_x, b.stiffness_y]) @ row for row, b in zip(rows, BUFFERS, strict=True))
    mass = np.array([specimen.mass, specimen.mass, specimen.inertia[2]])
    at, rate, step = np.zeros(3), np.zeros(3), DT / parts
    out = np.zeros((len(table), 3))
    for i in range(len(table)):
        out[i] = at
        for part in range(parts):
            a = table[i] + (table[min(i + 1, len(table) - 1)] - table[i]) * (part + 0.5) / parts
            rate = rate + step * (-(springs @ at) / mass - np.array([a, 0.0, 0.0]))
            at = at + step * rate
    return out


def test_a_replay_turns_as_a_plate_on_springs_off_its_middle() -> None:
    model = eccentric(1e-9)
    stiff = replace(model, specimen=model.specimen.changed(pad_stiffness=1e9, pad_damping=1.5e5))
    table = sine(1.3, 0.6, 3.0)
    record = shaken(stiff, table, dt=DT).record
    own = in_plane(table[:, 0], stiff.specimen)
    centre = stiff.specimen
    got = np.stack([record["slip_x"], record["slip_y"], record["yaw"]], axis=1)
    got[:, 0] += -record["yaw"] * centre.centre_y
    got[:, 1] += record["yaw"] * centre.centre_x
    for axis, name in enumerate(("x", "y", "yaw")):
        assert np.abs(got[:, axis] - own[:, axis]).max() < 0.02 * np.abs(own[:, axis]).max(), name
    assert np.abs(own[:, 2]).max() > 1e-3, "it must turn"


def test_the_balances_hold_with_forces_that_are_off_the_middle_and_above_the_plane() -> None:
    model = eccentric(0.1)
    specimen = model.specimen
    record = shaken(model, sine(2.0, 3.0, 3.0)).record
    friction = record.stacked("pad_{}_Fx", specimen.pads).sum(axis=1)
    loads = record.stacked("pad_{}_N", specimen.pads)
    push = [record[f"buffer_{b.name}_Fx"] for b in BUFFERS]
    for b, force in zip(BUFFERS, push, strict=True):
        at = record["slip_x"] - b.y * record["yaw"] + b.z * record["pitch"]
        assert np.abs(force - b.stiffness_x * at).max() < 2e-3 * np.abs(force).max()
    left = specimen.mass * record["girder_ax"] + friction + sum(push)
    assert np.abs(left).max() < 1e-3 * specimen.mass * G
    height = specimen.centre_height
    moment = height * friction + sum((height - b.z) * f for b, f in zip(BUFFERS, push, strict=True))
    moment = moment + (specimen.centre_x + record["slip_x"]) * loads.sum(axis=1)
    pitch = load_modes(loads, basis_of(specimen)).pitch
    inertia = specimen.inertia[1] * np.gradient(np.gradient(record["pitch"], record.dt), record.dt)
    rest = specimen.half_spacing[0] * pitch - moment + inertia
    slow = slice(200, -200)
    assert np.std(rest[slow]) < 0.01 * np.std(moment[slow])  # a jerk at a reversal has no second difference


def test_yaw_made_from_measured_forces_knows_the_springs_across() -> None:
    model = eccentric(0.1)
    specimen = model.specimen
    record = shaken(model, sine(2.0, 3.0, 4.0), output_dt=0.002).record
    wanted = ("slip_x", "table_a", "girder_a", "pad_")
    channels = {n: v for n, v in record.channels.items() if n.startswith(wanted) and n[-1] in "xzNF"}
    run = Run("run", "fit", Record(record.time, channels), 1800.0, None, "run.csv", "1")
    campaign = Campaign("made", "bridge1", specimen, Logger(None, known=True), (run,), Path())
    (seen,) = fit_runs(campaign)
    still = seen.slip[:, None] * np.array(specimen.buffer_stiffness)
    bound = np.abs(np.hypot(record.stacked("pad_{}_Fx", specimen.pads), record.stacked("pad_{}_Fy", specimen.pads)))
    angle, _ = compute_yaw(seen, specimen, seen.force, bound, still)
    true = record["yaw"]
    assert np.abs(angle - true).max() < 0.1 * np.abs(true).max()
