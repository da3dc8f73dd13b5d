"""The law in its two engines: compiled, and plain Python to step through with a debugger.

All effects live in one kernel that is compiled once and kept on disk (`jobs.machine_code`): which of them act is
data. It is named by a hash of everything it was made from, so that no stale code is ever run.
"""

import hashlib
import inspect
import linecache
import sys
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, partial
from pathlib import Path
from types import ModuleType
from typing import Any

import mujoco
import numpy as np

from slipwise import effects
from slipwise.effects import Effect, catalogue
from slipwise.errors import SettingError, SlipwiseWarning
from slipwise.jobs.machine_code import content_key
from slipwise.simulation.kernel import derived_states
from slipwise.simulation.kernel.compiled import module_text
from slipwise.simulation.kernel.curved_face import set_faces
from slipwise.simulation.kernel.dispatch import dispatch_text, function_name
from slipwise.simulation.kernel.girder import buffer_spring, girder_drag, girder_lift
from slipwise.simulation.kernel.layout import Layout, make_layout
from slipwise.simulation.kernel.loading_train import follow_train
from slipwise.simulation.kernel.pads import pad_advance, pad_bound, pad_explicit, pad_further
from slipwise.simulation.kernel.records import buffers_over_record, pads_over_record
from slipwise.simulation.kernel.step import control_step, sensor_step

ENGINES: tuple[str, ...] = ("compiled", "python")
#: What is asked for from Python; all else is only called by these.
_FUNCTIONS: tuple[Callable[..., Any], ...] = (
    pad_bound, follow_train, pad_explicit, pad_further, pad_advance, buffer_spring, girder_drag, girder_lift,
    set_faces, control_step, sensor_step, pads_over_record, buffers_over_record,
)  # fmt: skip


@dataclass(frozen=True)
class Kernel:
    """The law, ready to run.

    Attributes:
        layout: of the flat array that its functions take first.
        engine: "compiled" or "python".
        functions: by name: control_step, sensor_step, pads_over_record, buffers_over_record and their parts.
        callback_addresses: compiles the C callbacks and gives their addresses (control, sensor), none for the Python
            engine.
    """

    layout: Layout
    engine: str
    functions: dict[str, Callable[..., Any]]
    callback_addresses: Callable[[], tuple[int, int] | None]

    @cached_property
    def callbacks(self) -> tuple[int, int] | None:
        """Addresses of the C callbacks (control, sensor); None for the Python engine."""
        return self.callback_addresses()


def kernel(engine: str = "compiled", user_effects: Sequence[Effect] = ()) -> Kernel:
    """Return the kernel of the catalogue and a user's effects; made once per process.

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
    """Return the engine that can run a user's effects: "compiled", or "python" where one cannot be compiled.

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
    if engine == "python":
        return _python(layout)
    law = _compiled(layout)
    if user.effects:
        _compile_hooks(law)
    return law


def _python(layout: Layout) -> Kernel:
    """Call the law's functions as they stand in their files; only the calls of the hooks are made from text."""
    text, file = dispatch_text(layout), "<calls of the effects' hooks>"
    calls = ModuleType("slipwise_kernel_python")
    vars(calls)["derived_states"] = derived_states
    vars(calls).update({function_name(e, hook): e.hooks[hook] for e in layout.effects for hook in e.instant_hooks})
    exec(compile(text, file, "exec"), vars(calls))  # the text is our own: see dispatch.py
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)  # a debugger can show it
    functions = {function.__name__: partial(function, calls) for function in _FUNCTIONS}
    return Kernel(layout, "python", functions, lambda: None)


def _compiled(layout: Layout) -> Kernel:
    text = module_text(layout, _FUNCTIONS)
    deciding = [*Path(__file__).parent.glob("*.py"), *Path(effects.__file__).parent.glob("*.py")]
    deciding += [effect.path for effect in layout.effects]
    sources = "".join(path.read_text(encoding="utf-8") for path in sorted(set(deciding)))
    hooks = "".join(content_key(hook) for effect in layout.effects for hook in effect.instant_hooks.values())
    digest = hashlib.sha256((text + sources + hooks + mujoco.__version__).encode()).hexdigest()[:16]
    module = _module(f"slipwise_kernel_{digest}", text)
    functions = {f.__name__: getattr(module, f.__name__) for f in _FUNCTIONS}
    return Kernel(layout, "compiled", functions, module.callback_addresses)


def _compile_hooks(law: Kernel) -> None:
    """Compile what calls the hooks, on records of nothing: a user's file that cannot be compiled is told of at once.

    Raises:
        SettingError: it cannot be compiled.
    """
    layout, nothing = law.layout, np.zeros((0, 1, 2))
    numbers = np.zeros(layout.buffers(1) + layout.buffer_block)
    which = np.zeros(1, dtype=np.int64)
    try:
        law.functions["pads_over_record"](
            numbers,
            nothing[:, 0, 0],
            nothing[..., 0],
            nothing,
            nothing,
            nothing[:, 0],
            which,
            nothing,
            nothing[..., 0],
            0,
            0,
        )
        law.functions["buffers_over_record"](numbers, nothing[:, 0, 0], *(nothing,) * 3)
        for function in (girder_drag, girder_lift):
            given = len(inspect.signature(function).parameters) - 2
            law.functions[function.__name__](numbers, *(0.0,) * given)
    except Exception as error:
        raise SettingError(
            f"the law cannot be compiled ({type(error).__name__}: {str(error).strip().splitlines()[0]}); "
            "a hook of one instant may use arithmetic, math and memory[...] only. --engine python runs it as it is"
        ) from error


def _module(name: str, text: str) -> ModuleType:
    """Make the kernel's module from its text; a debugger and numba's messages can show its lines."""
    file = f"<{name}>"
    module = ModuleType(name)
    sys.modules[name] = module  # numba looks up there what machine code from the disk belongs to
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    exec(compile(text, file, "exec"), vars(module))  # the text is our own: see compiled.py
    return module
