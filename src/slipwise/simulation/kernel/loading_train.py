"""What stands between a slider's gauge and its contact: a train that stretches under the force that it carries.

    v_c = v - dD/dt,  D = D(|F|) F/|F|,        |F| <= b(0) where the contact sticks,        F = b(v_c) v_c/|v_c| else

v is the rate at the gauge, v_c that of the contact, D the sum of what the parts of the train stretch, along the force.
Over a step of length dt both are solved together (backward Euler, the direction by radial return): the contact slides
as slowly as the law and the train ask for.

Source: Rice & Ruina (1983), spring and slider, quasi-static.
"""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.pads import pad_bound
from slipwise.simulation.kernel.places import TRAIN_FORCE, TRAIN_TIME, TRAIN_VELOCITY

#: Evaluations for one step at most, and the share of the force at which they end [1].
_MOST, _CLOSE = 60, 1e-14
#: Doublings of a force in search of one that friction cannot bear [1].
_DOUBLINGS = 8


@compilable
def follow_train(
    effects: Dispatch, u: Array, z: int, load: float, velocity_x: float, velocity_y: float, slip_x: float,
    slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Let the train and its contact follow the gauge by one step; what the train remembers goes on.

    Returns:
        Force along x and y, and the friction that the contact could carry [N]; the contact's rate stands at
        `TRAIN_VELOCITY`.
    """
    at = z + TRAIN_FORCE
    before = sqrt(u[at] * u[at] + u[at + 1] * u[at + 1])
    stretched = effects.stretch(u, before, load) / before if before > 0.0 else 0.0
    asked_x, asked_y = stretched * u[at], stretched * u[at + 1]
    slip_x -= asked_x
    slip_y -= asked_y
    if abs(time - u[z + TRAIN_TIME] - dt) <= 0.5 * dt:  # else a new run: its gauge may stand anywhere
        asked_x += velocity_x * dt
        asked_y += velocity_y * dt
    asked = sqrt(asked_x * asked_x + asked_y * asked_y)
    toward_x, toward_y = (asked_x / asked, asked_y / asked) if asked > 0.0 else (0.0, 0.0)
    state = (slip_x, slip_y, side_x, side_y, time, dt)
    bound = pad_bound(effects, u, z, load, 0.0, 0.0, *state)
    rate = 0.0
    if effects.stretch(u, bound, load) >= asked:
        force = _stretched_to(effects, u, asked, bound, load)
    else:
        force, rate, bound = _sliding(effects, u, z, asked, bound, load, toward_x, toward_y, state)
    u[at], u[at + 1] = force * toward_x, force * toward_y
    u[z + TRAIN_TIME] = time
    u[z + TRAIN_VELOCITY], u[z + TRAIN_VELOCITY + 1] = rate * toward_x, rate * toward_y
    return force * toward_x, force * toward_y, bound


@compilable
def _stretched_to(effects: Dispatch, u: Array, asked: float, most: float, load: float) -> float:
    """Return the force between nothing and `most` [N] under which the train has stretched as far as is asked [m]."""
    low, high = 0.0, most
    below, above = -asked, effects.stretch(u, most, load) - asked
    force = high
    for _ in range(_MOST):
        if below >= 0.0 or above <= 0.0 or high - low <= _CLOSE * most:
            break
        force = low - below * (high - low) / (above - below)
        left = effects.stretch(u, force, load) - asked
        if abs(left) <= _CLOSE * asked:
            break
        if left > 0.0:
            high, above, below = force, left, 0.5 * below
        else:
            low, below, above = force, left, 0.5 * above
    return force


@compilable
def _sliding(
    effects: Dispatch, u: Array, z: int, asked: float, at_rest: float, load: float, toward_x: float, toward_y: float,
    state: tuple[float, float, float, float, float, float],
) -> tuple[float, float, float]:  # fmt: skip
    """Return force [N], rate [m/s] and bound [N] of a contact that slides: regula falsi (Illinois) over the force."""
    dt = state[5]
    rate = asked / dt  # of a train that does not carry anything
    fastest = pad_bound(effects, u, z, load, rate * toward_x, rate * toward_y, *state)
    low, high = 0.0, max(at_rest, fastest)
    below, above = -fastest, -1.0
    bound = fastest
    for _ in range(_DOUBLINGS):  # friction may be higher between rest and that rate
        rate = max(asked - effects.stretch(u, high, load), 0.0) / dt
        bound = pad_bound(effects, u, z, load, rate * toward_x, rate * toward_y, *state)
        above = high - bound
        if above >= 0.0:
            break
        low, below = high, above
        high = 2.0 * high
    force = high
    for _ in range(_MOST):
        if below >= 0.0 or above <= 0.0 or high - low <= _CLOSE * high:
            break
        force = low - below * (high - low) / (above - below)
        rate = max(asked - effects.stretch(u, force, load), 0.0) / dt
        bound = pad_bound(effects, u, z, load, rate * toward_x, rate * toward_y, *state)
        left = force - bound
        if abs(left) <= _CLOSE * force:
            break
        if left > 0.0:
            high, above, below = force, left, 0.5 * below
        else:
            low, below, above = force, left, 0.5 * above
    return force, rate, bound
