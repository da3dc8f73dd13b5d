"""What MuJoCo calls in every step: bounds and forces before it is solved, friction after it.

Dry friction is a constraint of MuJoCo's: before a step the law sets how much each row of it may carry, from the normal
load of that very step (see `contact`); the solver finds whether a pad slides or sticks. Explicit forces f along a
tendon of Jacobian J act on the girder as -J^T f.
"""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.curved_face import along_face, keep_along, normal_force, onto_table, sliding_bound
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.friction_rows import direction, keep_rate, lift_arms, rate_of_instant, split
from slipwise.simulation.kernel.girder import push_buffers, push_girder
from slipwise.simulation.kernel.loading_train import follow_train
from slipwise.simulation.kernel.pads import pad_advance, pad_bound, pad_explicit, pad_further
from slipwise.simulation.kernel.places import (
    ALONG,
    APPARENT_AREA,
    BOUND,
    BUFFER_FORCE,
    BUFFERS,
    COMPRESSION,
    CURVED,
    DT,
    EXPLICIT,
    FORCE,
    FRICTION_ROW,
    GIRDER_DOF,
    GIRDER_FORCE,
    LOAD,
    MAX_DOFS,
    N_ARMS,
    N_BUFFERS,
    N_OBSERVE,
    N_PADS,
    N_STICK,
    N_TRAIN,
    NORMAL,
    PAD_JACOBIAN,
    PAD_TENDON,
    RATE_AGE,
    RESTORING,
    RIG_MOTION,
    RISE,
    ROW_BOUND,
    SENSE,
    SIDE,
    SLOPE,
    TRAIN_VELOCITY,
    USER_SENSOR,
)
from slipwise.simulation.kernel.prescribed_table import follow_command
from slipwise.simulation.kernel.reversals import turn_friction
from slipwise.simulation.kernel.rig_motion import rig_motion


@compilable
def control_step(
    effects: Dispatch, u: Array, time: float, ten_length: Array, ten_velocity: Array, qvel: Array, frictionloss: Array,
    applied: Array,
) -> None:  # fmt: skip
    """Set the friction bounds and the explicit forces of a step; what `mjcb_control` does.

    Args:
        effects: the chosen effects.
        u: the law's numbers; memory and forces in them go on.
        time: since the start of the run [s].
        ten_length: of MuJoCo's tendons: slip and deflection [m].
        ten_velocity: their rates [m/s].
        qvel: rates of the degrees of freedom [m/s, rad/s].
        frictionloss: what each constraint row of dry friction may carry [N]; set.
        applied: generalised forces [N, N m], of the pads' loads so far; added to.
    """
    rocking_rate, table_velocity, table_acceleration = rig_motion(u, qvel)
    for pad in range(int(u[N_PADS])):
        z = effects.first_pad + pad * effects.pad_block
        u[z + RIG_MOTION] = rocking_rate
        u[z + RIG_MOTION + 1] = table_velocity
        u[z + RIG_MOTION + 2] = table_acceleration
        push_pad(effects, u, z, time, ten_length, ten_velocity, frictionloss, applied)
    u[RATE_AGE] = u[DT]
    sum_x, sum_y = push_buffers(effects, u, time, ten_length, ten_velocity, applied)
    if int(u[GIRDER_DOF]) >= 0:
        push_girder(effects, u, sum_x, sum_y, time, ten_length, qvel, applied)


@compilable
def push_pad(
    effects: Dispatch, u: Array, z: int, time: float, ten_length: Array, ten_velocity: Array, frictionloss: Array,
    applied: Array,
) -> None:  # fmt: skip
    """Set what friction of the pad at `z` may carry and add its explicit forces; arguments as `control_step`."""
    dt = u[DT]
    tendon_x = int(u[z + PAD_TENDON])
    tendon_y = int(u[z + PAD_TENDON + 1])
    load = u[z + LOAD]
    velocity_x = ten_velocity[tendon_x]
    velocity_y = ten_velocity[tendon_y]
    now_x, now_y = rate_of_instant(u, z, velocity_x, velocity_y)
    keep_rate(u, z, now_x, now_y)
    slip_x = ten_length[tendon_x]
    slip_y = ten_length[tendon_y]
    side_x = u[z + SIDE]
    side_y = u[z + SIDE + 1]
    force_x = 0.0
    force_y = 0.0
    curved = u[CURVED] > 0.0
    explicit = u[N_STICK] + u[N_TRAIN] > 0.0
    if u[N_OBSERVE] > 0.0:
        before = sqrt((u[z + FORCE] + u[z + EXPLICIT]) ** 2 + (u[z + FORCE + 1] + u[z + EXPLICIT + 1]) ** 2)
        effects.observe(u, z, before, load, u[z + APPARENT_AREA], velocity_x, velocity_y, slip_x, slip_y, time, dt)
    normal = normal_force(u, z, load, u[z + ALONG], u[z + ALONG + 1]) if curved else load
    if u[N_TRAIN] > 0.0:
        force_x, force_y, bound = follow_train(
            effects, u, z, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt
        )
        velocity_x, velocity_y = u[z + TRAIN_VELOCITY], u[z + TRAIN_VELOCITY + 1]
    elif curved and not explicit:
        toward_x, toward_y, length = direction(u, z, u[z + BOUND], velocity_x, velocity_y)
        toward_x, toward_y = toward_x / length, toward_y / length
        bound, flat = sliding_bound(
            effects, u, z, load, toward_x, toward_y, now_x, now_y, slip_x, slip_y, side_x, side_y, time, dt
        )
        normal = u[z + NORMAL]
        split(u, z, *onto_table(u, z, flat * toward_x, flat * toward_y), frictionloss)
    else:
        bound = pad_bound(effects, u, z, normal, now_x, now_y, slip_x, slip_y, side_x, side_y, time, dt)
    u[z + NORMAL] = normal
    u[z + BOUND] = bound
    if u[N_STICK] > 0.0:
        force_x, force_y = pad_explicit(
            effects, u, z, bound, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt
        )
    if explicit:
        split(u, z, 0.0, 0.0, frictionloss)
        if curved:
            keep_along(u, z, force_x, force_y)
            force_x, force_y = onto_table(u, z, force_x, force_y)
    elif not curved:
        toward_x, toward_y, length = direction(u, z, bound, velocity_x, velocity_y)
        split(u, z, bound * toward_x / length, bound * toward_y / length, frictionloss)
    friction = sqrt(u[z + FORCE] ** 2 + u[z + FORCE + 1] ** 2)
    more_x, more_y = pad_further(
        effects, u, z, bound, friction, load, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt
    )
    force_x += more_x
    force_y += more_y
    u[z + EXPLICIT] = force_x
    u[z + EXPLICIT + 1] = force_y
    if curved:
        u[z + RESTORING] = load * u[z + SLOPE]
        u[z + RESTORING + 1] = load * u[z + SLOPE + 1]
        force_x += u[z + RESTORING]
        force_y += u[z + RESTORING + 1]
        lift_arms(u, z, force_x + u[z + FORCE], force_y + u[z + FORCE + 1], applied)
    if force_x != 0.0 or force_y != 0.0:
        j = z + PAD_JACOBIAN
        for dof in range(int(u[N_ARMS])):
            applied[dof] -= u[j + dof] * force_x + u[j + MAX_DOFS + dof] * force_y


