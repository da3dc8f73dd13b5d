"""The module that numba compiles: the effects' hooks, their calls, the law bound to them.

Only the machine code of the functions that stand in it is kept on disk; the law's functions are compiled into them.
MuJoCo's callbacks hold all of the law once more and take as long to compile as all else: they are compiled where a
simulation first asks for them.
"""

import inspect
from collections.abc import Callable, Sequence
from typing import Any

from slipwise.simulation.kernel.dispatch import dispatch_text, function_name
from slipwise.simulation.kernel.layout import Layout
from slipwise.simulation.kernel.mjdata import offsets
from slipwise.simulation.kernel.pointers import fields


def module_text(layout: Layout, functions: Sequence[Callable[..., Any]]) -> str:
    """Write the module.

    Args:
        layout: of the effects that there are.
        functions: of the law, which take `Dispatch` first; the module holds them bound to the effects' hooks.
    """
    # A user's file lies on no path: like all effects it is in `sys.modules`, whence every hook is fetched.
    hooks = [
        f"{function_name(e, name)} = njit(**INNER)(sys.modules[{function.__module__!r}].{name})"
        for e in layout.effects
        for name, function in e.instant_hooks.items()
    ]
    bound = [line for function in functions for line in _bound(function)]
    return f'''"""Written by slipwise.simulation.kernel.compiled. Do not edit."""

import sys

from numba import njit, types

from slipwise.jobs.machine_code import kept, kept_callback
from slipwise.simulation.kernel import curved_face, derived_states, girder, loading_train, pads, pointers, records, step
from slipwise.simulation.kernel.compilable import INNER
from slipwise.simulation.kernel.pointers import Fields

{chr(10).join(hooks)}


{dispatch_text(layout, "@kept(forceinline=True, **INNER)" + chr(10))}
EFFECTS = sys.modules[__name__]
FIELDS = {fields(offsets())!r}

{chr(10).join(bound)}


def callback_addresses():
    @kept_callback(types.void(types.intp, types.intp))
    def control_callback(model, data):
        pointers.control_at(EFFECTS, FIELDS, data)

    @kept_callback(types.void(types.intp, types.intp, types.intc))
    def sensor_callback(model, data, stage):
        pointers.sensor_at(EFFECTS, FIELDS, data, stage)

    return control_callback.address, sensor_callback.address
'''


def _bound(function: Callable[..., Any]) -> list[str]:
    """Write a function of the law without its first argument."""
    arguments = ", ".join(list(inspect.signature(function).parameters)[1:])
    home = function.__module__.rpartition(".")[2]
    return [
        "",
        "",
        "@kept(nogil=True)",
        f"def {function.__name__}({arguments}):",
        f"    return {home}.{function.__name__}(EFFECTS, {arguments})",
    ]
