"""Writes the law as Python text: every hook of every effect called by the names of its arguments.

One text, three uses: run as it is (Python engine), compiled into the step callback, compiled into the loops over
records. Which effects act, and in which order, is data (`layout`), so one compilation serves every model.
"""

import inspect

from slipwise.effects import Effect
from slipwise.kernel.layout import MAX_DOFS, Layout

_PAD_ARGUMENTS = (
    "load", "velocity_x", "velocity_y", "slip_x", "slip_y", "side_x", "side_y", "time", "dt",
)  # fmt: skip
_BUFFER_ARGUMENTS = ("deflection", "rate", "stiffness", "side", "time", "dt")
_GIRDER_ARGUMENTS = ("velocity_x", "velocity_y", "velocity_z", "time", "dt")


def function_name(effect: Effect, hook: str) -> str:
    """Name of a hook inside the kernel."""
    return f"{effect.name}__{hook}"


def _call(layout: Layout, effect: Effect, hook: str) -> str:
    arguments = []
    start = layout.parameters[effect.name]
    for name in inspect.signature(effect.hooks[hook]).parameters:
        if name in effect.parameter_names:
            arguments.append(f"u[{start + effect.parameter_names.index(name)}]")
        elif name == "memory":
            place = layout.pad_memory if effect.name in layout.pad_memory else layout.buffer_memory
            first = place[effect.name]
            arguments.append(f"u[z + {first} : z + {first + len(effect.memory)}]")
        else:
            arguments.append(name)
    return f"{function_name(effect, hook)}({', '.join(arguments)})"


def _chain(layout: Layout, hook: str, assign: str, indent: str = "    ") -> str:
    """Write the loop over the effects of a hook: `assign` holds {call}."""
    users = [(i, e) for i, e in enumerate(layout.effects) if hook in e.hooks]
    if not users:
        return ""
    at = layout.at[hook]
    lines = [f"{indent}for place in range({at + 1}, {at + 1} + int(u[{at}])):", f"{indent}    which = int(u[place])"]
    for n, (i, effect) in enumerate(users):
        lines.append(f"{indent}    {'if' if n == 0 else 'elif'} which == {i}:")
        lines.extend(
            f"{indent}        {line}" for line in assign.replace("{call}", _call(layout, effect, hook)).splitlines()
        )
    return "\n".join(lines) + "\n"


def write_source(layout: Layout) -> str:
    """Write the module's text; the hooks stand in its namespace as `function_name` names them."""
    at = layout.at
    pad_arguments = ", ".join(_PAD_ARGUMENTS)
    parts = [
        f'''
def pad_bound(u, z, {pad_arguments}):
    """Friction force that a pad can carry, s A_r [N]."""
    if load <= 0.0:
        return 0.0
    apparent_area = u[{at["apparent_area"]}]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    if u[{at["full_stick"]}] > 0.0 and speed < {STICK_SPEED}:
        speed = 1e3
    real_area = load / u[{at["plastic_pressure"]}]
    true_pressure = load / real_area
{_chain(layout, "area", "real_area = {call}")}    true_pressure = load / real_area
    shear = u[{at["shear_strength"]}]
{_chain(layout, "shear", "shear = {call}")}    return max(shear * real_area, 0.0)


def pad_explicit(u, z, bound, {pad_arguments}):
    """Force of a bristle on port `stick` (force_x, force_y) [N]; only called if there is one."""
    force_x = 0.0
    force_y = 0.0
    apparent_area = u[{at["apparent_area"]}]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
{_chain(layout, "stick", "force_x, force_y = {call}")}    return force_x, force_y


def pad_further(u, z, bound, friction, {pad_arguments}):
    """Forces on port `pad` (force_x, force_y) [N], those of the girder on the pad."""
    force_x = 0.0
    force_y = 0.0
    apparent_area = u[{at["apparent_area"]}]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
{_chain(layout, "pad", f"more_x, more_y = {{call}}{chr(10)}force_x += more_x{chr(10)}force_y += more_y")}    return force_x, force_y


def pad_advance(u, z, bound, friction, {pad_arguments}):
    """Let a pad's memory go on by dt."""
    apparent_area = u[{at["apparent_area"]}]
    pressure = load / apparent_area
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
{_chain(layout, "advance", "{call}")}    return 0


def buffer_spring(u, z, {", ".join(_BUFFER_ARGUMENTS)}):
    """Force of the girder on a buffer in one direction [N]; its memory goes on by dt.

    A buffer that the girder does not touch (`deflection` leaves nothing of it) is not strained: its rate is zero.
    """
    between = deflection
{_chain(layout, "deflection", "deflection = {call}")}    if deflection == 0.0 and between != 0.0:
        rate = 0.0
    force = stiffness * deflection
{_chain(layout, "spring", "force = {call}")}{_chain(layout, "settle", "{call}")}    return force


def girder_drag(u, {", ".join(_GIRDER_ARGUMENTS)}):
    """Horizontal force against the girder's motion (force_x, force_y) [N]."""
    force_x = 0.0
    force_y = 0.0
{_chain(layout, "drag", f"more_x, more_y = {{call}}{chr(10)}force_x += more_x{chr(10)}force_y += more_y")}    return force_x, force_y


def girder_lift(u, force_x, force_y, {", ".join(_GIRDER_ARGUMENTS)}):
    """Vertical force on the girder at the shear keys, whose horizontal force is given [N]."""
    force_z = 0.0
{_chain(layout, "lift", "force_z += {call}")}    return force_z
''',
        _step_text(layout),
        _record_text(layout),
    ]
    return "\n".join(parts)


