"""A frame of storeys on a sliding base: against modal analysis, and against an integration of its own."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import FAST, G, coulomb, shaken
from slipwise.model import Model
from slipwise.rig import fixed_base_frequencies

DT = 1e-4


def stiff_and_low(mu: float, damping: float) -> Model:
    """The building on pads that do not give way, so that its base moves sideways only; columns with a damping [1]."""
    model = coulomb("building", mu)
    specimen = model.specimen.changed(pad_stiffness=1.5e10)
    storeys = tuple(
        replace(s, damping_x=damping * s.damping_x / 0.02, damping_y=damping * s.damping_y / 0.02)
        for s in specimen.storeys
    )
    return replace(model, specimen=replace(specimen, storeys=storeys))


def jolt(seconds: float) -> np.ndarray:
    """Half a sine of table acceleration in both directions (n, 3) [m/s^2], and nothing after it."""
    time = DT * np.arange(round(seconds / DT))
    push = np.where(time < 0.1, np.sin(np.pi * time / 0.1), 0.0)
    return np.stack([2.0 * push, 1.5 * push, 0.0 * push], axis=1)


@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_frame_on_a_base_that_sticks_swings_at_the_frequencies_of_modal_analysis(axis: str) -> None:
    model = stiff_and_low(5.0, 0.0)
    record = shaken(model, jolt(4.0), dt=DT, output_dt=5 * DT).record
    late = record.time > 0.15
    assert np.abs(record[f"slip_{axis}"]).max() < 1e-4
    storeys = model.specimen.storeys
    k1, k2 = (getattr(s, f"stiffness_{axis}") for s in storeys)
    masses = np.diag([s.mass for s in storeys])
    _, shapes = np.linalg.eigh(np.array([[k1 + k2, -k2], [-k2, k2]]) / storeys[0].mass)
    swings = np.stack([record[f"storey_{i}_a{axis}"] for i in (1, 2)]) - record[f"table_a{axis}"]
    for shape, expected in zip(shapes.T, fixed_base_frequencies(storeys, axis), strict=True):
        mode = (shape @ masses @ swings)[late]
        time = record.time[late]
        up = np.flatnonzero((mode[:-1] < 0.0) & (mode[1:] >= 0.0))
        crossings = time[up] - mode[up] * (time[1] - time[0]) / (mode[up + 1] - mode[up])
        assert 1.0 / np.diff(crossings).mean() == pytest.approx(expected, rel=1e-3)


def by_itself(model: Model, table: np.ndarray, mu: float) -> tuple[np.ndarray, np.ndarray]:
    """Slip of the base (n,) [m] and acceleration of the floors (n, 2) [m/s^2], in a plane, with Coulomb friction."""
    s = model.specimen
    m1, m2 = (storey.mass for storey in s.storeys)
    k1, k2 = (storey.stiffness_x for storey in s.storeys)
    c1, c2 = (storey.damping_x for storey in s.storeys)
    friction = mu * s.weight
    x = v = u1 = w1 = u2 = w2 = 0.0  # slip and the floors' places over the base, with their rates
    slip, floors = np.zeros(len(table)), np.zeros((len(table), 2))
    parts = 5
    step = DT / parts
    for i, ground in enumerate(table):
        slip[i] = x
        for j in range(parts):
            low, high = k1 * u1 + c1 * w1, k2 * (u2 - u1) + c2 * (w2 - w1)
            drive = low - s.mass * ground
            a = 0.0
            if v != 0.0 or abs(drive) > friction:
                sense = np.sign(v) if v else np.sign(drive)
                a = (drive - sense * friction) / s.mass
                if v and (v + step * a) * sense < 0.0:
                    a = -v / step
            f1, f2 = (high - low) / m1, -high / m2
            if j == 0:
                floors[i] = f1, f2
            v += step * a
            x += step * v
            w1 += step * (f1 - ground - a)
            w2 += step * (f2 - ground - a)
            u1, u2 = u1 + step * w1, u2 + step * w2
    return slip, floors


def test_base_and_floors_follow_an_integration_of_their_own() -> None:
    model = stiff_and_low(FAST, 0.02)
    time = DT * np.arange(30000)
    table = np.zeros((len(time), 3))
    table[:, 0] = 3.0 * np.clip(time, 0.0, 1.0) * np.sin(2 * np.pi * 1.7 * time + 0.4 * np.sin(3.0 * time))
    record = shaken(model, table, dt=DT).record
    slip, floors = by_itself(model, table[:, 0], FAST)
    assert np.abs(slip).max() > 0.01
    assert np.abs(record["slip_x"] - slip).max() < 0.01 * np.abs(slip).max()
    for i in (1, 2):
        theirs = floors[:, i - 1]
        error = np.sqrt(np.mean((record[f"storey_{i}_ax"] - theirs) ** 2)) / np.std(theirs)
        assert error < 0.01


def test_all_that_pushes_the_base_is_recorded_and_energy_closes() -> None:
    model = coulomb("building", FAST)
    time = 5e-4 * np.arange(8000)
    table = np.stack([3.0 * np.sin(10.0 * time), 2.0 * np.sin(13.0 * time), 1.0 * np.sin(30.0 * time)], axis=1)
    answer = shaken(model, table * np.clip(time, 0.0, 1.0)[:, None])
    r, s = answer.record, model.specimen
    assert answer.energy_error == pytest.approx(0.0, abs=0.002)
    for axis in "xy":
        push = sum(storey.mass * r[f"storey_{i}_a{axis}"] for i, storey in enumerate(s.storeys, 1))
        left = s.mass * r[f"girder_a{axis}"] + push + r.stacked(f"pad_{{}}_F{axis}", s.pads).sum(axis=1)
        assert np.abs(left).max() < 1e-3 * s.weight, axis  # a base that tilts is pushed sideways too
    loads = r.stacked("pad_{}_N", s.pads).sum(axis=1)
    assert np.abs(loads - s.carried_mass * (G + r["girder_az"])).max() < 1e-3 * s.weight
