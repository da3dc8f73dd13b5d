"""The laws driven by measured states over whole records, without a simulation."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.curved_face import (
    along_face,
    keep_along,
    normal_force,
    onto_table,
    set_face,
    sliding_bound,
)
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.girder import buffer_spring
from slipwise.simulation.kernel.loading_train import follow_train
from slipwise.simulation.kernel.pads import pad_advance, pad_bound, pad_explicit, pad_further
from slipwise.simulation.kernel.places import (
    ALONG,
    APPARENT_AREA,
    BUFFER_GAP,
    BUFFER_MEMORY,
    BUFFER_SIDE,
    BUFFER_STIFFNESS,
    BUFFERS,
    CURVED,
    DT,
    N_ADVANCE,
    N_OBSERVE,
    N_PAD,
    N_STICK,
    N_TRAIN,
    NORMAL,
    RIG_MOTION,
    SIDE,
    SLOPE,
    TRAIN_VELOCITY,
)


@compilable
def pads_over_record(
    effects: Dispatch, u: Array, time: Array, load: Array, velocity: Array, slip: Array,
    motion: Array, which: NDArray[np.int64], force: Array, bounds: Array, first: int, last: int,
) -> None:  # fmt: skip
    """Drive the laws of the pads in columns first..last-1 with what was measured.

    Pads share nothing, so that several threads may each drive some. Where a pad sticks and no effect says how, the law
    gives only the bound: force is then the bound along the motion, F = s A_r v/|v|.

    Args:
        effects: the chosen effects.
        u: the law's numbers; the pads' memory in them goes on.
        time: (n,) [s].
        load: (n, p) [N].
        velocity: (n, p, 2) slip rate [m/s].
        slip: (n, p, 2) [m].
        motion: (n, 3) of the rig, see `campaign.rig_motion`; (0, 3) where no effect asks for it.
        which: (p,) the rig's pad that each column is.
        force: (n, p, 2) of the girder on the pads [N]; filled.
        bounds: (n, p) friction force that each can carry along the table [N]; filled.
        first: of the columns to drive.
        last: the one behind the last of them.
    """
    bristle, further, remembers = u[N_STICK] > 0.0, u[N_PAD] > 0.0, u[N_ADVANCE] > 0.0
    train, observed, curved = u[N_TRAIN] > 0.0, u[N_OBSERVE] > 0.0, u[CURVED] > 0.0
    first_dt = time[1] - time[0] if len(time) > 1 else u[DT]
    for pad in range(first, last):
        z = effects.first_pad + int(which[pad]) * effects.pad_block
        side_x = u[z + SIDE]
        side_y = u[z + SIDE + 1]
        friction = 0.0
        for i in range(len(time)):
            dt = time[i] - time[i - 1] if i > 0 else first_dt
            velocity_x = velocity[i, pad, 0]
            velocity_y = velocity[i, pad, 1]
            slip_x = slip[i, pad, 0]
            slip_y = slip[i, pad, 1]
            if i < len(motion):
                for k in range(3):
                    u[z + RIG_MOTION + k] = motion[i, k]
            if observed:
                effects.observe(
                    u,
                    z,
                    friction,
                    load[i, pad],
                    u[z + APPARENT_AREA],
                    velocity_x,
                    velocity_y,
                    slip_x,
                    slip_y,
                    time[i],
                    dt,
                )
            normal = load[i, pad]
            if curved:
                set_face(effects, u, z, slip_x, slip_y)
                normal = normal_force(u, z, load[i, pad], u[z + ALONG], u[z + ALONG + 1])
            if train:
                force_x, force_y, bound = follow_train(
                    effects, u, z, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i],
                    dt,
                )  # fmt: skip
                velocity_x, velocity_y = u[z + TRAIN_VELOCITY], u[z + TRAIN_VELOCITY + 1]  # of the contact
            elif curved and not bristle:
                speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
                toward_x, toward_y = (velocity_x / speed, velocity_y / speed) if speed > 0.0 else (0.0, 0.0)
                bound, flat = sliding_bound(
                    effects, u, z, load[i, pad], toward_x, toward_y, velocity_x, velocity_y, slip_x, slip_y, side_x,
                    side_y, time[i], dt,
                )  # fmt: skip
                normal = u[z + NORMAL]
                force_x, force_y = flat * toward_x, flat * toward_y
            else:
                bound = pad_bound(
                    effects, u, z, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt
                )
                if bristle:
                    force_x, force_y = pad_explicit(
                        effects, u, z, bound, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y,
                        time[i], dt,
                    )  # fmt: skip
                else:
                    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
                    share = bound / speed if speed > 0.0 else 0.0
                    force_x = share * velocity_x
                    force_y = share * velocity_y
            friction = sqrt(force_x * force_x + force_y * force_y) if further or remembers or observed else 0.0
            held = bound
            if curved:
                keep_along(u, z, force_x, force_y)
                force_x, force_y = onto_table(u, z, force_x, force_y)
                friction = along_face(u, z, force_x, force_y)
                if friction > 0.0:
                    held = bound * sqrt(force_x * force_x + force_y * force_y) / friction
                force_x += load[i, pad] * u[z + SLOPE]
                force_y += load[i, pad] * u[z + SLOPE + 1]
            if further:
                more_x, more_y = pad_further(
                    effects, u, z, bound, friction, normal, velocity_x, velocity_y, slip_x, slip_y, side_x,
                    side_y, time[i], dt,
                )  # fmt: skip
                force_x += more_x
                force_y += more_y
            if remembers and i + 1 < len(time):
                if not train:  # half a step of speed makes an old contact look young: it is worn out over micrometres
                    velocity_x = 0.5 * (velocity_x + velocity[i + 1, pad, 0])
                    velocity_y = 0.5 * (velocity_y + velocity[i + 1, pad, 1])
                pad_advance(
                    effects, u, z, bound, friction, normal, velocity_x, velocity_y, slip_x, slip_y, side_x,
                    side_y, time[i], time[i + 1] - time[i],
                )  # fmt: skip
            force[i, pad, 0] = force_x
            force[i, pad, 1] = force_y
            bounds[i, pad] = held


@compilable
def buffers_over_record(effects: Dispatch, u: Array, time: Array, deflection: Array, rate: Array, force: Array) -> None:
    """Drive every buffer's law with what was measured.

    Args:
        effects: the chosen effects.
        u: the law's numbers; the buffers' memory in them goes on.
        time: (n,) [s].
        deflection: (n, b, 2) [m].
        rate: (n, b, 2) of the deflection [m/s].
        force: (n, b, 2) of the girder on the buffers [N]; filled.
    """
    first_dt = time[1] - time[0] if len(time) > 1 else u[DT]
    for buffer in range(deflection.shape[1]):
        b = int(u[BUFFERS]) + buffer * effects.buffer_block
        gap, side = u[b + BUFFER_GAP], u[b + BUFFER_SIDE]
        for axis in range(2):
            stiffness = u[b + BUFFER_STIFFNESS + axis]
            z = b + BUFFER_MEMORY + axis * effects.buffer_memory
            for i in range(len(time)):
                dt = time[i] - time[i - 1] if i > 0 else first_dt
                force[i, buffer, axis] = buffer_spring(
                    effects,
                    u,
                    z,
                    deflection[i, buffer, axis],
                    rate[i, buffer, axis],
                    stiffness,
                    gap,
                    side,
                    time[i],
                    dt,
                )
