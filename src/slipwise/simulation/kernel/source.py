"""Writes the law as Python text: every hook of every effect called by the names of its arguments.

One text, three uses: run as it is (Python engine), compiled into the step callback, compiled into the loops over
records. Which effects act, and in which order, is data (`layout`), so one compilation serves every model.
"""

import inspect

from slipwise.effects import Effect
from slipwise.simulation.kernel.layout import Layout
from slipwise.simulation.kernel.source_of_records import record_text
from slipwise.simulation.kernel.source_of_steps import step_text

_PAD_ARGUMENTS = (
    "load", "velocity_x", "velocity_y", "slip_x", "slip_y", "side_x", "side_y", "time", "dt",
)  # fmt: skip
_BUFFER_ARGUMENTS = ("deflection", "rate", "stiffness", "side", "time", "dt")
_GIRDER_ARGUMENTS = ("velocity_x", "velocity_y", "velocity_z", "time", "dt")
#: Below this speed [m/s] a pad counts as sticking where the capacity to stick matters.
STICK_SPEED = 1e-4


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
    """Vertical force on the girder at the shear keys, whose horizontal force is given [N]; their memory goes on by dt.

    All keys rise together: their memory is that of the first buffer. Each holds by its share of the horizontal force.
    """
    z = {at["buffer_memory"]}
    force_z = 0.0
{_chain(layout, "lift", "force_z += {call}")}    return force_z
''',
        step_text(layout),
        record_text(layout),
    ]
    return "\n".join(parts)
