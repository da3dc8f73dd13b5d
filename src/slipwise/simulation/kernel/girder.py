"""What acts on the girder besides its pads: buffers, drag, and what the shear keys hold.

    F_b = k d                    per buffer and direction; d less the gap; d and then F_b changed by effects, in turn
    F_drag = sum of drag(v)      V = sum of lift(sum |F_bx|, sum |F_by|, v)

All functions take the chosen effects and the array `u` (see `places`); `z` is the place in it of the memory of a
buffer's direction.
"""

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.places import (
    BUFFER_FORCE,
    BUFFER_GAP,
    BUFFER_JACOBIAN,
    BUFFER_MEMORY,
    BUFFER_SIDE,
    BUFFER_STIFFNESS,
    BUFFER_TENDON,
    BUFFERS,
    DT,
    GIRDER_DOF,
    GIRDER_FORCE,
    MAX_DOFS,
    N_ARMS,
    N_BUFFERS,
    N_PADS,
    PAD_TENDON,
)


@compilable
def buffer_spring(
    effects: Dispatch, u: Array, z: int, deflection: float, rate: float, stiffness: float, gap: float, side: float,
    time: float, dt: float,
) -> float:  # fmt: skip
    """Return the force of the girder on a buffer in one direction [N]; its memory goes on by dt.

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
    return effects.spring(u, z, stiffness * left, left, rate, stiffness, side, time, dt)


@compilable
def girder_drag(
    effects: Dispatch, u: Array, velocity_x: float, velocity_y: float, velocity_z: float, slip_x: float, slip_y: float,
    time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Return the horizontal force against the girder's motion along x and y [N].

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
    """Return the vertical force on the girder at the shear keys, whose horizontal force is given [N].

    Their memory goes on by dt. All keys rise together: their memory is that of the first buffer. Each holds by its
    share of the horizontal force.
    """
    z = int(u[BUFFERS]) + BUFFER_MEMORY
    return effects.lift(u, z, force_x, force_y, velocity_x, velocity_y, velocity_z, slip_x, slip_y, time, dt)


@compilable
def push_buffers(
    effects: Dispatch, u: Array, time: float, ten_length: Array, ten_velocity: Array, applied: Array
) -> tuple[float, float]:
    """Add the buffers' forces; gives the sums of their sizes along x and y [N].

    Arguments as `control_step` of `step.py`.
    """
    sum_x = 0.0
    sum_y = 0.0
    for buffer in range(int(u[N_BUFFERS])):
        b = int(u[BUFFERS]) + buffer * effects.buffer_block
        for axis in range(2):
            tendon = int(u[b + BUFFER_TENDON + axis])
            z = b + BUFFER_MEMORY + axis * effects.buffer_memory
            force = buffer_spring(
                effects, u, z, ten_length[tendon], ten_velocity[tendon], u[b + BUFFER_STIFFNESS + axis],
                u[b + BUFFER_GAP], u[b + BUFFER_SIDE], time, u[DT],
            )  # fmt: skip
            u[b + BUFFER_FORCE + axis] = force
            j = b + BUFFER_JACOBIAN + axis * MAX_DOFS
            for dof in range(int(u[N_ARMS])):
                applied[dof] -= u[j + dof] * force
            if axis == 0:
                sum_x += abs(force)
            else:
                sum_y += abs(force)
    return sum_x, sum_y


@compilable
def push_girder(
    effects: Dispatch, u: Array, sum_x: float, sum_y: float, time: float, ten_length: Array, qvel: Array, applied: Array
) -> None:
    """Add drag and what the shear keys hold.

    A key holds its share of the vertical force, V |F_b| / sum |F_b|, where it stands: it rolls and pitches the girder.

    Args:
        effects: the chosen effects.
        u: the law's numbers.
        sum_x: sum of the sizes of the buffers' forces along x [N].
        sum_y: the same along y [N].
        time: since the start of the run [s].
        ten_length: of MuJoCo's tendons: slip and deflection [m].
        qvel: rates of the degrees of freedom [m/s, rad/s].
        applied: generalised forces [N, N m]; added to.
    """
    dof_x = int(u[GIRDER_DOF])
    dof_y = int(u[GIRDER_DOF + 1])
    dof_z = int(u[GIRDER_DOF + 2])
    n_pads = int(u[N_PADS])
    slip_x = 0.0
    slip_y = 0.0
    for pad in range(n_pads):
        z = effects.first_pad + pad * effects.pad_block
        slip_x += ten_length[int(u[z + PAD_TENDON])] / n_pads
        slip_y += ten_length[int(u[z + PAD_TENDON + 1])] / n_pads
    force_x, force_y = girder_drag(effects, u, qvel[dof_x], qvel[dof_y], qvel[dof_z], slip_x, slip_y, time, u[DT])
    applied[dof_x] -= force_x
    applied[dof_y] -= force_y
    force_z = girder_lift(effects, u, sum_x, sum_y, qvel[dof_x], qvel[dof_y], qvel[dof_z], slip_x, slip_y, time, u[DT])
    applied[dof_z] += force_z
    if force_z != 0.0 and sum_x + sum_y > 0.0:
        # The column of yaw in a tendon's Jacobian is the distance of the key from the middle.
        dof_yaw = int(u[GIRDER_DOF + 5])
        for buffer in range(int(u[N_BUFFERS])):
            b = int(u[BUFFERS]) + buffer * effects.buffer_block
            own_x = u[b + BUFFER_FORCE]
            own_y = u[b + BUFFER_FORCE + 1]
            held = force_z * (abs(own_x) + abs(own_y)) / (sum_x + sum_y)
            j = b + BUFFER_JACOBIAN + dof_yaw
            applied[int(u[GIRDER_DOF + 3])] -= u[j] * held
            applied[int(u[GIRDER_DOF + 4])] -= u[j + MAX_DOFS] * held
    u[GIRDER_FORCE] = -force_x
    u[GIRDER_FORCE + 1] = -force_y
    u[GIRDER_FORCE + 2] = force_z
