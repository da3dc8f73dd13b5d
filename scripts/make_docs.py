"""Make the pages of the documentation that come from elsewhere: effects, validation, thresholds, commands.

    python scripts/make_docs.py            writes those that are committed: effects, validation, thresholds, navigation
    python scripts/make_docs.py --check    writes nothing; exit 1 if one of them is not current

`scripts/make_site.py` writes those that only the site has.
"""

import json
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import typer

from slipwise.cli import app
from slipwise.effects import Effect, base_effects, catalogue
from slipwise.record import write_text
from slipwise.view.words.effects import effects_table

DOCS = Path(__file__).parents[1] / "docs"
MADE = "<!-- made by scripts/make_docs.py -->\n\n"
#: Symbols that begin a sentence stay as they are.
_SYMBOLS = ("mu", "dmu")

_ABOUT_THRESHOLDS = """\
A diagnosis decides by numbers: from how many standard errors a size is known, how many samples are enough, how much a
law must explain. Each has its name and a comment in the module that uses it; here they all are, with what they stand
on. A number is listed when a name in capitals stands for it, or for a tuple of numbers, at the top of a module that
decides, and when it is the default of a field of `Prior`, `Effort`, `Acceptance` or `Materiality`. Tables that hold
words or functions beside numbers are not listed: units for sizes, forms of laws and their grids, ranges of a rig's
parameters. `tests/thresholds.json` is the same table for programs, and a test holds it against the code.

`scripts/19_thresholds.py` makes each 1.3 and 0.7 times as large, diagnoses a bench again and counts the verdicts whose
kind or names turn. A share near 1 is moved by its distance from 1, a whole number by one at least. In the column
*turned*, 1 of 4 says that one of four verdicts turned, of two campaigns with both moves; *not read* that nothing used
the number at any of them; - that it was not measured. A number that turns nothing on a bench of all families decides
nothing, and can go; on a few campaigns that says little."""


def effects_index() -> str:
    """Write the page that lists the catalogue."""
    return (
        f"{MADE}# Effects\n\nWhat a model can lack. Each effect is one file in `src/slipwise/effects/`; at its "
        "neutral value it changes nothing. `slipwise effects NAME` prints the same in a terminal, and an effect of "
        "your own competes by `--effect ./mine.py`. In the equations x is the slip, v its rate, V the speed, N the "
        "load of a pad, P its pressure, F its friction, mu = F/N, F_b the force of the buffers, y what a gauge reads; "
        "side_x and side_y are ±1 by the place of a pad, b_x and b_y half the distances of the pads, and `*=`, `+=` "
        f"mean that the effect scales or adds to what was there before it.\n\n{effects_table()}"
    )


def effect_page(row: dict[str, Any]) -> str:
    """Write the page of one effect.

    Args:
        row: of `effect_rows`.
    """
    name = row["name"]
    parameters = [
        [f"`{p['name']}`", p["meaning"], p["unit"], *(_number(p[k]) for k in ("typical", "low", "high", "neutral")),
         p["source"]]
        for p in row["parameters"]
    ]  # fmt: skip
    known = catalogue()
    rivals = [
        [f"[`{rival}`]({rival}.md)" if rival in known else f"`{rival}`", test]
        for rival, test in row["confused_with"].items()
    ]
    target = f", on one {row['target']}" if row["target"] else ""
    parts = [
        f"# {name}\n\n{row['summary']}\n\n```text\n{row['equation']}\n```",
        f"It acts on [port](../effect_contract.md#ports) `{row['port']}`{target}; in a verdict it belongs to "
        f"*{row['component']}*.",
        f"![What {name} does at typical size, and below what it adds](pictures/{name}.png)",
        "*At typical size on Bridge 1 with the paper's law: slip of 10 mm at 1.25 Hz along x and 1 mm across, 1.5 m/s² "
        f"at 5 Hz upwards.{_added(catalogue()[name])}*",
    ]
    if parameters:
        heads = ["parameter", "meaning", "unit", "typical", "lowest", "highest", "neutral", "source"]
        parts += ["## Parameters", _table(heads, parameters)]
    parts += [
        f"## How it shows\n\n{_sentence(row['signature'])}",
        "## What it is confused with",
        _table(["effect", "what tells them apart"], rivals) if rivals else "Nothing known.",
        f"## Range of validity\n\n{_sentence(row['valid'])}\n\n## Source\n\n{_sentence(row['source'])}",
    ]
    return "\n\n".join(parts) + "\n"