#: Below this speed [m/s] a pad counts as sticking where the capacity to stick matters.
STICK_SPEED = 1e-4


def _step_text(layout: Layout) -> str:
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


#: A bound that MuJoCo accepts and nobody feels [N].
TINY = 1e-9


def _record_text(layout: Layout) -> str:
    at = layout.at
    return f'''
def pads_over_record(u, time, load, velocity, slip, force, bounds, first, last):
    """Drive the law of pads first..last-1 with measured load (n, p), velocity and slip (n, p, 2).

    Fills force (n, p, 2) and bounds (n, p). Pads share nothing, so that several threads may each drive some. Where a
    pad sticks without a bristle, the law gives only the bound: force is then the bound along the motion.
    """
    bristle = u[{at["stick"]}] > 0.0
    for pad in range(first, last):
        z = {at["pad_memory"]} + pad * {layout.pad_block}
        side_x = u[{at["side"]} + 2 * pad]
        side_y = u[{at["side"]} + 2 * pad + 1]
        for i in range(len(time)):
            dt = time[i] - time[i - 1] if i > 0 else time[1] - time[0]
            velocity_x = velocity[i, pad, 0]
            velocity_y = velocity[i, pad, 1]
            slip_x = slip[i, pad, 0]
            slip_y = slip[i, pad, 1]
            bound = pad_bound(u, z, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt)
            if bristle:
                force_x, force_y = pad_explicit(
                    u, z, bound, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt
                )
            else:
                speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
                force_x = bound * velocity_x / speed if speed > 0.0 else 0.0
                force_y = bound * velocity_y / speed if speed > 0.0 else 0.0
            friction = sqrt(force_x * force_x + force_y * force_y)
            more_x, more_y = pad_further(
                u, z, bound, friction, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt
            )
            pad_advance(
                u, z, bound, friction, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt
            )
            force[i, pad, 0] = force_x + more_x
            force[i, pad, 1] = force_y + more_y
            bounds[i, pad] = bound
    return 0


def buffers_over_record(u, time, deflection, rate, force):
    """Drive every buffer's law with measured deflection and rate (n, b, 2); fills force (n, b, 2)."""
    for buffer in range(deflection.shape[1]):
        stiffness = u[{at["buffer_stiffness"]} + buffer]
        side = 1.0 - 2.0 * buffer
        for axis in range(2):
            z = {at["buffer_memory"]} + (2 * buffer + axis) * {layout.buffer_block}
            for i in range(len(time)):
                dt = time[i] - time[i - 1] if i > 0 else time[1] - time[0]
                force[i, buffer, axis] = buffer_spring(
                    u, z, deflection[i, buffer, axis], rate[i, buffer, axis], stiffness, side, time[i], dt
                )
    return 0
'''
