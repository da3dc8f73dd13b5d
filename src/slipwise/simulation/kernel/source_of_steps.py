"""The text of what MuJoCo calls in every step: bounds and forces before it, loads and friction after it."""

from slipwise.simulation.kernel.layout import MAX_DOFS, Layout

#: A bound that MuJoCo accepts and nobody feels [N].
TINY = 1e-9


def step_text(layout: Layout) -> str:
    """Write `control_step` and `sensor_step`."""
    at = layout.at
    return f'''
def control_step(u, time, ten_length, ten_velocity, qvel, frictionloss, applied):
    """Set the friction bounds and the explicit forces of a step; what `mjcb_control` does."""
    dt = u[{at["dt"]}]
    n_pads = int(u[{at["n_pads"]}])
    n_dofs = int(u[{at["n_dofs"]}])
    for dof in range(n_dofs):
        applied[dof] = 0.0
    bristle = u[{at["stick"]}] > 0.0
    for pad in range(n_pads):
        z = {at["pad_memory"]} + pad * {layout.pad_block}
        tendon_x = int(u[{at["tendon"]} + 2 * pad])
        tendon_y = int(u[{at["tendon"]} + 2 * pad + 1])
        row_x = int(u[{at["friction_row"]} + 2 * pad])
        row_y = int(u[{at["friction_row"]} + 2 * pad + 1])
        load = u[{at["load"]} + pad]
        velocity_x = ten_velocity[tendon_x]
        velocity_y = ten_velocity[tendon_y]
        slip_x = ten_length[tendon_x]
        slip_y = ten_length[tendon_y]
        side_x = u[{at["side"]} + 2 * pad]
        side_y = u[{at["side"]} + 2 * pad + 1]
        bound = pad_bound(u, z, load, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt)
        u[{at["bound"]} + pad] = bound
        force_x = 0.0
        force_y = 0.0
        if bristle:
            force_x, force_y = pad_explicit(u, z, bound, load, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt)
            frictionloss[row_x] = {TINY}
            frictionloss[row_y] = {TINY}
        else:
            # Along the velocity where it slides, along the last friction where it sticks: a circle in both.
            last = max(bound, 1.0)
            toward_x = velocity_x / 1e-3 + u[{at["force"]} + 2 * pad] / last
            toward_y = velocity_y / 1e-3 + u[{at["force"]} + 2 * pad + 1] / last
            length = sqrt(toward_x * toward_x + toward_y * toward_y)
            if length > 1e-9:
                frictionloss[row_x] = max(bound * abs(toward_x) / length, {TINY})
                frictionloss[row_y] = max(bound * abs(toward_y) / length, {TINY})
            else:
                frictionloss[row_x] = max(bound, {TINY})
                frictionloss[row_y] = {TINY}
        friction = sqrt(u[{at["force"]} + 2 * pad] ** 2 + u[{at["force"]} + 2 * pad + 1] ** 2)
        more_x, more_y = pad_further(u, z, bound, friction, load, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt)
        force_x += more_x
        force_y += more_y
        u[{at["explicit"]} + 2 * pad] = force_x
        u[{at["explicit"]} + 2 * pad + 1] = force_y
        if force_x != 0.0 or force_y != 0.0:
            j = {at["jacobian"]} + 2 * pad * {MAX_DOFS}
            for dof in range(n_dofs):
                applied[dof] -= u[j + dof] * force_x + u[j + {MAX_DOFS} + dof] * force_y
    sum_x = 0.0
    sum_y = 0.0
    for buffer in range(int(u[{at["n_buffers"]}])):
        stiffness = u[{at["buffer_stiffness"]} + buffer]
        side = 1.0 - 2.0 * buffer
        for axis in range(2):
            tendon = int(u[{at["tendon"]} + 2 * (n_pads + buffer) + axis])
            z = {at["buffer_memory"]} + (2 * buffer + axis) * {layout.buffer_block}
            force = buffer_spring(u, z, ten_length[tendon], ten_velocity[tendon], stiffness, side, time, dt)
            u[{at["buffer_force"]} + 2 * buffer + axis] = force
            j = {at["jacobian"]} + (2 * (n_pads + buffer) + axis) * {MAX_DOFS}
            for dof in range(n_dofs):
                applied[dof] -= u[j + dof] * force
            if axis == 0:
                sum_x += abs(force)
            else:
                sum_y += abs(force)
    dof_x = int(u[{at["girder_dof"]}])
    if dof_x >= 0:
        dof_y = int(u[{at["girder_dof"]} + 1])
        dof_z = int(u[{at["girder_dof"]} + 2])
        force_x, force_y = girder_drag(u, qvel[dof_x], qvel[dof_y], qvel[dof_z], time, dt)
        applied[dof_x] -= force_x
        applied[dof_y] -= force_y
        force_z = girder_lift(u, sum_x, sum_y, qvel[dof_x], qvel[dof_y], qvel[dof_z], time, dt)
        applied[dof_z] += force_z
        if force_z != 0.0 and sum_x + sum_y > 0.0:
            # Each key holds by its share of the horizontal force, where it stands: yaw tells how far from the middle.
            dof_yaw = int(u[{at["girder_dof"]} + 5])
            for buffer in range(int(u[{at["n_buffers"]}])):
                own = u[{at["buffer_force"]} + 2 * buffer], u[{at["buffer_force"]} + 2 * buffer + 1]
                held = force_z * (abs(own[0]) + abs(own[1])) / (sum_x + sum_y)
                j = {at["jacobian"]} + 2 * (n_pads + buffer) * {MAX_DOFS} + dof_yaw
                applied[int(u[{at["girder_dof"]} + 3])] -= u[j] * held
                applied[int(u[{at["girder_dof"]} + 4])] -= u[j + {MAX_DOFS}] * held
        u[{at["girder_force"]}] = -force_x
        u[{at["girder_force"]} + 1] = -force_y
        u[{at["girder_force"]} + 2] = force_z
    return 0


def sensor_step(u, loads, time, ten_length, ten_velocity, friction_force, sensordata):
    """Keep loads and friction for the next step and write them as channels; what `mjcb_sensor` does."""
    dt = u[{at["dt"]}]
    n_pads = int(u[{at["n_pads"]}])
    first = int(u[{at["user_sensor"]}])
    for pad in range(n_pads):
        tendon_x = int(u[{at["tendon"]} + 2 * pad])
        tendon_y = int(u[{at["tendon"]} + 2 * pad + 1])
        friction_x = -friction_force[int(u[{at["friction_row"]} + 2 * pad])]
        friction_y = -friction_force[int(u[{at["friction_row"]} + 2 * pad + 1])]
        force_x = friction_x + u[{at["explicit"]} + 2 * pad]
        force_y = friction_y + u[{at["explicit"]} + 2 * pad + 1]
        load = u[{at["load"]} + pad]
        friction = sqrt(force_x * force_x + force_y * force_y)
        z = {at["pad_memory"]} + pad * {layout.pad_block}
        pad_advance(
            u, z, u[{at["bound"]} + pad], friction, load, ten_velocity[tendon_x], ten_velocity[tendon_y],
            ten_length[tendon_x], ten_length[tendon_y], u[{at["side"]} + 2 * pad], u[{at["side"]} + 2 * pad + 1], time, dt,
        )
        u[{at["force"]} + 2 * pad] = friction_x
        u[{at["force"]} + 2 * pad + 1] = friction_y
        u[{at["load"]} + pad] = loads[pad]
        sensordata[first + 3 * pad] = loads[pad]
        sensordata[first + 3 * pad + 1] = force_x
        sensordata[first + 3 * pad + 2] = force_y
    for i in range(2 * int(u[{at["n_buffers"]}])):
        sensordata[first + 3 * n_pads + i] = u[{at["buffer_force"]} + i]
    last = first + 3 * n_pads + 2 * int(u[{at["n_buffers"]}])
    for axis in range(3):
        sensordata[last + axis] = u[{at["girder_force"]} + axis]
    return 0
'''
