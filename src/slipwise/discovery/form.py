"""The contract of a form: how a missing force may go with a state, one small file each in `forms`.

A form file has a docstring, whose first line says it in words, and `FORM`. Its value and the slopes over its constants
are written as text, because the same text is evaluated over whole records here and stands in the effect file that
comes out; it may use arithmetic and `FUNCTIONS`. The state is called `s`.
"""

import importlib.util
import inspect
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.short_repr import short_repr

#: What the text of a form may call, as it acts on arrays.
FUNCTIONS: dict[str, Any] = {
    "exp": np.exp, "tanh": np.tanh, "sin": np.sin, "cos": np.cos, "log": np.log, "sqrt": np.sqrt, "abs": np.abs,
    "copysign": np.copysign, "max": np.maximum, "min": np.minimum, "pi": np.pi,
}  # fmt: skip
#: Kinds of constants: a place among the values of the state, a width or distance of them, a period, a pure number; a
#: reference is the size of the state at which the strength is told, which is chosen and not fitted.
KINDS: tuple[str, ...] = ("place", "width", "period", "number", "reference")


@short_repr
@dataclass(frozen=True)
class Constant:
    """A constant of a form.

    Attributes:
        name: as in the text.
        kind: of `KINDS`; says its unit, where it is looked for, and within which limits.
        slope: derivative of the form with respect to it, as text; of a reference none is needed.
        starts: of a pure number: where it is looked for; of others: shares of the range of the state.
        low: smallest value of a pure number.
        high: largest.
    """

    name: str
    kind: str
    slope: str = "0.0"
    starts: tuple[float, ...] = ()
    low: float = 0.0
    high: float = 1.0


@short_repr
@dataclass(frozen=True)
class Form:
    """How a force goes with a state.

    Attributes:
        value: text of f(s).
        constants: besides the strength, which multiplies it.
        signed: whether the state must take both signs; a form of a size is nothing for them.
        sized: whether the state must not be negative.
        contains: names of simpler forms that it is with some value of a constant, but for what is the same at every
            state: it is no rival of theirs.
        name: the file's name; set when the file is read.
        words: first line of its docstring; set when the file is read.
    """

    value: str
    constants: tuple[Constant, ...] = ()
    signed: bool = False
    sized: bool = False
    contains: tuple[str, ...] = ()
    name: str = ""
    words: str = ""

    @cached_property
    def _code(self) -> CodeType:
        return compile(self.value, f"<form {self.name}>", "eval")

    @cached_property
    def _slopes(self) -> tuple[CodeType, ...]:
        return tuple(compile(c.slope, f"<slope of {self.name} over {c.name}>", "eval") for c in self.constants)

    def at(self, s: Array, constants: Mapping[str, float]) -> Array:
        """Evaluate it at states of any shape; constants by name."""
        with np.errstate(all="ignore"):
            return np.asarray(eval(self._code, {"__builtins__": {}}, {**FUNCTIONS, **constants, "s": s})) + 0.0 * s

    def slopes(self, s: Array, constants: Mapping[str, float]) -> dict[str, Array]:
        """Evaluate its slopes over each constant at states of any shape."""
        names = {**FUNCTIONS, **constants, "s": s}
        with np.errstate(all="ignore"):
            found = [np.asarray(eval(code, {"__builtins__": {}}, names)) + 0.0 * s for code in self._slopes]
        return {c.name: slope for c, slope in zip(self.constants, found, strict=True)}


@cache
def forms() -> dict[str, Form]:
    """Return the forms of the folder `forms` by name, fewest constants first."""
    read = [read_form(path) for path in sorted((Path(__file__).parent / "forms").glob("[a-z]*.py"))]
    return {form.name: form for form in sorted(read, key=lambda f: (len(f.constants), f.name))}


def read_form(path: Path) -> Form:
    """Read and check one form file. It is run: a stranger's file is looked at first.

    Raises:
        SettingError: it breaks the contract; the message says where and how to mend it.
    """
    spec = importlib.util.spec_from_file_location(f"slipwise_form_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise SettingError(f"{path} is no Python file")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise SettingError(f"{path.name} cannot be read: {type(error).__name__}: {error}") from error
    found, words = getattr(module, "FORM", None), inspect.cleandoc(module.__doc__ or "")
    if not isinstance(found, Form) or not words:
        raise SettingError(f"{path.name} needs a docstring that says the form in words, and FORM = Form(...)")
    form = replace(found, name=path.stem, words=words.splitlines()[0])
    for c in form.constants:
        if c.kind not in KINDS:
            raise SettingError(f"{path.name}: {c.name} is of kind {c.kind!r}; possible: {', '.join(KINDS)}")
    try:
        middle = {c.name: 0.5 * (c.low + c.high) for c in form.constants}
        form.at(np.array([0.5, 1.0]), middle)
        form.slopes(np.array([0.5, 1.0]), middle)
    except Exception as error:
        usable = ", ".join(FUNCTIONS)
        raise SettingError(
            f"{path.name}: its text cannot be evaluated ({error}); it may use s, its constants, arithmetic and {usable}"
        ) from error
    return form
