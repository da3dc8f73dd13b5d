"""What an object shows of itself, in a notebook or a traceback, is one line: no pages of arrays."""

import inspect
import sys
import types
import typing
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np
import pytest

import slipwise as sw
from slipwise.display import Shown
from slipwise.short_repr import short_repr

MOST = 500


def types_in(hint: Any) -> Iterator[type]:
    """All classes that a type holds, itself included."""
    inside = hint if isinstance(hint, list) else typing.get_args(hint)
    if inspect.isclass(hint) and not inside:
        yield hint
    for each in inside:
        yield from types_in(each)


def hints(of: Any, names: dict[str, Any]) -> dict[str, Any]:
    """Types of a function or a class; nothing where one of them is of a package that is loaded only when used."""
    try:
        return typing.get_type_hints(of, names)
    except NameError:
        return {}


def given_by(cls: type) -> Iterator[type]:
    """Classes of the public fields, properties and answers of a class."""
    names = vars(sys.modules[cls.__module__])
    found = [hint for name, hint in hints(cls, names).items() if not name.startswith("_")]
    for name, member in vars(cls).items():
        function = getattr(member, "fget", None) or getattr(member, "func", None) or member
        if not name.startswith("_") and inspect.isfunction(function):
            found.append(hints(function, names).get("return"))
    for hint in found:
        yield from types_in(hint)


def public() -> list[Any]:
    """What stands behind the names of the door, and what its modules state as theirs."""
    door = [getattr(sw, name) for name in sw.__all__]
    modules = [each for each in door if inspect.ismodule(each)]
    return door + [getattr(module, name) for module in modules for name in getattr(module, "__all__", ())]


def public_data() -> list[type]:
    """Every data class of ours that somebody gets who uses the door, and what these hold in turn."""
    waiting = [each for each in public() if inspect.isclass(each)]
    for function in filter(inspect.isfunction, public()):
        waiting += types_in(hints(function, vars(sys.modules[function.__module__])).get("return"))
    seen: set[type] = set()
    while waiting:
        cls = waiting.pop()
        if cls not in seen and cls.__module__.startswith("slipwise"):
            seen.add(cls)
            waiting += given_by(cls)
    return sorted(filter(is_dataclass, seen), key=lambda cls: (cls.__module__, cls.__name__))


DATA = public_data()
RESULTS = [cls for cls in DATA if issubclass(cls, Shown)]


#: What a field is filled with that holds one plain value; any other holds a lot.
PLAIN: dict[type, Any] = {float: -1.2345678901234567e-300, int: 10**9, bool: False, str: "x" * 60, type(None): None}
LOT = [np.arange(99.0)] * 99


def filled(hint: Any) -> Any:
    """A long value for a plain type, or for one of several plain ones, and much for everything else."""
    if typing.get_origin(hint) is typing.Literal:
        return max(map(str, typing.get_args(hint)), key=len)
    kinds = typing.get_args(hint) if typing.get_origin(hint) in (typing.Union, types.UnionType) else (hint,)
    plain = [value for kind, value in PLAIN.items() if any(kind is each for each in kinds)]
    return plain[0] if len(plain) == len(kinds) else LOT


def large(cls: type) -> Any:
    """An object with long numbers and sentences in its plain fields, and much in all others."""
    one = object.__new__(cls)
    kinds = hints(cls, vars(sys.modules[cls.__module__]))
    for field in fields(cls):
        object.__setattr__(one, field.name, filled(kinds.get(field.name, Any)))
    return one


def test_what_is_public_is_found():
    assert {"Verdict", "Interval", "Specimen", "Candidate"} <= {cls.__name__ for cls in DATA}


@pytest.mark.parametrize("cls", [cls for cls in DATA if cls not in RESULTS], ids=lambda cls: cls.__name__)
def test_data_show_themselves_in_one_line_however_much_they_hold(cls: type):
    text = repr(large(cls))
    assert len(text) <= MOST and "\n" not in text


@pytest.mark.parametrize("cls", RESULTS, ids=lambda cls: cls.__name__)
def test_a_result_shows_its_headline(cls: type):
    assert cls.__repr__ is Shown.__repr__


def test_a_long_headline_is_cut():
    class Long(Shown):
        def _headline(self) -> str:
            return "a word " * 1000

        def _rows(self) -> list:
            return []

    assert len(repr(Long())) <= MOST and repr(Long()).endswith("...>")


def test_what_fits_is_shown_and_the_rest_by_its_size():
    @short_repr
    @dataclass(frozen=True)
    class Few:
        kind: str
        share: float
        force: np.ndarray
        pads: tuple[str, ...]
        runs: list[int]

    few = Few("unknown", 0.123456, np.zeros((4, 2)), ("A", "B"), list(range(1000)))
    assert repr(few) == "Few(kind='unknown', share=0.1235, force=ndarray(4, 2), pads=('A', 'B'), runs=list of 1000)"