def validation_page(stored: dict[str, Any]) -> str:
    """Write the page of what was measured.

    Args:
        stored: content of validation.json.
    """
    parts = [f"{MADE}# Validation", stored["note"]]
    for entry in stored["measurements"]:
        recorded = f"Recorded {entry['date']} with commit {entry['commit']}."
        parts += [f"## {entry['title']}", f"*{_sentence(entry['how'])} {recorded}*"]
        parts.append(_table(entry["columns"], entry["rows"]))
        if entry["remarks"]:
            parts.append("\n".join(f"- {words}" for words in entry["remarks"]))
    parts += ["## Known limits", "\n".join(f"- {words}" for words in stored["limits"])]
    return "\n\n".join(parts) + "\n"


def command_line_page() -> str:
    """Write the page of all commands with their options, from the commands themselves."""
    parts = [
        f"{MADE}# Command line",
        "Every command has `--help`.",
        "## Exit codes",
        _table(
            ["exit code", "meaning"],
            [
                [
                    "0",
                    "done; also where nobody reads the output any more (`| head`): files are written all the same",
                ],
                [
                    "2",
                    "something that was given cannot be used, a file cannot be written, memory or disk is full: one "
                    "line says what and what to do",
                ],
                [
                    "1",
                    "of several campaigns, one met a fault of Slipwise itself; all others were worked at, as they are "
                    "where one could not be used (2)",
                ],
                ["130", "interrupted by Ctrl-C (SIGINT)"],
                ["143", "ended by `kill` (SIGTERM)"],
                ["129", "ended because its terminal was closed (SIGHUP)"],
            ],
        ),
        "However a command ends, files are there whole or not at all, and those that were finished are kept. "
        "Work on many jobs (`diagnose` of several campaigns, `bench`, `ensemble`, `paper`) goes on from those that are "
        "finished when it is called again with the same options.",
    ]
    commands: dict[str, Any] = getattr(typer.main.get_command(app), "commands", {})
    for name, command in commands.items():
        options = [[_written(p), getattr(p, "help", "") or "", _default(p)] for p in command.params]
        parts += [f"## {name}", command.help or ""]
        if options:
            parts.append(_table(["argument", "meaning", "default"], options))
    return "\n\n".join(parts) + "\n"


def thresholds_page() -> str:
    """Write the page of the numbers by which a diagnosis decides, from their table and the comments in the code."""
    from thresholds import BASES, SCALES, find_statements, read_table  # beside this script, where mkdocs does not look

    rows, meanings = read_table(), {one.name: one.meaning for one in find_statements()}
    packages: dict[str, dict[str, dict[str, Any]]] = {}
    for name, row in rows.items():
        packages.setdefault(name.split(".")[0], {})[name.partition(".")[2]] = row
    counted = [[f"`{package}`", *_counts(of.values(), list(BASES))] for package, of in packages.items()]
    counted.append(["all", *_counts(rows.values(), list(BASES))])
    benches = sorted({row["bench"] for row in rows.values() if row["bench"]})
    parts = [
        f"{MADE}# Thresholds",
        _ABOUT_THRESHOLDS,
        f"Bench of the counts: {'; '.join(benches) or 'none yet'}.",
        "## By package",
        _table(["package", "numbers", *BASES, "definitions", "moved", "turn a verdict"], counted),
        f"A definition decides nothing: {SCALES['definition'].partition(': ')[2]}. It counts under no basis.",
        "## How a number scales",
        _table(["word", "meaning"], SCALES.items()),
        "## What it stands on",
        _table(["word", "meaning"], BASES.items()),
    ]
    heads = ["number", "value", "unit", "scales", "basis", "turned", "meaning"]
    for package, of in packages.items():
        lines = [
            [
                f"`{name}`",
                _value(row["value"]),
                *(row[k] for k in heads[2:5]),
                _turned(row),
                meanings[f"{package}.{name}"],
            ]
            for name, row in of.items()
        ]
        parts += [f"## {package}", _table(heads, lines)]
    return "\n\n".join(parts) + "\n"