@compilable
def sensor_step(
    effects: Dispatch, u: Array, time: float, ten_length: Array, ten_velocity: Array, friction_force: Array,
    command: Array, qacc: Array, qpos: Array, constraint_force: Array, sensordata: Array,
) -> None:  # fmt: skip
    """Keep friction for the next step and write loads and forces as channels; what `mjcb_sensor` does.

    Args:
        effects: the chosen effects.
        u: the law's numbers; memory and forces in them go on.
        time: since the start of the run [s].
        ten_length: of MuJoCo's tendons: slip and deflection [m].
        ten_velocity: their rates [m/s].
        friction_force: of the constraint rows, on the girder [N]; changed where it turns round within the step, and
            with it what follows the command.
        command: (4,) acceleration of the table [m/s^2, rad/s^2].
        qacc: accelerations of the degrees of freedom [m/s^2, rad/s^2].
        qpos: their positions [m, rad].
        constraint_force: generalised forces of all constraints [N, N m].
        sensordata: MuJoCo's readings [N]; set from the place of the law's own sensor on: load and forces along x and y
            per pad, forces along x and y per buffer, further force on the girder along x, y, z; compression of
            each pad [m], less what its face has risen: how far the girder has come down on it.
    """
    follow_command(u, command, qacc, constraint_force)
    turn_friction(effects, u, ten_velocity, friction_force, qacc, qpos, constraint_force, sensordata)
    n_pads = int(u[N_PADS])
    first = int(u[USER_SENSOR])
    for pad in range(n_pads):
        z = effects.first_pad + pad * effects.pad_block
        tendon_x = int(u[z + PAD_TENDON])
        tendon_y = int(u[z + PAD_TENDON + 1])
        friction_x = -friction_force[int(u[z + FRICTION_ROW])]
        friction_y = -friction_force[int(u[z + FRICTION_ROW + 1])]
        force_x = friction_x + u[z + EXPLICIT]
        force_y = friction_y + u[z + EXPLICIT + 1]
        friction = along_face(u, z, force_x, force_y)
        velocity_x, velocity_y = ten_velocity[tendon_x], ten_velocity[tendon_y]
        if u[N_TRAIN] > 0.0:
            velocity_x, velocity_y = u[z + TRAIN_VELOCITY], u[z + TRAIN_VELOCITY + 1]
        pad_advance(
            effects, u, z, u[z + BOUND], friction, u[z + NORMAL], velocity_x, velocity_y, ten_length[tendon_x],
            ten_length[tendon_y], u[z + SIDE], u[z + SIDE + 1], time, u[DT],
        )  # fmt: skip
        u[z + FORCE] = u[z + SENSE] * u[z + ROW_BOUND] if u[z + SENSE] != 0.0 else friction_x
        u[z + FORCE + 1] = u[z + SENSE + 1] * u[z + ROW_BOUND + 1] if u[z + SENSE + 1] != 0.0 else friction_y
        sensordata[first + 3 * pad] = u[z + LOAD]
        sensordata[first + 3 * pad + 1] = force_x + u[z + RESTORING]
        sensordata[first + 3 * pad + 2] = force_y + u[z + RESTORING + 1]
    n_forces = 2 * int(u[N_BUFFERS])
    for i in range(n_forces):
        b = int(u[BUFFERS]) + i // 2 * effects.buffer_block
        sensordata[first + 3 * n_pads + i] = u[b + BUFFER_FORCE + i % 2]
    for axis in range(3):
        sensordata[first + 3 * n_pads + n_forces + axis] = u[GIRDER_FORCE + axis]
    for pad in range(n_pads):
        z = effects.first_pad + pad * effects.pad_block
        sensordata[first + 3 * n_pads + n_forces + 3 + pad] = u[z + COMPRESSION] - u[z + RISE]
