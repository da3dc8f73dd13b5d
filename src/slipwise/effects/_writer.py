"""Effect files that a program writes: a law in, a file out that reads, checks and runs like one of the catalogue.

Code comes from the program that writes: the lines of the hooks. All else are words; they may hold the name of a
campaign or a path, so whatever could end a quotation is taken from them.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.machinery import PathFinder
from math import isfinite
from pathlib import Path

from slipwise.effects._catalogue import catalogue
from slipwise.effects._effect import CONTRACT
from slipwise.effects._hooks import PORTS
from slipwise.effects._python_text import WIDTH, is_name, paragraph, sentence, words
from slipwise.effects._written_hook import HOMES, WrittenHook, function_text, names_from_elsewhere
from slipwise.errors import SettingError, unknown_name
from slipwise.params import Parameter
from slipwise.record import write_text
from slipwise.short_repr import short_repr

_FILE = '''"""{title}

{equation}

{about}

{valid}
{source}
"""

{imports}


{hooks}


EFFECT = Effect(
{entries}
)
'''
#: What every file imports, and nearly every one.
_ALWAYS: dict[str, str] = {
    "Effect": "slipwise.effects", "ForDiagnosis": "slipwise.effects", "Parameter": "slipwise.params",
    "RESPONSE": "slipwise.effects", "Gauges": "slipwise.effects",
}  # fmt: skip


@short_repr
@dataclass(frozen=True)
class WrittenEffect:
    """An effect to be written; what is not said here is as in `Effect`.

    Attributes:
        name: of the file.
        title: what it is, the first line of the docstring.
        equation: in plain text, one line.
        about: paragraphs that explain it.
        valid: range of validity.
        source: where it comes from, or "assumed".
        port: where it acts.
        component: what it belongs to in a verdict.
        hooks: in the order in which they are written.
        parameters: of the hooks.
        signature: how it shows.
        confused_with: other effects -> the test that tells them apart.
        memory: names of the numbers it remembers.
        moves: channels that it may change; empty for `RESPONSE`.
        target: "channel" where it sits on one of these channels at a time.
    """

    name: str
    title: str
    equation: str
    about: tuple[str, ...]
    valid: str
    source: str
    port: str
    component: str
    hooks: tuple[WrittenHook, ...]
    parameters: tuple[Parameter, ...]
    signature: str
    confused_with: Mapping[str, str]
    memory: tuple[str, ...] = ()
    moves: tuple[str, ...] = ()
    target: str = ""


def effect_text(written: WrittenEffect) -> str:
    """Return the text of an effect's file.

    Args:
        written: the effect.

    Raises:
        UnknownNameError: no such port, or it has no such hook.
        SettingError: a name that is none in Python, a number that is not finite, or a body that is no Python.
    """
    _check(written)
    return _FILE.format(
        title=sentence(written.title, WIDTH - 3),
        equation=paragraph(words(written.equation), "    "),
        about="\n\n".join(paragraph(words(part)) for part in written.about),
        valid=paragraph(f"Valid: {words(written.valid)}"),
        source=paragraph(f"Source: {words(written.source)}"),
        imports="\n\n".join(_imports(written)),
        hooks="\n\n\n".join(function_text(hook) for hook in written.hooks),
        entries="\n".join(f"    {name}={value}," for name, value in _entries(written).items()),
    )


def write_effect(written: WrittenEffect, folder: Path, *, replace: bool = False) -> Path:
    """Write an effect's file, whole or not at all.

    Args:
        written: the effect.
        folder: where to; it is made if it does not exist.
        replace: whether a file of this name may be written over.

    Returns:
        The file, FOLDER/NAME.py.

    Raises:
        UnknownNameError: no such port, or it has no such hook.
        SettingError: the name cannot be that of an effect's file, there is such a file, or as `effect_text`.
        OutputError: the folder cannot be written.
    """
    check_name(written.name)
    path = folder / f"{written.name}.py"
    if path.exists() and not replace:
        raise SettingError(f"{path} exists already and is left as it is; give another name or another folder")
    write_text(path, effect_text(written))
    return path


def _check(written: WrittenEffect) -> None:
    """Refuse what would not be Python, or more than it should be."""
    if written.port not in PORTS:
        raise unknown_name("port", written.port, PORTS)
    for hook in written.hooks:
        if hook.name not in PORTS[written.port]:
            raise unknown_name(f"hook of port {written.port!r}", hook.name, PORTS[written.port])
    names = [*(a for hook in written.hooks for a in hook.arguments), *(p.name for p in written.parameters)]
    for name in (*names, *written.memory, *written.confused_with):
        if not is_name(name):
            raise SettingError(f"{name!r} in effect {written.name!r} is no name in Python: use letters, digits and _")
    for p in written.parameters:
        for value in (p.typical, p.low, p.high, p.neutral):
            if value is not None and not isfinite(value):
                raise SettingError(f"parameter {p.name!r} of effect {written.name!r} is {value}: give a finite number")


def check_name(name: str) -> None:
    """Refuse what cannot be the name of a user's effect.

    Args:
        name: of the effect to be written.

    Raises:
        SettingError: it is no name in Python, that of a module, or one of the catalogue.
    """
    if not is_name(name) or not name.isascii() or name.startswith("_"):
        raise SettingError(
            f"{name!r} cannot be the name of an effect, which is one in Python too: use letters a to z, digits and _, "
            "and begin with a letter, for example my_effect"
        )
    if _is_module(name):
        raise SettingError(
            f"{name!r} is the name of a module: in its folder {name}.py would be taken for it; give another name, for "
            f"example my_{name}"
        )
    if name in catalogue():
        raise SettingError(f"an effect called {name!r} exists already; give yours another name, for example my_{name}")


def _is_module(name: str) -> bool:
    """Return whether Python, or a package that is installed, has a module of this name, or Python looks for it."""
    if name in sys.stdlib_module_names or name in ("sitecustomize", "usercustomize"):
        return True
    installed = [place for place in sys.path if Path(place).name in ("site-packages", "dist-packages")]
    return PathFinder.find_spec(name, installed) is not None


def _entries(written: WrittenEffect) -> dict[str, str]:
    """Return what EFFECT says, as Python."""
    entries = {
        "contract": str(CONTRACT),
        "port": _quoted(written.port),
        "parameters": _lines("(", [_parameter(p) for p in written.parameters], ")", 4),
    }
    entries |= {"memory": _names(written.memory)} if written.memory else {}
    rivals = [f'"{rival}": {_quoted(test)}' for rival, test in written.confused_with.items()]
    diagnosis = (
        f"component={_quoted(written.component)}",
        f"equation={_quoted(written.equation)}",
        f"moves={_names(written.moves) if written.moves else 'RESPONSE'}",
        f"signature={_quoted(written.signature)}",
        f"confused_with={_lines('{', rivals, '}', 8)}",
    )
    entries["diagnosis"] = _lines("ForDiagnosis(", diagnosis, ")", 4)
    return entries | ({"gauges": f"Gauges(target={_quoted(written.target)})"} if written.target else {})


def _parameter(p: Parameter) -> str:
    numbers = ("None" if value is None else repr(float(value)) for value in (p.typical, p.low, p.high, p.neutral))
    items = [_quoted(p.name), _quoted(p.unit), *numbers, _quoted(p.source), _quoted(p.meaning)]
    items += [_quoted(p.shown_in)] if p.shown_in else []
    return f"Parameter({', '.join([*items, *(['whole=True'] if p.whole else [])])})"


def _quoted(text: str) -> str:
    return f'"{words(text)}"'


def _names(names: Sequence[str]) -> str:
    return f"({', '.join(map(_quoted, names))}{',' if len(names) == 1 else ''})"


def _lines(opening: str, items: Sequence[str], closing: str, indent: int) -> str:
    """Return items between brackets, each on a line of its own; a single one of a tuple stays with them if it fits."""
    if len(items) == 1 and opening == "(" and len(items[0]) < WIDTH - 18:
        return f"({items[0]},)"
    margin = " " * indent
    lines = [f"\n{margin}    {item}," for item in items]
    return f"{opening}{''.join(lines)}\n{margin}{closing}" if items else opening + closing


def _imports(written: WrittenEffect) -> list[str]:
    """Return the groups of imports: of the standard library, numpy, ours; in each the order of ruff and isort."""
    homes = {**HOMES, **_ALWAYS}
    used = {name for hook in written.hooks for name in names_from_elsewhere(hook)}
    used |= _ALWAYS.keys() - ({"RESPONSE"} if written.moves else set()) - (set() if written.target else {"Gauges"})
    groups: dict[bool, list[str]] = {False: [], True: []}
    for module in sorted({homes[name] for name in used} - {"numpy"}):
        # constants before classes, and these before functions
        names = sorted((n for n in used if homes[n] == module), key=lambda n: (not n.isupper(), n.islower(), n))
        groups[module.startswith("slipwise")].append(f"from {module} import {', '.join(names)}")
    numpy = ["import numpy as np"] if "np" in used else []
    return ["\n".join(group) for group in (groups[False], numpy, groups[True]) if group]
