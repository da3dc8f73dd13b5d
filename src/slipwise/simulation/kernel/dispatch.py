"""The one part of the law that a program writes: the calls of the effects' hooks by the names of their arguments.

For every hook there is one function that lets the effects of the model act one after another, in the order in which
the array `u` lists them:

    def area(u, z, real_area, true_pressure, load, ...):
        for place in range(283, 283 + int(u[276])):
            which = int(u[place])
            if which == 6:
                real_area = contact_area__area(real_area, pressure, u[311])
        return real_area

Which effects act, and in which order, is data, so one compilation serves every model.
"""

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol

from slipwise.effects import DERIVED, RIG_MOTION, Effect
from slipwise.simulation.kernel import derived_states, places
from slipwise.simulation.kernel.layout import OBSERVED, Layout, observes, of_each_pad
from slipwise.simulation.kernel.places import CHAINS, EFFECT_COUNT, N_OBSERVE, N_OBSERVE_BUFFER, PAD_MEMORY


class Dispatch(Protocol):
    """The module of that text: what the effects do, hook by hook, and where their memory stands.

    Every function takes the array `u`, then the place `z` of the block of the pad, or of the memory of the buffer, at
    hand (not `drag` and `stretch`), then what `_HOOKS` lists. It is a module, because numba resolves a module's
    functions and numbers while it compiles.

    Attributes:
        area: gives the real area of contact [m^2].
        shear: gives the shear strength of the contact [Pa].
        coefficient: gives the coefficient of friction [1].
        stick: gives the force of what says how a pad sticks, along x and y [N].
        pad: gives the sum of the further forces at a pad, along x and y [N].
        face: gives the curvature of a pad's sliding face [1/m].
        advance: lets the memory of a pad go on.
        stretch: gives how far the loading train of a slider stretches under a force [m].
        deflection: gives what is left of a buffer's deflection [m].
        spring: gives a buffer's force [N].
        lift: gives the vertical force at the shear keys [N].
        drag: gives the force against the girder's motion, along x and y [N].
        observe: brings the derived states of a pad up to date.
        observe_buffer: the same of a buffer's direction.
        first_pad: place in `u` of the first pad's block.
        pad_block: size of one pad's block.
        buffer_block: size of one buffer's block; where the first begins stands in `u`.
        buffer_memory: size of the memory of one buffer and direction.
    """

    area: Callable[..., float]
    shear: Callable[..., float]
    coefficient: Callable[..., float]
    stick: Callable[..., tuple[float, float]]
    pad: Callable[..., tuple[float, float]]
    face: Callable[..., float]
    advance: Callable[..., None]
    stretch: Callable[..., float]
    deflection: Callable[..., float]
    spring: Callable[..., float]
    lift: Callable[..., float]
    drag: Callable[..., tuple[float, float]]
    observe: Callable[..., None]
    observe_buffer: Callable[..., None]
    first_pad: int
    pad_block: int
    buffer_block: int
    buffer_memory: int


_PAD = (
    "load", "pressure", "apparent_area", "speed", "velocity_x", "velocity_y", "slip_x", "slip_y", "side_x", "side_y",
    "time", "dt",
)  # fmt: skip
_BUFFER = ("deflection", "rate", "stiffness", "side", "time", "dt")
_GIRDER = ("velocity_x", "velocity_y", "velocity_z", "slip_x", "slip_y", "time", "dt")


class _Hook(NamedTuple):
    """How the calls of a hook's effects become one answer: arguments, answer before the first, {call}, answer."""

    arguments: tuple[str, ...]
    begin: tuple[str, ...]
    each: tuple[str, ...]
    answer: str


_NOTHING = ("force_x = 0.0", "force_y = 0.0")
_ADD = ("more_x, more_y = {call}", "force_x += more_x", "force_y += more_y")
_FORCES = "force_x, force_y"
_HOOKS: dict[str, _Hook] = {
    "area": _Hook(("u", "z", "real_area", "true_pressure", *_PAD), (), ("real_area = {call}",), "real_area"),
    "shear": _Hook(("u", "z", "shear", "real_area", "true_pressure", *_PAD), (), ("shear = {call}",), "shear"),
    "coefficient": _Hook(("u", "z", "coefficient", *_PAD), (), ("coefficient = {call}",), "coefficient"),
    "stick": _Hook(("u", "z", "bound", *_PAD), _NOTHING, ("force_x, force_y = {call}",), _FORCES),
    "pad": _Hook(("u", "z", "bound", "friction", *_PAD), _NOTHING, _ADD, _FORCES),
    "face": _Hook(("u", "z", "face"), (), ("face = {call}",), "face"),
    "advance": _Hook(("u", "z", "bound", "friction", *_PAD), (), ("{call}",), "None"),
    "stretch": _Hook(("u", "force", "load"), ("stretched = 0.0",), ("stretched += {call}",), "stretched"),
    "deflection": _Hook(("u", "z", *_BUFFER), (), ("deflection = {call}",), "deflection"),
    "spring": _Hook(("u", "z", "force", *_BUFFER), (), ("force = {call}",), "force"),
    "lift": _Hook(("u", "z", "force_x", "force_y", *_GIRDER), ("force_z = 0.0",), ("force_z += {call}",), "force_z"),
    "drag": _Hook(("u", *_GIRDER), _NOTHING, _ADD, _FORCES),
}

