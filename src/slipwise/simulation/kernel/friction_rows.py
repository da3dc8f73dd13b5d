"""The rows of MuJoCo's constraints that a pad's dry friction is: which way it acts, how much they may carry, where."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.places import (
    DT,
    FORCE,
    FRICTION_ROW,
    GIRDER_DOF,
    LAST_COEFFICIENT,
    LAST_SPEED,
    LAST_VELOCITY,
    OVER_REST,
    RATE_AGE,
    RATE_SHARE,
    RISE,
    RISES_OVER_PADS,
    ROW_BOUND,
)

Array = NDArray[np.float64]
#: A bound that MuJoCo accepts and nobody feels [N].
TINY = 1e-9
#: Speed [m/s] from which on friction points along the velocity rather than along the friction of the step before.
DIRECTION_SPEED = 1e-3
#: Slip rate [m/s] below which a row is at rest. The solver lets it creep: by a hundredth of what it stops in a step.
REST = 1e-6
#: Largest share by which friction is taken to change along a straight line over the speeds of one step [1].
MOST_CHANGE = 0.5


@compilable
def rate_of_instant(u: Array, z: int, velocity_x: float, velocity_y: float) -> tuple[float, float]:
    """Give a pad's slip rate [m/s] at the instant of its position, none where it turns round before that.

    MuJoCo's rates stand half a step before its positions; that of the step before carries them on.
    """
    half = 0.5 * u[DT] / u[RATE_AGE]
    now_x = velocity_x + half * (velocity_x - u[z + LAST_VELOCITY])
    now_y = velocity_y + half * (velocity_y - u[z + LAST_VELOCITY + 1])
    u[z + LAST_VELOCITY] = velocity_x
    u[z + LAST_VELOCITY + 1] = velocity_y
    if now_x * velocity_x + now_y * velocity_y < 0.0:
        return 0.0, 0.0
    return now_x, now_y


@compilable
def learn_rate_dependence(u: Array, z: int, bound: float, normal: float, speed_x: float, speed_y: float) -> None:
    """Find how what a pad may carry depends on its speed near rest, from this step and the one before.

    Friction that turns round within a step passes through other speeds than that of the step's instant.
    """
    speed = sqrt(speed_x * speed_x + speed_y * speed_y)
    coefficient = bound / normal if normal > 0.0 else 0.0
    u[z + RATE_SHARE], u[z + OVER_REST] = 0.0, 1.0
    change = u[z + LAST_SPEED] - speed
    if coefficient > 0.0 and u[z + LAST_COEFFICIENT] > 0.0 and change > REST:
        slope = (u[z + LAST_COEFFICIENT] - coefficient) / change
        at_rest = coefficient - slope * speed
        if at_rest > 0.0:
            # What a straight line says holds for small changes only: laws may be much steeper near rest.
            most = MOST_CHANGE / max(u[z + LAST_SPEED], speed)
            u[z + RATE_SHARE] = min(max(slope / at_rest, -most), most)
            u[z + OVER_REST] = 1.0 + u[z + RATE_SHARE] * speed
    u[z + LAST_COEFFICIENT], u[z + LAST_SPEED] = coefficient, speed


@compilable
def direction(u: Array, z: int, bound: float, velocity_x: float, velocity_y: float) -> tuple[float, float, float]:
    """Give a vector along which a pad's friction acts, and its length, so that what it may carry [N] is a circle.

    e along v / (1 mm/s) + F / bound: along the velocity where it slides, along the last friction F where it sticks.
    """
    last = max(bound, 1.0)
    toward_x = velocity_x / DIRECTION_SPEED + u[z + FORCE] / last
    toward_y = velocity_y / DIRECTION_SPEED + u[z + FORCE + 1] / last
    length = sqrt(toward_x * toward_x + toward_y * toward_y)
    if length > 1e-9:
        return toward_x, toward_y, length
    return 1.0, 0.0, 1.0


@compilable
def split(u: Array, z: int, bound_x: float, bound_y: float, frictionloss: Array) -> None:
    """Set what the rows of a pad's friction along x and y may carry: the size of each [N]."""
    u[z + ROW_BOUND], u[z + ROW_BOUND + 1] = max(abs(bound_x), TINY), max(abs(bound_y), TINY)
    frictionloss[int(u[z + FRICTION_ROW])] = u[z + ROW_BOUND]
    frictionloss[int(u[z + FRICTION_ROW + 1])] = u[z + ROW_BOUND + 1]


@compilable
def lift_arms(u: Array, z: int, force_x: float, force_y: float, applied: Array) -> None:
    """Add the moments [N m] of a pad's force [N], which acts lower under a girder that has risen over its pads."""
    if u[RISES_OVER_PADS] > 0.0 and int(u[GIRDER_DOF]) >= 0:
        applied[int(u[GIRDER_DOF + 4])] += u[z + RISE] * force_x
        applied[int(u[GIRDER_DOF + 3])] -= u[z + RISE] * force_y
