"""The friction of one pad at one instant.

    bound = mu N,  mu = s A_r / N,  A_r = N / H,    each of A_r, s, mu changed by the effects on it, one after another
    F = stick(bound) + sum of pad(bound, |F|);     dry friction up to the bound where no effect says how a pad sticks

All functions take the chosen effects, the array `u` (see `places`) and the place `z` in it of the pad's block, then
load N [N], slip rate [m/s] and slip [m] along x and y, where the pad stands (-1 to 1 along x and y), time
and dt [s]. Forces are those of the girder on the pad [N].

Source: paper, eqs. (1) to (5).
"""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.places import APPARENT_AREA, FULL_STICK, PLASTIC_PRESSURE, SHEAR_STRENGTH

#: Below this speed [m/s] a pad counts as sticking where the capacity to stick matters.
STICK_SPEED = 1e-4
#: Speed [m/s] at which a pad is asked what it bears when sliding as fast as can be.
FULL_SPEED = 1e3


@compilable
def pad_bound(
    effects: Dispatch, u: Array, z: int, load: float, velocity_x: float, velocity_y: float, slip_x: float,
    slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> float:  # fmt: skip
    """Return the friction force that a pad can carry, s A_r [N]; nothing where it does not touch."""
    if load <= 0.0:
        return 0.0
    apparent_area = u[z + APPARENT_AREA]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    if u[FULL_STICK] > 0.0 and speed < STICK_SPEED:
        speed = FULL_SPEED
    real_area = load / u[PLASTIC_PRESSURE]
    true_pressure = load / real_area
    real_area = effects.area(
        u, z, real_area, true_pressure, load, pressure, apparent_area, speed, velocity_x, velocity_y, slip_x, slip_y,
        side_x, side_y, time, dt,
    )  # fmt: skip
    true_pressure = load / real_area
    shear = effects.shear(
        u, z, u[SHEAR_STRENGTH], real_area, true_pressure, load, pressure, apparent_area, speed, velocity_x,
        velocity_y, slip_x, slip_y, side_x, side_y, time, dt,
    )  # fmt: skip
    coefficient = effects.coefficient(
        u, z, shear * real_area / load, load, pressure, apparent_area, speed, velocity_x, velocity_y, slip_x, slip_y,
        side_x, side_y, time, dt,
    )  # fmt: skip
    return max(coefficient * load, 0.0)


@compilable
def pad_explicit(
    effects: Dispatch, u: Array, z: int, bound: float, load: float, velocity_x: float, velocity_y: float, slip_x: float,
    slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Return the force of the effect that says how a pad sticks [N]; only called if there is one."""
    apparent_area = u[z + APPARENT_AREA]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    return effects.stick(
        u, z, bound, load, pressure, apparent_area, speed, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y,
        time, dt,
    )  # fmt: skip


@compilable
def pad_further(
    effects: Dispatch, u: Array, z: int, bound: float, friction: float, load: float, velocity_x: float,
    velocity_y: float, slip_x: float, slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Return the sum of the further forces at a pad [N], which carries `friction` of the `bound` [N]."""
    apparent_area = u[z + APPARENT_AREA]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    return effects.pad(
        u, z, bound, friction, load, pressure, apparent_area, speed, velocity_x, velocity_y, slip_x, slip_y, side_x,
        side_y, time, dt,
    )  # fmt: skip


@compilable
def pad_advance(
    effects: Dispatch, u: Array, z: int, bound: float, friction: float, load: float, velocity_x: float,
    velocity_y: float, slip_x: float, slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> None:  # fmt: skip
    """Let a pad's memory go on by dt, now that the friction which it carried is known [N]."""
    apparent_area = u[z + APPARENT_AREA]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    effects.advance(
        u, z, bound, friction, load, pressure, apparent_area, speed, velocity_x, velocity_y, slip_x, slip_y, side_x,
        side_y, time, dt,
    )  # fmt: skip