#: What the functions that bring derived states up to date are given, and what they pass on.
_OBSERVED_BY: dict[str, tuple[str, ...]] = {
    "observe": (
        "friction", "load", "apparent_area", "velocity_x", "velocity_y", "slip_x", "slip_y", "time", "dt",
    ),
    "observe_buffer": ("0.0", "0.0", "1.0", "rate", "0.0", "deflection", "0.0", "time", "dt"),
}  # fmt: skip
_OBSERVE: dict[str, tuple[str, ...]] = {
    "observe": ("u", "z", *_OBSERVED_BY["observe"]),
    "observe_buffer": ("u", "z", "deflection", "rate", "time", "dt"),
}


def function_name(effect: Effect, hook: str) -> str:
    """Name of an effect's hook among the functions of all effects."""
    return f"{effect.name}__{hook}"


def dispatch_text(layout: Layout, decorator: str = "") -> str:
    """Write the module that is a `Dispatch`; the effects' hooks stand in it under `function_name`."""
    written = [*(_function(layout, hook) for hook in CHAINS), *(_observing(layout, name) for name in OBSERVED)]
    functions = "\n\n\n".join(decorator + text for text in written)
    return f"""first_pad, pad_block = {layout.first_pad}, {layout.pad_block}
buffer_block, buffer_memory = {layout.buffer_block}, {layout.buffer_memory_size}


{functions}
"""


def _function(layout: Layout, hook: str) -> str:
    """Write the function that lets the effects which have a hook act one after another."""
    how = _HOOKS[hook]
    calls = {
        i: [line.replace("{call}", _call(layout, effect, hook)) for line in how.each]
        for i, effect in enumerate(layout.effects)
        if hook in effect.hooks
    }
    lines = [f"def {hook}({', '.join(how.arguments)}):", *(f"    {line}" for line in how.begin)]
    lines += _one_by_one(layout.at[hook], EFFECT_COUNT + CHAINS.index(hook), calls)
    return "\n".join([*lines, f"    return {how.answer}"])


def _observing(layout: Layout, name: str) -> str:
    """Write the function that brings the derived states of those effects up to date which ask for them."""
    calls = {}
    for i, effect in enumerate(layout.effects):
        if observes(effect) == name:
            start = _memory_place(layout, effect, layout.derived[effect.name])
            lagging = "time_constant" in effect.parameter_names
            lag = _parameter(layout, effect, "time_constant") if lagging else "1.0"
            memory = f"u[{start} : {start} + {derived_states.SIZE}]"
            calls[i] = [f"derived_states.observe({memory}, {', '.join(_OBSERVED_BY[name])}, {lag})"]
    lines = [f"def {name}({', '.join(_OBSERVE[name])}):"]
    count = N_OBSERVE if name == "observe" else N_OBSERVE_BUFFER
    return "\n".join([*lines, *_one_by_one(layout.at[name], count, calls), "    return None"])


def _one_by_one(first: int, count: int, calls: Mapping[int, Sequence[str]]) -> list[str]:
    """Write the loop over a list of effects: the list begins at `first` in `u`, its length stands at `count`."""
    if not calls:
        return []
    lines = [f"    for place in range({first}, {first} + int(u[{count}])):", "        which = int(u[place])"]
    for n, (i, call) in enumerate(calls.items()):
        lines.append(f"        {'if' if n == 0 else 'elif'} which == {i}:")
        lines.extend(f"            {line}" for line in call)
    return lines


def _call(layout: Layout, effect: Effect, hook: str) -> str:
    """Write the call of an effect's hook: its parameters and its memory stand in `u`."""
    arguments = []
    for name in inspect.signature(effect.hooks[hook]).parameters:
        if name in effect.parameter_names:
            arguments.append(_parameter(layout, effect, name))
        elif name == "memory":
            first = (layout.pad_memory | layout.buffer_memory)[effect.name]
            place = _memory_place(layout, effect, first)
            arguments.append(f"u[{place} : {place} + {len(effect.memory)}]")
        elif name in DERIVED:
            place = _memory_place(layout, effect, layout.derived[effect.name] + tuple(DERIVED).index(name))
            arguments.append(f"u[{place}]")
        elif name in RIG_MOTION:
            arguments.append(f"u[z + {places.RIG_MOTION + tuple(RIG_MOTION).index(name)}]")
        else:
            arguments.append(name)
    return f"{function_name(effect, hook)}({', '.join(arguments)})"


def _memory_place(layout: Layout, effect: Effect, offset: int) -> str:
    """Write where something of an effect's memory stands: `z` is a pad's block, of a buffer the memory itself."""
    return f"z + {offset + (PAD_MEMORY if effect.name in layout.pad_memory else 0)}"


def _parameter(layout: Layout, effect: Effect, name: str) -> str:
    """Write a parameter: each pad has its own of the effects on pads."""
    place = layout.parameters[effect.name] + effect.parameter_names.index(name)
    return f"u[z + {place}]" if of_each_pad(effect) else f"u[{place}]"
