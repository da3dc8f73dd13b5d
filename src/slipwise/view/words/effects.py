"""The catalogue as people read it: rows, a table for the terminal, and one in Markdown."""

from collections.abc import Iterable
from typing import Any

from rich.console import Console

from slipwise.effects import COMPONENTS, Effect, catalogue
from slipwise.params import Parameter
from slipwise.units import parse_unit
from slipwise.view.pipe_safe_console import PatientConsole
from slipwise.view.words.terminal import print_table


def effect_rows(effects: Iterable[Effect] | None = None) -> list[dict[str, Any]]:
    """Return all that is known of effects as plain data, by component and then by name.

    Args:
        effects: the catalogue if not given.
    """
    chosen = list(catalogue().values()) if effects is None else list(effects)
    chosen.sort(key=lambda e: (COMPONENTS.index(e.component), e.name))
    return [
        {
            "name": e.name,
            "component": e.component,
            "port": e.port,
            "summary": e.summary,
            "equation": e.equation,
            "parameters": [_parameter_row(p) for p in e.parameters],
            "signature": e.signature,
            "confused_with": dict(e.confused_with),
            "moves": list(e.moves),
            "target": e.target,
            "valid": _paragraph(e.text, "Valid:"),
            "source": _paragraph(e.text, "Source:"),
        }
        for e in chosen
    ]


def _parameter_row(parameter: Parameter) -> dict[str, Any]:
    unit = parameter.shown_in or parameter.unit
    factor = parse_unit(unit, parameter.unit, parameter.name)
    numbers = {"typical": parameter.typical, "low": parameter.low, "high": parameter.high, "neutral": parameter.neutral}
    return {
        "name": parameter.name,
        **{key: None if value is None else float(f"{value / factor:.6g}") for key, value in numbers.items()},
        "unit": unit,
        "meaning": parameter.meaning,
        "source": parameter.source,
    }


def _paragraph(text: str, head: str) -> str:
    """Return what stands behind "Valid:" or "Source:" in a docstring, on one line."""
    after = text[text.index(head) + len(head) :].split("\n\n")[0]
    lines = []
    for line in after.splitlines():
        if line.startswith(("Valid:", "Source:")):
            break
        lines.append(line.strip())
    return " ".join(lines).strip()


def print_effects(effects: Iterable[Effect] | None = None, console: Console | None = None) -> None:
    """Print the catalogue as a table for each component."""
    rows = effect_rows(effects)
    for component in dict.fromkeys(row["component"] for row in rows):
        print_table(
            component.capitalize(),
            [
                {"effect": row["name"], "equation": row["equation"], "what it is": row["summary"]}
                for row in rows
                if row["component"] == component
            ],
            console,
        )


def print_effect(effect: Effect, console: Console | None = None) -> None:
    """Print one effect: its docstring, its parameters, what it shows and what it is confused with."""
    out = console or PatientConsole()
    (row,) = effect_rows([effect])
    out.print(effect.text, markup=False, highlight=False, soft_wrap=True)
    print_table("\nParameters", row["parameters"], out)
    out.print(
        f"Acts on port {effect.port!r}. Shows: {effect.signature}.\n", markup=False, highlight=False, soft_wrap=True
    )
    rivals = [{"confused with": name, "what tells them apart": test} for name, test in row["confused_with"].items()]
    print_table("Rivals", rivals, out)
    out.print(f"File: {effect.path}", markup=False, highlight=False, soft_wrap=True)


def effects_table() -> str:
    """Write the catalogue as Markdown: a table of name, equation, meaning and rivals for each component."""
    lines = []
    rows = effect_rows()
    for component in dict.fromkeys(row["component"] for row in rows):
        lines += [f"**{component.capitalize()}**", "", "| effect | equation | what it is | confused with |"]
        lines.append("|---|---|---|---|")
        for row in rows:
            if row["component"] == component:
                equation = row["equation"].replace("|", "\\|")
                rivals = ", ".join(f"`{name}`" for name in row["confused_with"])
                lines.append(f"| `{row['name']}` | `{equation}` | {row['summary']} | {rivals} |")
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"
