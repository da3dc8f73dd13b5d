"""The rows of MuJoCo's constraints that a pad's dry friction is: which way it acts, how much they may carry, where."""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.places import (
    BOUND,
    DT,
    FORCE,
    FRICTION_ROW,
    GIRDER_DOF,
    LAST_BOUND,
    LAST_NORMAL,
    LAST_RATE,
    LAST_VELOCITY,
    NORMAL,
    OVER_REST,
    RATE,
    RATE_AGE,
    RATE_SHARE,
    RISE,
    RISES_OVER_PADS,
    ROW_BOUND,
)

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
    """Return a pad's slip rate [m/s] at the instant of its position, none where it turns round before that.

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
def keep_rate(u: Array, z: int, now_x: float, now_y: float) -> None:
    """Keep the slip rate [m/s] for which the law of the pad at `z` is asked, and what the step before knew."""
    u[z + LAST_BOUND], u[z + LAST_NORMAL] = u[z + BOUND], u[z + NORMAL]
    u[z + LAST_RATE], u[z + LAST_RATE + 1] = u[z + RATE], u[z + RATE + 1]
    u[z + RATE], u[z + RATE + 1] = now_x, now_y


@compilable
def learn_rate_dependence(u: Array, z: int) -> None:
    """Find how what the pad at `z` may carry depends on its speed near rest, from this step and the one before.

    Friction that turns round within a step passes through other speeds than that of the step's instant.
    """
    u[z + RATE_SHARE], u[z + OVER_REST] = 0.0, 1.0
    speed = sqrt(u[z + RATE] ** 2 + u[z + RATE + 1] ** 2)
    last = sqrt(u[z + LAST_RATE] ** 2 + u[z + LAST_RATE + 1] ** 2)
    if u[z + LAST_BOUND] <= 0.0 or u[z + BOUND] <= 0.0 or last - speed <= REST:
        return
    coefficient = u[z + BOUND] / u[z + NORMAL]
    slope = (u[z + LAST_BOUND] / u[z + LAST_NORMAL] - coefficient) / (last - speed)
    at_rest = coefficient - slope * speed
    if at_rest > 0.0:
        # What a straight line says holds for small changes only: laws may be much steeper near rest.
        most = MOST_CHANGE / last
        u[z + RATE_SHARE] = min(max(slope / at_rest, -most), most)
        u[z + OVER_REST] = 1.0 + u[z + RATE_SHARE] * speed


@compilable
def direction(u: Array, z: int, bound: float, velocity_x: float, velocity_y: float) -> tuple[float, float, float]:
    """Return a vector along which a pad's friction acts, and its length, so that what it may carry [N] is a circle.

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
