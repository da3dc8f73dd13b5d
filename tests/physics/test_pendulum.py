"""A girder on curved sliders against the closed forms of a pendulum, and against a slider on a sphere by itself."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import ellipk

from shaking import FAST, G, coulomb, shaken
from slipwise.model import Model, base_model, use
from slipwise.simulation.predict import predictor

RADIUS = 1.0
DT = 5e-4


def sliding_freely() -> Model:
    """A pendulum without friction on the stiffest pads that the step allows."""
    return coulomb("pendulum", 1e-9)


def pulse(peak: float, lasts: float, seconds: float, dt: float = DT) -> np.ndarray:
    """One sine of table acceleration along x (n, 3) [m/s^2]; what is left of its speed is taken out."""
    time = dt * np.arange(round(seconds / dt))
    out = np.zeros((len(time), 3))
    out[:, 0] = np.where(time < lasts, peak * np.sin(2 * np.pi * time / lasts), 0.0)
    return out


def on_a_sphere(table: np.ndarray, mu: float, dt: float, radius: float = RADIUS, parts: int = 10) -> np.ndarray:
    """Slip (n,) [m] of a point on a sphere with Coulomb friction under table acceleration (n,), by itself.

    R th'' = -g sin - a cos - mu P sign(th'),  P = g cos - a sin + R th'^2; it sticks where friction can hold it.
    """
    angle = speed = 0.0
    out = np.zeros(len(table))
    step = dt / parts
    for i in range(len(table)):
        out[i] = radius * np.sin(angle)
        for j in range(parts):
            a = table[i] + (table[min(i + 1, len(table) - 1)] - table[i]) * (j + 0.5) / parts
            drive = -G * np.sin(angle) - a * np.cos(angle)
            hold = mu * (G * np.cos(angle) - a * np.sin(angle) + radius * speed**2)
            if speed == 0.0 and abs(drive) <= hold:
                continue
            sense = np.sign(speed) if speed else np.sign(drive)
            new = speed + step * (drive - sense * hold) / radius
            speed = 0.0 if new * sense < 0.0 else new
            angle += step * speed
    return out


@pytest.mark.parametrize("peak", [0.05, 1.5, 4.5])
def test_the_period_of_a_pendulum_is_that_of_the_closed_form(peak: float) -> None:
    record = shaken(sliding_freely(), pulse(peak, 1.0, 8.0)).record
    late = record.time > 1.0
    slip, time = record["slip_x"][late], record.time[late]
    up = np.flatnonzero((slip[:-1] < 0.0) & (slip[1:] >= 0.0))
    crossings = time[up] - slip[up] * DT / (slip[up + 1] - slip[up])
    swing = np.arcsin(np.abs(slip).max() / RADIUS)
    exact = 4.0 * np.sqrt(RADIUS / G) * ellipk(np.sin(0.5 * swing) ** 2)
    assert np.diff(crossings) == pytest.approx(exact, rel=5e-4), np.degrees(swing)


@pytest.mark.parametrize("shaken_by", [(3.0, 1.2), (6.0, 0.8), (2.0, 2.0)])
def test_slip_follows_a_slider_on_a_sphere_to_its_rest(shaken_by: tuple[float, float]) -> None:
    table = pulse(*shaken_by, 5.0)
    slip = shaken(coulomb("pendulum", FAST), table).record["slip_x"]
    alone = on_a_sphere(table[:, 0], FAST, DT)
    assert np.abs(slip).max() == pytest.approx(np.abs(alone).max(), rel=5e-3)
    assert np.abs(slip - alone).max() < 5e-3 * np.abs(alone).max()


def test_a_small_pendulum_that_swings_far_slides_less_than_small_angles_have_it() -> None:
    """R = 0.3 m and 0.43 R of slip: what takes u/R for the slope slides 8 % too far, a sphere does not."""
    radius, table = 0.3, pulse(4.3, 0.6, 3.0)
    model = coulomb("pendulum", 0.08)
    places = tuple(replace(p, curvature=1.0 / radius) for p in model.specimen.places)
    small = replace(model, specimen=replace(model.specimen, places=places))
    slip = np.abs(shaken(small, table).record["slip_x"]).max()
    assert slip == pytest.approx(np.abs(on_a_sphere(table[:, 0], 0.08, DT, radius)).max(), rel=2e-3)
    assert 0.4 * radius < slip < 0.95 * small_angles(table[:, 0], 0.08, DT, radius)


def small_angles(table: np.ndarray, mu: float, dt: float, radius: float, parts: int = 10) -> float:
    """Largest slip [m] of u'' = -a - g u/R - mu g sign(u'), which sticks where friction can hold it."""
    at = rate = largest = 0.0
    for a in np.repeat(table, parts):
        drive = -a - G * at / radius
        if rate == 0.0 and abs(drive) <= mu * G:
            continue
        sense = np.sign(rate) if rate else np.sign(drive)
        new = rate + dt / parts * (drive - sense * mu * G)
        rate = 0.0 if new * sense < 0.0 else new
        at += dt / parts * rate
        largest = max(largest, abs(at))
    return largest


def test_it_comes_back_until_friction_holds_it_on_the_slope() -> None:
    slip = shaken(coulomb("pendulum", 0.02), pulse(3.0, 1.2, 20.0)).record["slip_x"]
    assert np.abs(slip).max() > 0.1
    held = RADIUS * np.sin(np.arctan(0.02))
    assert abs(slip[-1]) < held and np.ptp(slip[-2000:]) < 1e-5


def test_the_girder_rises_along_the_sphere_and_its_pads_carry_what_it_weighs_and_throws() -> None:
    model = coulomb("pendulum", FAST)
    record = shaken(model, pulse(6.0, 0.8, 4.0)).record
    away = np.hypot(record["slip_x"], record["slip_y"])
    loads = record.stacked("pad_{}_N", model.specimen.pads)
    sag = loads.sum(axis=1) / sum(model.specimen.springs)
    assert away.max() > 0.1
    rise = RADIUS - np.sqrt(RADIUS**2 - away**2)
    assert np.abs(record["heave"] + sag - rise).max() < 2e-5
    mass = model.specimen.mass
    assert np.abs(loads.sum(axis=1) - mass * (G + record["girder_az"])).max() < 1e-6 * mass * G
    force = record.stacked("pad_{}_Fx", model.specimen.pads).sum(axis=1)
    assert np.abs(force + mass * record["girder_ax"]).max() < 1e-4 * mass * G  # it pitches a little


def test_a_pad_answers_as_a_wedge_on_its_slope() -> None:
    record = shaken(coulomb("pendulum", FAST), pulse(6.0, 0.8, 4.0)).record
    slides = np.abs(record["slip_vx"]) > 0.05
    slope = record["slip_x"] / np.sqrt(RADIUS**2 - record["slip_x"] ** 2)
    mu = np.sign(record["slip_vx"]) * FAST
    wedge = record["pad_A_N"] * (slope + mu) / (1.0 - mu * slope)
    assert np.abs(record["pad_A_Fx"] - wedge)[slides].max() < 1e-5 * record["pad_A_N"].max()


@pytest.mark.parametrize("engine", ["compiled", "python"])
def test_the_law_driven_by_what_a_replay_measures_answers_as_the_replay(engine: str) -> None:
    model = base_model("pendulum")
    pads = model.specimen.pads
    record = shaken(model, pulse(6.0, 0.8, 0.8 if engine == "python" else 3.0)).record
    load = record.stacked("pad_{}_N", pads)
    rate, slip = (np.stack([record[f"slip_{v}{a}"] for a in "xy"], axis=1) for v in ("v", ""))
    both = [np.repeat(each[:, None], len(pads), axis=1) for each in (rate, slip)]
    answer = predictor(model, engine=engine).pads(record.time, load, both[0], both[1])
    slides = np.abs(record["slip_vx"]) > 0.1  # the replay's law has the speed of half a step before
    assert slides.sum() > 500
    force = np.stack([record.stacked(f"pad_{{}}_F{a}", pads) for a in "xy"], axis=2)
    assert np.abs(answer.force - force)[slides].max() < 2e-3 * np.abs(force).max()
    # Where it slides all of the force but N x slope is what the bound along the table allows.
    slope = (slip[:, 0] / np.sqrt(RADIUS**2 - slip[:, 0] ** 2))[:, None]
    friction = answer.force[:, :, 0] - load * slope
    assert np.abs(np.abs(friction) - answer.bound)[slides].max() < 1e-6 * load.max()


def test_it_swings_alike_in_every_direction() -> None:
    table = pulse(5.0, 0.8, 4.0)
    turned = table[:, :1] * np.array([[0.6, 0.8, 0.0]])
    along = shaken(coulomb("pendulum", FAST), table).record["slip_x"]
    record = shaken(coulomb("pendulum", FAST), turned).record
    skew = 0.6 * record["slip_x"] + 0.8 * record["slip_y"]
    assert np.abs(skew - along).max() < 2e-3 * np.abs(along).max()
    assert np.abs(0.8 * record["slip_x"] - 0.6 * record["slip_y"]).max() < 2e-3 * np.abs(along).max()


def test_energy_closes_on_a_pendulum_in_two_directions_with_its_pads_on_either_side() -> None:
    table = pulse(6.0, 0.8, 5.0) + np.roll(pulse(4.0, 1.1, 5.0), 1, axis=1)
    for side in ("table", "girder"):
        answer = shaken(coulomb("pendulum", FAST, pads_on=side), table)
        assert answer.energy_error == pytest.approx(0.0, abs=0.002)


def test_a_rim_throws_the_girder_back_without_loss() -> None:
    limit = 0.05
    rim = coulomb("pendulum", FAST).adding(use("restrainer", stiffness=10e6, limit=limit))
    table = pulse(6.0, 0.8, 5.0)
    free, held = (shaken(m, table) for m in (coulomb("pendulum", FAST), rim))
    assert free.largest_slip > 0.1 and limit < held.largest_slip < limit + 0.02
    assert held.energy_error == pytest.approx(0.0, abs=0.002)


def test_a_double_pendulum_of_equal_friction_is_a_single_one_of_both_radii() -> None:
    """Two sliders, one above the other, share the slip by their radii: the same push on both, N u_i/R_i + mu N."""
    wide = coulomb("pendulum", FAST)
    places = tuple(replace(p, curvature=1.0 / 1.5) for p in wide.specimen.places)
    wide = replace(wide, specimen=replace(wide.specimen, places=places))
    table = pulse(5.0, 0.8, 4.0)
    slip = shaken(wide, table).record["slip_x"]
    alone = on_a_sphere(table[:, 0], FAST, DT, radius=1.5)
    assert np.abs(slip - alone).max() < 5e-3 * np.abs(alone).max()
