"""The catalogue as people read it: rows, a table for the terminal, one in Markdown, and a picture of each effect."""

from collections.abc import Iterable
from typing import Any

from matplotlib.figure import Figure
from rich.console import Console

from slipwise.effects import COMPONENTS, Effect, catalogue
from slipwise.params import Parameter
from slipwise.studies.demonstration import demonstrate
from slipwise.units import parse_unit
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import EXPECTED, MODEL_COLOURS
from slipwise.view.words.pipe_safe_console import PatientConsole
from slipwise.view.words.terminal import print_table

#: Units in which the axes of an effect's picture are shown.
_SHOWN = {"m": "mm", "N": "kN", "s": "s", "m/s^2": "m/s^2", "rad/s^2": "rad/s^2"}


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


def effect_picture(effect: Effect, *, target: str = "pad_A_Fx") -> Figure:
    """Draw what one effect does at typical size, and below what it adds; use within `styled()`.

    Args:
        effect: of the catalogue or a user's own; a law of the base is shown against the model without it.
        target: channel that an instrument effect is shown on.
    """
    shown = demonstrate(effect, target)
    units = [_SHOWN[u] for u in (shown.x_unit, shown.y_unit)]
    x, y = (parse_unit(u, si, "axis") for u, si in zip(units, (shown.x_unit, shown.y_unit), strict=True))
    figure = new_figure(5.6, 5.2, effect.name)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
    above.plot(shown.x / x, shown.base / y, color=EXPECTED, linewidth=2.4, label="without")
    above.plot(shown.x / x, shown.changed / y, color=MODEL_COLOURS[-1], linewidth=1.1, label=f"with {effect.name}")
    above.set_title(effect.equation, fontsize=9.0, fontweight="normal")
    above.set_ylabel(f"{shown.y_name} [{units[1]}]")
    above.legend(loc="best")
    below.plot(shown.x / x, (shown.changed - shown.base) / y, color=MODEL_COLOURS[-1], linewidth=1.1)
    below.set_ylabel(f"what it adds [{units[1]}]")
    below.set_xlabel(f"{shown.x_name} [{units[0]}]")
    return figure
