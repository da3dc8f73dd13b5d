"""What acts on the girder besides its pads: buffers, drag, and what the shear keys hold.

    F_b = k d                    per buffer and direction; d less the gap; d and then F_b changed by effects, in turn
    F_drag = sum of drag(v)      V = sum of lift(sum |F_bx|, sum |F_by|, v)

All functions take the chosen effects and the array `u` (see `places`); `z` is the place in it of the memory of a
buffer's direction.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.places import BUFFER_MEMORY, BUFFERS

Array = NDArray[np.float64]


@compilable
def buffer_spring(
    effects: Dispatch, u: Array, z: int, deflection: float, rate: float, stiffness: float, gap: float, side: float,
    time: float, dt: float,
) -> float:  # fmt: skip
    """Give the force of the girder on a buffer in one direction [N]; its memory goes on by dt.

    A buffer that the girder does not touch (a clearance leaves nothing of its deflection) does not deform: its rate is
    zero.

    Args:
        effects: the chosen effects.
        u: the law's numbers.
        z: place of the memory of this buffer and direction.
        deflection: [m].
        rate: of the deflection [m/s].
        stiffness: [N/m].
        gap: way to either side before it is touched [m].
        side: where the buffer stands, -1 to 1 from one side to the other.
        time: since the start of the run [s].
        dt: step [s].
    """
    effects.observe_buffer(u, z, deflection, rate, time, dt)
    left = deflection
    if gap > 0.0:
        left = max(deflection - gap, 0.0) + min(deflection + gap, 0.0)
    left = effects.deflection(u, z, left, rate, stiffness, side, time, dt)
    if left == 0.0 and deflection != 0.0:
        rate = 0.0
    force = effects.spring(u, z, stiffness * left, left, rate, stiffness, side, time, dt)
    effects.settle(u, z, force, left, rate, stiffness, side, time, dt)
    return force


@compilable
def girder_drag(
    effects: Dispatch, u: Array, velocity_x: float, velocity_y: float, velocity_z: float, slip_x: float, slip_y: float,
    time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Give the horizontal force against the girder's motion along x and y [N].

    Args:
        effects: the chosen effects.
        u: the law's numbers.
        velocity_x: girder over table [m/s].
        velocity_y: the same across.
        velocity_z: the same upwards.
        slip_x: of the girder, mean of its pads [m].
        slip_y: the same across.
        time: since the start of the run [s].
        dt: step [s].
    """
    return effects.drag(u, velocity_x, velocity_y, velocity_z, slip_x, slip_y, time, dt)


@compilable
def girder_lift(
    effects: Dispatch, u: Array, force_x: float, force_y: float, velocity_x: float, velocity_y: float,
    velocity_z: float, slip_x: float, slip_y: float, time: float, dt: float,
) -> float:  # fmt: skip
    """Give the vertical force on the girder at the shear keys, whose horizontal force is given [N].

    Their memory goes on by dt. All keys rise together: their memory is that of the first buffer. Each holds by its
    share of the horizontal force.
    """
    z = int(u[BUFFERS]) + BUFFER_MEMORY
    return effects.lift(u, z, force_x, force_y, velocity_x, velocity_y, velocity_z, slip_x, slip_y, time, dt)
