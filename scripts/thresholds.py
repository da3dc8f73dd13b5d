"""Every number by which a diagnosis decides: where it stands in the code, and its row in the table.

A threshold is a statement at the top of a module of the packages that decide, which gives a name in capitals a number,
or a tuple of numbers; or a field of a dataclass there all of whose fields have such defaults: `Prior`, `Effort`,
`Acceptance`, `Materiality`. What holds words, functions or other objects beside numbers is data of another kind: units
in which sizes are written, forms of laws with their grids, ranges of parameters. Numbers that decide nothing, such as
the seed of a replay or the number of a format, stand in the table as definitions.

`thresholds.json` has a row for each; docs/thresholds.md says what its columns mean.
"""

import ast
import importlib
import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src"
TABLE = ROOT / "tests" / "thresholds.json"
#: Packages that decide, and the file that says what matters.
DECIDING = (
    "campaign/materiality.py",
    "preparation",
    "noise",
    "relations",
    "estimation",
    "instruments",
    "selection",
    "evidence",
    "diagnosis",
    "comparison",
    "discovery",
)
#: How a number behaves when the campaign is another one; "definition" is what no campaign changes and nobody moves.
SCALES = {
    "ratio": "of two quantities of the same campaign: the same for every rig",
    "share": "part of a whole, between 0 and 1: the same for every rig",
    "noise": "in noise floors, standard deviations or nats: goes with the noise",
    "count": "of samples, runs, steps: goes with nothing",
    "rig": "goes with the rig's own length, speed or load (`campaign.scales`)",
    "absolute": "in SI units: the same for every rig, whatever its size",
    "definition": "decides nothing: the number of a format, a seed, memory, how much is shown",
}
#: What a number stands on.
BASES = {
    "assumed": "judgement; nobody has measured it",
    "seeds": "seen on campaigns of the bench or in trials, as the comment beside it says",
    "physics": "follows from a law, a derivation or how a number is stored",
    "standard": "a published method or what laboratories and data sheets give",
}
Number = float | tuple[Any, ...]


@dataclass(frozen=True)
class Statement:
    """A threshold in the code.

    Attributes:
        name: package, module and name, such as `selection.select._RIVALS`.
        file: where it stands, below `SOURCE`.
        first: line and column [bytes] at which its value begins.
        last: line and column at which it ends.
        value: what it is when the module is loaded.
        meaning: what the comment beside it says.
    """

    name: str
    file: str
    first: tuple[int, int]
    last: tuple[int, int]
    value: Number
    meaning: str


def find_statements() -> list[Statement]:
    """Return all thresholds of the code, by package and file."""
    found: list[Statement] = []
    for part in DECIDING:
        path = SOURCE / "slipwise" / part
        for file in [path] if path.suffix else sorted(path.rglob("*.py")):
            found += _of_file(file)
    return found


def _of_file(file: Path) -> list[Statement]:
    text = file.read_text(encoding="utf-8")
    module = ".".join(file.relative_to(SOURCE).with_suffix("").parts)
    loaded = importlib.import_module(module)
    found: list[Statement] = []

    def add(name: str, value: ast.expr, known: Any, meaning: str) -> None:
        end = (value.end_lineno or value.lineno, value.end_col_offset or 0)
        place = str(file.relative_to(SOURCE))
        name = f"{module.removeprefix('slipwise.')}.{name}"
        found.append(Statement(name, place, (value.lineno, value.col_offset), end, known, meaning))

    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef):
            fields = [field for field in node.body if isinstance(field, ast.AnnAssign)]
            if fields and all(field.value and _is_number(_literal(field.value)) for field in fields):
                for field in fields:
                    name = ast.unparse(field.target)
                    assert field.value is not None
                    add(f"{node.name}.{name}", field.value, _literal(field.value), _attribute(node, name))
            continue
        for name, value in _assigned(node):
            numbers = any(isinstance(x, ast.Constant) and _is_number(x.value) for x in ast.walk(value))
            if numbers and name.upper() == name and _is_number(known := getattr(loaded, name)):
                add(name, value, known, _comment(text, node.lineno))
    return found


def _assigned(node: ast.stmt) -> list[tuple[str, ast.expr]]:
    """Return names and values of a statement, those of a tuple of names one by one."""
    if isinstance(node, ast.AnnAssign) and node.value and isinstance(node.target, ast.Name):
        return [(node.target.id, node.value)]
    if not isinstance(node, ast.Assign):
        return []
    target = node.targets[0]
    if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
        return [(ast.unparse(name), value) for name, value in zip(target.elts, node.value.elts, strict=True)]
    return [(target.id, node.value)] if isinstance(target, ast.Name) else []


def _literal(value: ast.expr) -> Any:
    try:
        return ast.literal_eval(value)
    except ValueError:
        return None


def _is_number(value: object) -> bool:
    if isinstance(value, tuple):
        return bool(value) and all(_is_number(one) for one in value)
    return isinstance(value, int | float) and not isinstance(value, bool)


def _comment(text: str, line: int) -> str:
    """Return the `#:` lines above a statement."""
    lines = text.splitlines()
    at = line - 2
    words: list[str] = []
    while at >= 0 and lines[at].startswith("#:"):
        words.insert(0, lines[at].lstrip("#: "))
        at -= 1
    return " ".join(words)


def _attribute(node: ast.ClassDef, name: str) -> str:
    """Return what a class says of a field."""
    said = re.search(rf"^\s*{name}: (.*)$", ast.get_docstring(node) or "", re.MULTILINE)
    return said[1] if said else ""


def moved(value: Number, factor: float, scales: str) -> Number:
    """Return a number made so many times as large, to four figures.

    Whole numbers change by one at least; shares above one half change by their distance from 1.
    """
    if isinstance(value, tuple):
        return tuple(moved(one, factor, scales) for one in value)
    if isinstance(value, int):
        near = round(value * factor)
        return near if near != value else value + (1 if factor > 1.0 else -1)
    if scales == "share" and value > 0.5:
        return float(f"{1.0 - (1.0 - value) / factor:.4g}")
    return float(f"{value * factor:.4g}")


def with_value(text: str, statement: Statement, value: Number) -> str:
    """Return a module's text with another value in a statement."""
    lines = text.encode().splitlines(keepends=True)
    (first, begin), (last, end) = statement.first, statement.last
    line = lines[first - 1][:begin] + f"({value!r})".replace("inf", "float('inf')").encode() + lines[last - 1][end:]
    return b"".join([*lines[: first - 1], line, *lines[last:]]).decode()


def read_table() -> dict[str, dict[str, Any]]:
    """Return name -> row of the table."""
    return json.loads(TABLE.read_text(encoding="utf-8"))


def write_table(rows: dict[str, dict[str, Any]]) -> None:
    """Write the table, a line for each threshold, in the order of the code."""
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(row, ensure_ascii=False)}" for name, row in rows.items())
    TABLE.write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


def in_line_with_code(rows: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Return rows for the thresholds of the code: what is new lacks its words, what has a new value its counts."""
    new = {"unit": "", "scales": "", "basis": ""}
    counts = {"turned": None, "read": None, "of": None, "bench": ""}
    out: dict[str, dict[str, Any]] = {}
    for one in find_statements():
        row, value = rows.get(one.name, new), as_written(one.value)
        out[one.name] = {"value": value, **new, **counts, **row}
        if row.get("value") != value:
            out[one.name] |= {"value": value, **counts}
    return out


def as_written(value: Number) -> Any:
    """Return a value as the table holds it: lists for tuples, a word for infinity."""
    if isinstance(value, tuple):
        return [as_written(one) for one in value]
    return "inf" if value == float("inf") else value
