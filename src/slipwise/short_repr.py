"""What data of many numbers show of themselves: one line, in which an array is its shape."""

import reprlib
from dataclasses import fields, is_dataclass
from math import prod
from typing import Any, TypeVar

Data = TypeVar("Data", bound=type)
#: Characters of a whole object, and of one of its values.
LONGEST, _LONGEST_VALUE = 400, 60


def short_repr(cls: Data) -> Data:
    """Let a data class show itself in one line of at most `LONGEST` characters, as a decorator above `@dataclass`.

    A class that writes its own `__repr__` is not for it.
    """
    setattr(cls, "__repr__", _shown)  # noqa: B010 - a type checker takes it for that of the class of classes
    return cls


def shortened(text: str, most: int = LONGEST) -> str:
    """Cut a text that is longer than a number of characters, with three dots at its end."""
    return text if len(text) <= most else f"{text[: most - 3]}..."


def _shown(self: Any) -> str:
    parts: list[str] = []
    room = LONGEST - len(type(self).__name__) - len("(, ...)")
    for field in fields(self):
        part = f"{field.name}={_value(getattr(self, field.name))}"
        if len(part) > room:
            parts.append("...")
            break
        parts.append(part)
        room -= len(part) + len(", ")
    return f"{type(self).__name__}({', '.join(parts)})"


def _value(value: Any) -> str:
    """Write a value briefly: numbers with four figures, what is long by its kind and size."""
    if isinstance(value, float):
        return f"{value:.4g}"
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and prod(shape) > 1:
        return f"{type(value).__name__}{shape}"
    if is_dataclass(value) and not isinstance(value, type):
        return f"{type(value).__name__}(...)"
    if isinstance(value, tuple | list | set | frozenset | dict) and value:
        inside = value.values() if isinstance(value, dict) else value
        plain = all(isinstance(each, str | int | float | bool | None) for each in inside)
        text = repr(value) if plain and len(value) <= 8 else ""
        return text if 0 < len(text) <= _LONGEST_VALUE else f"{type(value).__name__} of {len(value)}"
    return shortened(reprlib.repr(value), _LONGEST_VALUE)
