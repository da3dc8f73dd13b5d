"""The API reference, from the docstrings: every name of the door and of `slipwise.effects`, with an example each.

`scripts/make_docs.py` writes the pages; `tests/contract/test_reference.py` asks that nothing is undocumented, and runs
the examples of `scripts/reference_examples.py`.
"""

import inspect
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import slipwise as sw

#: Page -> the module whose names it lists, and its first sentence.
PAGES: dict[str, tuple[ModuleType, str]] = {
    "slipwise": (
        sw,
        "Every name of `import slipwise as sw`. Numbers are in SI; what an argument takes in other units says so.",
    ),
    "effects": (sw.effects, "Every name of `slipwise.effects`: the catalogue, and what an effect file is made of."),
}
EXAMPLES = Path(__file__).with_name("reference_examples.py")
_SECTIONS = ("Args", "Attributes", "Returns", "Raises")
_ENTRY = re.compile(r"^    \*{0,2}(\w+)(?: \([^)]*\))?: ", re.M)


@cache
def read_examples() -> dict[str, tuple[str, bool]]:
    """Read the examples: name -> code, and whether it takes minutes; in the order in which they follow each other."""
    parts = re.split(r"^# %% (.+)\n", EXAMPLES.read_text(encoding="utf-8"), flags=re.M)[1:]
    found: dict[str, tuple[str, bool]] = {}
    for head, code in zip(parts[::2], parts[1::2], strict=True):
        names, _, long = head.partition(" (")
        for name in names.split(", "):
            found[name] = (code.strip(), bool(long))
    return found


def list_public(module: ModuleType) -> dict[str, Any]:
    """Return the public names of a module and what stands behind them, but for its version."""
    return {name: getattr(module, name) for name in module.__all__ if not name.startswith("__")}


def list_methods(cls: type) -> dict[str, Any]:
    """Return the public methods and properties of a class, those of its own bases in Slipwise included."""
    found: dict[str, Any] = {}
    for base in reversed(cls.__mro__):
        if base.__module__.startswith("slipwise"):
            found |= {name: member for name, member in vars(base).items() if not name.startswith("_")}
    functions = {name: _function(member) for name, member in found.items()}
    return {name: function for name, function in functions.items() if function is not None}


def read_section(documented: Any, name: str) -> dict[str, str]:
    """Return a section of a docstring, "Args" for example: name -> what is said of it.

    Args:
        documented: a function, or a class, whose bases' docstrings count too.
        name: of the section.
    """
    found: dict[str, str] = {}
    for each in reversed(documented.__mro__) if inspect.isclass(documented) else (documented,):
        text = inspect.cleandoc(each.__doc__ or "")
        section = re.search(rf"^{name}:\n((?:    .*\n?|\n)*)", text, re.M)
        parts = _ENTRY.split(section[1])[1:] if section else []
        found |= {key: " ".join(words.split()) for key, words in zip(parts[::2], parts[1::2], strict=True)}
    return found


def find_undocumented(name: str, documented: Any) -> Iterator[str]:
    """Yield what lacks words of a public name: itself, an argument, an attribute, a method, what it returns."""
    if inspect.ismodule(documented):
        if not documented.__doc__:
            yield name
        return
    if inspect.isclass(documented):
        if not documented.__doc__:
            yield name
        if is_dataclass(documented):
            said = read_section(documented, "Attributes")
            yield from (f"{name}.{f.name}" for f in fields(documented) if f.name[0] != "_" and f.name not in said)
        for method, function in list_methods(documented).items():
            yield from find_undocumented(f"{name}.{method}", function)
    elif callable(documented) and hasattr(documented, "__name__"):
        if not documented.__doc__:
            yield name
            return
        said = read_section(documented, "Args")
        given = [a for a in inspect.signature(documented).parameters if a not in ("self", "cls")]
        yield from (f"{name}({argument})" for argument in given if argument not in said)
        if inspect.signature(documented).return_annotation is inspect.Signature.empty:
            yield f"{name} -> ?"


def reference_page(page: str) -> str:
    """Write a page of the reference as Markdown."""
    module, about = PAGES[page]
    title = "slipwise" if module is sw else module.__name__
    parts = [f"# {title}\n\n{about}"]
    for name, documented in list_public(module).items():
        parts.append(_entry(page, name, documented))
    return "\n\n".join(parts) + "\n"


def _entry(page: str, name: str, documented: Any) -> str:
    parts = [f"## {name}"]
    if inspect.ismodule(documented):
        names = ", ".join(f"`{n}`" for n in getattr(documented, "__all__", ()))
        parts += [_plain(documented), f"Names: {names}." if names else ""]
    elif inspect.isclass(documented):
        parts += [_plain(documented), _table(("attribute", "meaning"), read_section(documented, "Attributes"))]
        for method, function in list_methods(documented).items():
            called = inspect.isfunction(inspect.getattr_static(documented, method))
            parts += [f"### {name}.{method}", *_function_parts(f"{name}.{method}", function, called=called)]
    elif callable(documented) and hasattr(documented, "__name__"):
        parts += _function_parts(name, documented)
    else:
        parts.append(_constant(documented))
    if example := read_examples().get(name if page == "slipwise" else f"{page}.{name}"):
        parts.append(f"```python\n{example[0]}\n```")
    return "\n\n".join(filter(None, parts))


def _function_parts(name: str, function: Any, *, called: bool = True) -> list[str]:
    signature = inspect.signature(function)
    own = [p.replace(annotation=inspect.Parameter.empty) for n, p in signature.parameters.items() if n != "self"]
    shown = signature.replace(parameters=own, return_annotation=inspect.Signature.empty)
    returned = _type(signature.return_annotation)
    gives = " ".join(_section_text(function, "Returns").split())
    return [
        f"```text\n{name}{shown if called else ''}\n```",
        _plain(function),
        _table(("argument", "meaning"), read_section(function, "Args")),
        f"{'Returns' if called else 'A'} `{returned}`{': ' if gives else ''}{gives}" if returned != "None" else "",
        _table(("error", "when"), read_section(function, "Raises")),
    ]


def _function(member: Any) -> Any:
    member = getattr(member, "fget", None) or getattr(member, "func", None) or getattr(member, "__func__", member)
    return member if inspect.isfunction(member) else None


def _plain(documented: Any) -> str:
    """Return a docstring without its sections."""
    text = inspect.cleandoc(documented.__doc__ or "")
    return re.split(rf"^(?:{'|'.join(_SECTIONS)}):\n", text, maxsplit=1, flags=re.M)[0].strip()


def _section_text(documented: Any, name: str) -> str:
    section = re.search(rf"^{name}:\n((?:    .*\n?|\n)*)", inspect.cleandoc(documented.__doc__ or ""), re.M)
    return section[1] if section else ""


def _type(annotation: Any) -> str:
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    return re.sub(r"\b(?:slipwise|collections|pathlib|typing|numpy)\.(?:\w+\.)*", "", text).strip("'\"")


def _constant(value: Any) -> str:
    if isinstance(value, dict) and all(isinstance(each, str) for each in value.values()):
        return _table(("name", "meaning"), {str(k): v for k, v in value.items()})
    names = sorted(value) if isinstance(value, frozenset) else value
    return f"```text\n{', '.join(map(str, names)) if isinstance(names, tuple | list | dict) else names}\n```"


def _table(heads: tuple[str, str], rows: dict[str, str]) -> str:
    if not rows:
        return ""
    lines = [f"| {' | '.join(heads)} |", "|---|---|"]
    return "\n".join([*lines, *(f"| `{name}` | {words.replace('|', chr(92) + '|')} |" for name, words in rows.items())])
