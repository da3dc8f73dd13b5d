"""The law in its two engines: compiled, and plain Python to step through with a debugger.

All effects live in one kernel that is compiled once and kept on disk: which of them act is data. Its file is named by a
hash of everything it was made from, so that no stale code is ever run.
"""

import hashlib
import importlib.util
import math
import os
import sys
import tempfile
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import mujoco

from slipwise.effects import Effect, catalogue
from slipwise.errors import SettingError, SlipwiseWarning
from slipwise.simulation.kernel.layout import Layout, make_layout
from slipwise.simulation.kernel.mjdata import offsets
from slipwise.simulation.kernel.source import function_name, write_source

ENGINES: tuple[str, ...] = ("compiled", "python")
_FUNCTIONS = (
    "pad_bound", "pad_explicit", "pad_further", "pad_advance", "buffer_spring", "girder_drag", "girder_lift",
    "control_step", "sensor_step", "pads_over_record", "buffers_over_record",
)  # fmt: skip


@dataclass(frozen=True)
class Kernel:
    """The law, ready to run.

    Attributes:
        layout: of the flat array that its functions take first.
        engine: "compiled" or "python".
        functions: by name: control_step, sensor_step, pads_over_record, buffers_over_record and their parts.
        callbacks: addresses of the C callbacks (control, sensor); None for the Python engine.
    """

    layout: Layout
    engine: str
    functions: dict[str, Callable[..., Any]]
    callbacks: tuple[int, int] | None


def kernel(engine: str = "compiled", user_effects: Sequence[Effect] = ()) -> Kernel:
    """Give the kernel of the catalogue and a user's effects; made once per process.

    Args:
        engine: "compiled" or "python".
        user_effects: effects from outside the catalogue.

    Raises:
        SettingError: no such engine, or an effect cannot be compiled (it still runs with --engine python).
    """
    if engine not in ENGINES:
        raise SettingError(f"no engine is called {engine!r}; possible: {', '.join(ENGINES)}")
    return _made(engine, tuple(_fingerprint(effect) for effect in user_effects), _Hidden(tuple(user_effects)))


def engine_for(user_effects: Sequence[Effect]) -> str:
    """Give the engine that can run a user's effects: "compiled", or "python" where one cannot be compiled.

    The Python engine runs the same law some hundred times slower; a `SlipwiseWarning` says so, and why.
    """
    if not user_effects:
        return ENGINES[0]
    return _engine_for(tuple(_fingerprint(effect) for effect in user_effects), _Hidden(tuple(user_effects)))


@cache
def _engine_for(files: tuple[str, ...], user: "_Hidden") -> str:
    """Try once per file: a law that cannot be compiled takes as long to find out every time."""
    try:
        _made(ENGINES[0], files, user)
    except SettingError as error:
        names = ", ".join(effect.path.name for effect in user.effects)
        warnings.warn(f"{names} runs on the Python engine, which is slow: {error}", SlipwiseWarning, stacklevel=3)
        return ENGINES[1]
    return ENGINES[0]


def _fingerprint(effect: Effect) -> str:
    return f"{effect.path} {hashlib.sha256(effect.path.read_bytes()).hexdigest()}"


@dataclass(frozen=True)
class _Hidden:
    """Carries effects past the cache, whose key is their files."""

    effects: tuple[Effect, ...]

    def __hash__(self) -> int:
        return 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Hidden)


@cache
def _made(engine: str, files: tuple[str, ...], user: _Hidden) -> Kernel:
    layout = make_layout([*catalogue().values(), *user.effects])
    text = write_source(layout)
    if engine == "python":
        return _python(layout, text)
    return _compiled(layout, text)


def _hooks(layout: Layout) -> list[tuple[str, Effect, str]]:
    return [(function_name(e, hook), e, hook) for e in layout.effects for hook in e.instant_hooks]


def _python(layout: Layout, text: str) -> Kernel:
    namespace: dict[str, Any] = {"sqrt": math.sqrt}
    namespace.update({name: effect.hooks[hook] for name, effect, hook in _hooks(layout)})
    exec(compile(text, "<slipwise kernel>", "exec"), namespace)  # the text is our own: see source.py
    return Kernel(layout, "python", {name: namespace[name] for name in _FUNCTIONS}, None)


def _compiled(layout: Layout, text: str) -> Kernel:
    whole = _module_text(layout, text)
    sources = "".join(effect.path.read_text(encoding="utf-8") for effect in layout.effects)
    about = f"{mujoco.__version__} {sys.version} {_numba_version()}"
    digest = hashlib.sha256((whole + sources + about).encode()).hexdigest()[:16]
    module = _import(f"slipwise_kernel_{digest}", whole)
    try:
        addresses = (int(module.control_callback.address), int(module.sensor_callback.address))
    except AttributeError as error:
        raise SettingError(f"the law could not be compiled: {error}") from error
    return Kernel(layout, "compiled", {name: getattr(module, name) for name in _FUNCTIONS}, addresses)


