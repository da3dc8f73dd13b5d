"""What stands between a slider's gauge and its contact: a train that stretches under the force that it carries.

    v_c = v - dD(F)/dt,        |F| <= b(0) where the contact sticks,        F = b(v_c) sign(v_c) where it slides

v is the rate at the gauge, v_c that of the contact, D the sum of what the parts of the train stretch. Over a step of
length dt both are solved together (backward Euler): the contact slides as slowly as the law and the train ask for.
The train acts along x, as the actuator of a slider does.

Source: Rice & Ruina (1983), spring and slider, quasi-static.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.pads import pad_bound
from slipwise.simulation.kernel.places import TRAIN_FORCE, TRAIN_TIME, TRAIN_VELOCITY

Array = NDArray[np.float64]
#: Evaluations of a law for one step at most, and the share of the force at which they end [1].
_MOST, _CLOSE = 40, 1e-9


@compilable
def follow_train(
    effects: Dispatch, u: Array, z: int, pad: int, load: float, velocity_x: float, slip_x: float, slip_y: float,
    side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Let the train and its contact follow the gauge by one step; what the train remembers goes on.

    Returns:
        Force along x and the friction that the contact could carry [N]; the contact's rate stands at `TRAIN_VELOCITY`.
    """
    before = u[TRAIN_FORCE + pad]
    way = velocity_x * dt
    if abs(time - u[TRAIN_TIME + pad] - dt) > 0.5 * dt:  # a new run: its gauge may stand anywhere
        way = 0.0
    stretched = effects.stretch(u, before, load)
    contact = slip_x - stretched
    asked = stretched + way
    sign = 1.0 if asked > 0.0 else -1.0
    at_rest = pad_bound(effects, u, z, load, 0.0, 0.0, contact, slip_y, side_x, side_y, time, dt)
    rate = 0.0
    bound = at_rest
    if abs(effects.stretch(u, sign * at_rest, load)) >= abs(asked):
        force = _stretched_to(effects, u, asked, sign * at_rest, load)
    else:
        force, rate, bound = _sliding(effects, u, z, asked, at_rest, load, contact, slip_y, side_x, side_y, time, dt)
    u[TRAIN_FORCE + pad] = force
    u[TRAIN_TIME + pad] = time
    u[TRAIN_VELOCITY + pad] = rate
    return force, bound


@compilable
def _stretched_to(effects: Dispatch, u: Array, asked: float, most: float, load: float) -> float:
    """Give the force between nothing and `most` [N] under which the train has stretched as far as is asked [m]."""
    low = 0.0
    high = most
    for _ in range(_MOST):
        middle = 0.5 * (low + high)
        if abs(effects.stretch(u, middle, load)) < abs(asked):
            low = middle
        else:
            high = middle
        if abs(high - low) <= _CLOSE * abs(most):
            break
    return 0.5 * (low + high)


@compilable
def _sliding(
    effects: Dispatch, u: Array, z: int, asked: float, at_rest: float, load: float, slip_x: float, slip_y: float,
    side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Give force [N], rate [m/s] and bound [N] of a contact that slides: regula falsi (Illinois) over the force."""
    sign = 1.0 if asked > 0.0 else -1.0
    low = 0.0
    high = at_rest
    above = -1.0
    rate = 0.0
    bound = at_rest
    for _ in range(8):  # friction that grows with speed asks for more than it is at rest
        rate = max(abs(asked) - abs(effects.stretch(u, sign * high, load)), 0.0) / dt
        bound = pad_bound(effects, u, z, load, sign * rate, 0.0, slip_x, slip_y, side_x, side_y, time, dt)
        above = high - bound
        if above >= 0.0:
            break
        low = high
        high = 2.0 * high + 1e-9
    rate = max(abs(asked) - abs(effects.stretch(u, sign * low, load)), 0.0) / dt
    below = low - pad_bound(effects, u, z, load, sign * rate, 0.0, slip_x, slip_y, side_x, side_y, time, dt)
    force = high
    for _ in range(_MOST):
        if high - low <= _CLOSE * high or below >= 0.0 or above <= 0.0:
            break
        force = low - below * (high - low) / (above - below)
        rate = max(abs(asked) - abs(effects.stretch(u, sign * force, load)), 0.0) / dt
        bound = pad_bound(effects, u, z, load, sign * rate, 0.0, slip_x, slip_y, side_x, side_y, time, dt)
        left = force - bound
        if abs(left) <= _CLOSE * force:
            break
        if left > 0.0:
            high = force
            above = left
            below *= 0.5
        else:
            low = force
            below = left
            above *= 0.5
    return sign * force, sign * rate, bound
