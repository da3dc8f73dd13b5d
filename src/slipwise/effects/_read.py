"""An effect's file is read and checked: whoever broke the contract is told where, and how to mend it."""

import fnmatch
import functools
import inspect
import re
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from types import ModuleType
from typing import Any, cast

from slipwise.channels import CHANNELS
from slipwise.effects._contract_check import check_answer, try_instant
from slipwise.effects._effect import CONTRACT, Effect
from slipwise.effects._fault import SAMPLE_FAULTS
from slipwise.effects._fields import BASE_ROLES, ENDS, NEEDS, SITS, ForDiagnosis, Gauges, Limit, Rare
from slipwise.effects._flat_fields import what_to_write
from slipwise.effects._hooks import COMPONENTS, HOOKS, LAGGING, PORTS, SIDES
from slipwise.effects._python_text import is_name
from slipwise.errors import SettingError, SlipwiseWarning, unknown_name
from slipwise.params import Parameter

_HELPER = "a function that helps a hook has a name that begins with _"
#: Hooks of 0.1 -> what to write for them.
_GONE = {"settle": "let `spring` change memory[...], as it may ask for all that settle() could"}
#: Units of parameters, with their products and powers.
_SI = frozenset({"m", "kg", "s", "N", "Pa", "J", "W", "K", "Hz", "rad", "V", "A", "C", "T"})
#: Lines that a docstring must have -> an example.
_LINES = {"Valid:": "Valid: speeds of 1 to 500 mm/s.", "Source:": "Source: assumed."}


def read_effect(module: ModuleType, path: Path) -> Effect:
    """Read and check the effect that a module defines.

    Args:
        module: an imported effect file.
        path: the file.

    Raises:
        SettingError: the file breaks the contract; the message says where and how to mend it.
    """
    name = path.stem
    if not is_name(name) or not name.isascii():
        raise SettingError(
            f"{path.name}: the file's name is the effect's, which is a name in Python too: use letters, digits and _, "
            "for example my_effect.py"
        )
    found = getattr(module, "EFFECT", None)
    text = inspect.cleandoc(module.__doc__ or "")
    if not isinstance(found, Effect):
        raise SettingError(
            f"{path.name} defines no EFFECT = Effect(...); `slipwise effects --new my_effect` writes a whole file"
        )
    for needed, example in _LINES.items():
        if needed not in text:
            raise SettingError(f"{path.name}: add a line to the docstring at the head of the file, such as {example!r}")
    if not isinstance(found.contract, int):  # pyright: ignore[reportUnnecessaryIsInstance] - of a user's file
        raise SettingError(f"{path.name}: contract is {found.contract!r}; write contract={CONTRACT}, a number")
    if found.contract not in range(CONTRACT + 1):
        raise SettingError(
            f"{path.name} is written for contract {found.contract!r} of effects, and this Slipwise knows contract "
            f"{CONTRACT}; install a newer one with `pip install --upgrade slipwise`, or give contract={CONTRACT}"
        )
    _check_declared(path, found)
    _check_units(path, found)
    if found.port not in PORTS:
        raise unknown_name(f"port (of {path.name})", found.port, PORTS)
    if found.component not in COMPONENTS:
        raise unknown_name(f"component (of {path.name})", found.component, COMPONENTS)
    if len({p.name for p in found.parameters}) < len(found.parameters):
        raise SettingError(f"{path.name}: two parameters share a name; rename one of them")
    defined = {n: f for n, f in vars(module).items() if inspect.isfunction(f) and f.__module__ == module.__name__}
    hooks = {n: f for n, f in defined.items() if not n.startswith("_")}
    _check_hooks(path, found, hooks)
    asked = {argument for function in hooks.values() for argument in inspect.signature(function).parameters}
    hooks = {n: f if HOOKS[n].instant else _by_name(path, n, f) for n, f in hooks.items()}
    if not found.replaces and all(p.neutral is None for p in found.parameters):
        raise SettingError(
            f"{path.name}: no parameter has a neutral value, so the effect could never be off; give one of them the "
            "value at which it changes nothing, the sixth of Parameter(name, unit, typical, low, high, neutral, ...)"
        )
    _check_asked(path, found, asked)
    for pattern in found.moves:
        if not any(fnmatch.fnmatchcase(channel, pattern) for channel in CHANNELS) and pattern != "*":
            raise SettingError(
                f"{path.name}: 'moves' names {pattern!r}, which is no channel; `slipwise channels` lists them"
            )
    if found.flat:
        _tell_once(what_to_write(path.name, found.flat))
    rare = replace(found.rare, turns=found.turns or bool(SIDES & asked))
    return replace(found, name=name, summary=text.splitlines()[0], text=text, hooks=hooks, path=path, rare=rare)


@functools.cache
def _tell_once(words: str) -> None:
    """Say something about a file, once in a process."""
    warnings.warn(words, SlipwiseWarning, stacklevel=4)