def _numba_version() -> str:
    from importlib.metadata import version

    return version("numba")


def cache_folder() -> Path:
    """Give the folder in which compiled kernels are kept; SLIPWISE_CACHE overrides it."""
    chosen = os.environ.get("SLIPWISE_CACHE")
    if chosen:
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "slipwise"


def _import(name: str, text: str) -> ModuleType:
    """Import the kernel's module from the cache, writing it first if it is not there."""
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{name}.py"
        if not path.is_file():
            handle, temporary = tempfile.mkstemp(dir=folder, suffix=".tmp")
            with os.fdopen(handle, "w", encoding="utf-8") as stream:
                stream.write(text)
            os.replace(temporary, path)
    except OSError:  # a home that cannot be written: compile for this process only
        folder = Path(tempfile.mkdtemp(prefix="slipwise-"))
        path = folder / f"{name}.py"
        path.write_text(text, encoding="utf-8")
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise SettingError(f"the compiled law cannot be read back from {path}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise SettingError(
            f"the law cannot be compiled ({type(error).__name__}: {str(error).strip().splitlines()[0]}); "
            "a hook of one instant may use arithmetic, math and memory[...] only. --engine python runs it as it is"
        ) from error
    return module


def _module_text(layout: Layout, text: str) -> str:
    """Wrap the law's text into a module that compiles itself and keeps the machine code on disk."""
    imports = []
    for name, effect, hook in _hooks(layout):
        module = effect.hooks[hook].__module__
        if module.startswith("slipwise.effects.") or "user_effect" not in module:
            imports.append(f"from {module} import {hook} as _{name}")
        else:
            imports.append(f"_{name} = sys.modules[{module!r}].{hook}")
        imports.append(f"{name} = njit(_{name})")
    compiled = "@njit(cache=True, nogil=True)\n"
    body = "\n".join(compiled + part if part.startswith("def ") else part for part in _split(text))
    return f'''"""The law of every effect, written and compiled by slipwise.simulation.kernel.engine. Do not edit."""

import sys
from math import sqrt

import numpy as np
from numba import carray, cfunc, njit, types

from slipwise.simulation.kernel.pointers import as_pointer

{chr(10).join(imports)}


{body}

{_callback_text(layout)}
'''


def _split(text: str) -> list[str]:
    """Split a module's text at its top-level functions."""
    parts: list[str] = []
    for line in text.splitlines(keepends=True):
        if line.startswith("def ") or not parts:
            parts.append("")
        parts[-1] += line
    return parts


def _callback_text(layout: Layout) -> str:
    found = offsets()
    data, contact = found.data, found.contact

    def array(field: str, size: str) -> str:
        return f"carray(as_pointer(words[{data[field] // 8}]), ({size},), np.float64)"

    return f"""
WORDS = {max(data.values()) // 8 + 1}


@cfunc(types.void(types.intp, types.intp), cache=True)
def control_callback(model, data):
    words = carray(as_pointer(data), (WORDS,), np.int64)
    numbers = carray(as_pointer(data), (WORDS,), np.float64)
    control_step(
        {array("userdata", str(layout.size))},
        numbers[{data["time"] // 8}],
        {array("ten_length", "64")},
        {array("ten_velocity", "64")},
        {array("qvel", "64")},
        {array("efc_frictionloss", "64")},
        {array("qfrc_applied", "64")},
    )


@cfunc(types.void(types.intp, types.intp, types.intc), cache=True)
def sensor_callback(model, data, stage):
    if stage != {int(mujoco.mjtStage.mjSTAGE_ACC)}:
        return
    words = carray(as_pointer(data), (WORDS,), np.int64)
    numbers = carray(as_pointer(data), (WORDS,), np.float64)
    integers = carray(as_pointer(data), (2 * WORDS,), np.int32)
    u = {array("userdata", str(layout.size))}
    force = {array("efc_force", "4096")}
    loads = u[{layout.at["new_load"]} : {layout.at["new_load"] + 4}]
    loads[:] = 0.0
    first = words[{data["contact"] // 8}]
    for i in range(integers[{data["ncon"] // 4}]):
        one = carray(as_pointer(first + i * {found.contact_size}), ({found.contact_size // 4},), np.int32)
        row = one[{contact["efc_address"] // 4}]
        if row >= 0:
            for pad in range(int(u[{layout.at["n_pads"]}])):
                geom = int(u[{layout.at["pad_geom"]} + pad])
                if one[{contact["geom1"] // 4}] == geom or one[{contact["geom2"] // 4}] == geom:
                    loads[pad] += force[row]
    sensor_step(
        u,
        loads,
        numbers[{data["time"] // 8}],
        {array("ten_length", "64")},
        {array("ten_velocity", "64")},
        force,
        {array("sensordata", "4096")},
    )
"""