def _counts(rows: Iterable[dict[str, Any]], bases: list[str]) -> list[str]:
    """Count rows of the table of thresholds: all, by basis, definitions, moved, and those that turn a verdict."""
    rows = list(rows)
    decide = [row for row in rows if row["scales"] != "definition"]
    measured = [row for row in decide if row["read"]]
    numbers = [len(rows), *(sum(row["basis"] == basis for row in decide) for basis in bases)]
    return [str(n) for n in (*numbers, len(rows) - len(decide), len(measured), sum(r["turned"] > 0 for r in measured))]


def _turned(row: dict[str, Any]) -> str:
    if row["turned"] is None:
        return "" if row["scales"] == "definition" else "-"
    return f"{row['turned']} of {row['of']}" if row["read"] else "not read"


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"({', '.join(_value(one) for one in value)})"
    return value if isinstance(value, str) else f"{value:.6g}" if isinstance(value, float) else str(value)


def committed_pages() -> dict[Path, str]:
    """Give the made pages that are kept in the repository, as they should be."""
    stored = json.loads((DOCS / "validation.json").read_text(encoding="utf-8"))
    return {
        DOCS / "command_line.md": command_line_page(),
        DOCS / "effects" / "index.md": effects_index(),
        DOCS / "validation.md": validation_page(stored),
        DOCS / "thresholds.md": thresholds_page(),
        DOCS.parent / "mkdocs.yml": _navigation(),
    }


def _navigation() -> str:
    """Return the site's configuration with a page for every effect."""
    before = (DOCS.parent / "mkdocs.yml").read_text(encoding="utf-8").partition("  - Effects:\n")[0]
    pages = ["index", *catalogue()]
    return before + "  - Effects:\n" + "".join(f"      - effects/{name}.md\n" for name in pages)


def _added(effect: Effect) -> str:
    """Say where the lower curve is nothing, and why."""
    springs = {e.name for e in base_effects("springs")}
    return " The base model's pads are these springs, so nothing is added." if effect.name in springs else ""


def _write(path: Path, text: str) -> None:
    """Leave a file alone that is current: `mkdocs serve` builds anew for every file that is written."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        write_text(path, text)


def _table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    heads = list(heads)
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def _written(argument: Any) -> str:
    """Give an argument as it is typed: all spellings of an option, the name of what has none."""
    if not argument.opts[0].startswith("-"):
        return f"`{argument.name.upper()}`"
    return ", ".join(f"`{option}`" for option in (*argument.opts, *argument.secondary_opts))


def _default(argument: Any) -> str:
    """Give what holds if an option is not given; nothing for a switch that is off, and for what has no default."""
    value = argument.default
    if value is True:
        return f"`{argument.opts[0]}`"
    return f"`{value}`" if isinstance(value, str | int | float | Path) and value not in (False, "") else ""


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:g}"


def _sentence(words: str) -> str:
    first = re.match(r"[a-z]{2,}(?=[- ,;.]|$)", words)
    if first and first[0] not in _SYMBOLS:
        words = words[0].upper() + words[1:]
    return words if words.endswith(".") else f"{words}."


def main() -> int:
    """Write the committed pages, or check them."""
    stale = [p for p, text in committed_pages().items() if not p.is_file() or p.read_text(encoding="utf-8") != text]
    if "--check" in sys.argv:
        return int(bool(stale))
    for path, text in committed_pages().items():
        _write(path, text)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