def _check_declared(path: Path, effect: Effect) -> None:
    """Refuse words that mean nothing, and a filter that does not say its lag.

    Raises:
        SettingError: with what is possible.
    """
    for name, block in (("diagnosis", ForDiagnosis), ("gauges", Gauges), ("rare", Rare)):
        if not isinstance(getattr(effect, name), block):
            raise SettingError(f"{path.name}: write {name}={block.__name__}(...) in EFFECT, from slipwise.effects")
    for name, kind in (("parameters", Parameter), ("moves", str), ("memory", str), ("needs", str), ("limits", Limit)):
        given: object = getattr(effect, name)
        if not isinstance(given, tuple) or not all(isinstance(each, kind) for each in cast(tuple[object, ...], given)):
            what = '"text"' if kind is str else f"{kind.__name__}(...)"
            raise SettingError(
                f"{path.name}: write {name}=({what},) in EFFECT, with a comma behind each, one alone too"
            )
    for what, given, possible in (
        *(("need", need, NEEDS) for need in effect.needs),
        *(("parameter with a limit", limit.parameter, effect.parameter_names) for limit in effect.limits),
        *(("end of a parameter's bounds", limit.end, ENDS) for limit in effect.limits),
        *((("role in the base model", effect.base, BASE_ROLES),) if effect.base else ()),
        ("way to sit on gauges", effect.gauges.sits, SITS),
        *((("parameter for its lag", effect.lag, effect.parameter_names),) if effect.lag else ()),
    ):
        if given not in possible:
            raise unknown_name(f"{what} (of {path.name})", given, possible)
    for kind in effect.fault.samples if effect.fault else ():
        if kind not in SAMPLE_FAULTS:
            raise unknown_name(f"fault of samples (of {path.name})", kind, SAMPLE_FAULTS)
    if effect.plainer and not effect.lag:
        raise SettingError(f"{path.name}: it has a plainer form ({effect.plainer}), so it must name the `lag` of both")


def _check_units(path: Path, effect: Effect) -> None:
    """Refuse a parameter in millimetres: hooks are given SI, and a number in another unit would be taken for that.

    Raises:
        SettingError: with the parameter.
    """
    for p in effect.parameters:
        words = {word for word in re.split(r"[^A-Za-z]+", p.unit) if word}
        if words - _SI:
            raise SettingError(
                f"{path.name}: parameter {p.name!r} is in {p.unit!r}, and its numbers are SI: use "
                f"{', '.join(sorted(_SI))}, their products and powers, or '1'; a unit that people read it in is the "
                'ninth of Parameter(...), as shown_in="mm"'
            )


def _check_hooks(path: Path, effect: Effect, hooks: Mapping[str, Callable[..., Any]]) -> None:
    """Refuse functions that the port cannot have, arguments that nothing gives, and answers of another kind."""
    allowed = PORTS[effect.port]
    if not hooks:
        raise SettingError(f"{path.name} has no hook; an effect on port {effect.port!r} may have: {', '.join(allowed)}")
    for hook, function in hooks.items():
        if hook not in allowed:
            raise SettingError(
                f"{path.name}: an effect on port {effect.port!r} cannot have a hook {hook!r}; "
                f"possible: {', '.join(allowed)}; {_GONE.get(hook, _HELPER)}"
            )
        _check_arguments(path, effect, hook, function)
        if HOOKS[hook].instant or hook == "rest":
            try_instant(path, effect, hook, function)


def _check_arguments(path: Path, effect: Effect, hook: str, function: Callable[..., Any]) -> None:
    can = HOOKS[hook].inputs.keys() | ({"memory"} if HOOKS[hook].memory else set[str]())
    for argument in inspect.signature(function).parameters:
        if argument not in can and argument not in effect.parameter_names:
            near = get_close_matches(argument, [*can, *effect.parameter_names], n=2, cutoff=0.7)
            meant = f"did you mean {' or '.join(near)}? Else " if near else ""
            raise SettingError(
                f"{path.name}: {hook}() asks for {argument!r}: {meant}add a Parameter of that name to EFFECT, which "
                f"has {', '.join(effect.parameter_names)}, or ask for what this hook can have: {', '.join(sorted(can))}"
            )
        if argument in LAGGING and "time_constant" not in effect.parameter_names:
            raise SettingError(
                f"{path.name}: {hook}() asks for {argument!r}: it needs a "
                'Parameter("time_constant", "s", 0.03, 1e-3, 1.0, None, "assumed", "t_c: of the lag") in EFFECT'
            )
        if argument == "memory" and not effect.memory:
            raise SettingError(
                f"{path.name}: {hook}() asks for memory: EFFECT must name what it remembers, as memory=('largest',)"
            )


def _check_asked(path: Path, effect: Effect, asked: set[str]) -> None:
    """Refuse a parameter that no hook asks for: a fit could not tell its value.

    Raises:
        SettingError: with its name.
    """
    used = asked | ({"time_constant"} if LAGGING & asked else set[str]())
    for name in effect.parameter_names:
        if name not in used:
            raise SettingError(
                f"{path.name}: no hook asks for the parameter {name!r}: name it among a hook's arguments, or take it "
                "out of EFFECT"
            )


def _by_name(path: Path, hook: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """Let a hook of whole arrays be called with everything it may have; it gets what it asks for."""
    asked = inspect.signature(function).parameters

    @functools.wraps(function)
    def called(*given: Any, **named: Any) -> Any:
        everything = {**dict(zip(HOOKS[hook].leading, given, strict=False)), **named}
        answer = function(**{name: value for name, value in everything.items() if name in asked})
        check_answer(path, hook, answer)
        return answer

    return called
