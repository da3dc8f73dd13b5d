"""One hook of an effect file that a program writes: head with types, body, and what it takes from elsewhere."""

import ast
import builtins
import math
from collections.abc import Mapping
from dataclasses import dataclass

from slipwise.effects._python_text import WIDTH, sentence
from slipwise.errors import SettingError, unknown_name
from slipwise.short_repr import short_repr

#: What hooks are given beside numbers, and what they give back beside one number.
_GIVEN: dict[str, str] = {
    "memory": "np.ndarray", "acceleration": "np.ndarray", "girder": "np.ndarray", "specimen": "Specimen",
    "record": "Record", "target": "str", "states": "BalanceStates", "records": "Sequence[Record]",
}  # fmt: skip
_RETURNED: dict[str, str] = {
    **dict.fromkeys(("stick", "pad", "drag"), "tuple[float, float]"),
    **dict.fromkeys(("advance", "rest", "begin"), "None"),
    **dict.fromkeys(("gauge", "undo", "sharpen"), "Record"),
    "rig": "Specimen", "table": "np.ndarray", "balance": "dict[str, np.ndarray]", "flat": "dict[str, float]",
    "disturb": "list[list[dict[str, list[np.ndarray]]]]",
}  # fmt: skip
#: Names that a body or a type may use beside its own and Python's -> where they come from.
HOMES: Mapping[str, str] = {
    **dict.fromkeys((name for name in vars(math) if not name.startswith("_")), "math"),
    "Sequence": "collections.abc", "replace": "dataclasses", "np": "numpy", "BalanceStates": "slipwise.effects",
    "Record": "slipwise.record", "Specimen": "slipwise.rig",
}  # fmt: skip


@short_repr
@dataclass(frozen=True)
class WrittenHook:
    """One hook of an effect to be written.

    Attributes:
        name: one of the port's hooks.
        arguments: names of what it asks for.
        words: what it does, one sentence.
        lines: its body, one statement or comment a line, further in by its own blanks; the last returns. It may use its
            arguments, `math` and, over whole arrays, `np` and `replace` without importing them.
    """

    name: str
    arguments: tuple[str, ...]
    words: str
    lines: tuple[str, ...]


def function_text(hook: WrittenHook) -> str:
    """Return the hook as a function: head with types, docstring, statements."""
    arguments = ", ".join(f"{name}: {_GIVEN.get(name, 'float')}" for name in hook.arguments)
    lines = [f'"""{sentence(hook.words, WIDTH - 10)}"""', *hook.lines]
    head = f"def {hook.name}({arguments}) -> {_RETURNED.get(hook.name, 'float')}:"
    return "\n".join([head, *(f"    {line}" for line in lines)])


def names_from_elsewhere(hook: WrittenHook) -> set[str]:
    """Return the names of `HOMES` that body and types use.

    Raises:
        SettingError: its lines are no body of a function.
        UnknownNameError: they use a name that nobody knows.
    """
    whose = f"hook {hook.name!r}"
    if any(not line.isprintable() for line in hook.lines):
        raise SettingError(f"{whose}: every line of a body is one line of text, without tabs and line ends")
    try:
        tree = ast.parse("\n".join([f"def {hook.name}():", *(f"    {line}" for line in hook.lines)]))
    except SyntaxError as error:
        raise SettingError(
            f"{whose}: {error.msg} in {(error.text or '').strip()!r}; its lines must be Python"
        ) from None
    inside = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    own = {*hook.arguments, *(node.id for node in inside if isinstance(node.ctx, ast.Store))}
    used = {node.id for node in inside} - own
    for name in sorted(used - HOMES.keys() - vars(builtins).keys()):
        raise unknown_name(f"argument of {whose}, local or function of math", name, own | HOMES.keys())
    types = [*(_GIVEN.get(name, "float") for name in hook.arguments), _RETURNED.get(hook.name, "float")]
    typed = {node.id for node in ast.walk(ast.parse(", ".join(types))) if isinstance(node, ast.Name)}
    return (used | typed) & HOMES.keys()
