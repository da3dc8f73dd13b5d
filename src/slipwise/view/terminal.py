"""Tables in the terminal."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from slipwise.channels import PADS

#: Rows of a replay's summary: key, what it is called, unit.
_SUMMARY: tuple[tuple[str, str, str], ...] = (
    ("slip_x_half_range_mm", "slip, half range", "mm"),
    ("slip_x_max_mm", "slip, largest", "mm"),
    ("energy_kN_cm", "energy dissipated by the pads", "kN cm"),
    ("uplift_s", "time with a pad lifted off", "s"),
    ("energy_balance_error", "energy balance, error of input", "1"),
    ("dt_s", "time step", "s"),
    ("steps", "steps", ""),
    ("wall_s", "computing time", "s"),
    ("engine", "engine", ""),
)
_PAD: tuple[tuple[str, str], ...] = (
    ("N_min_kN", "N min [kN]"),
    ("N_max_kN", "N max [kN]"),
    ("F_max_kN", "F max [kN]"),
    ("energy_kN_cm", "energy [kN cm]"),
)


def print_table(title: str, rows: Sequence[Mapping[str, Any]], console: Console | None = None) -> None:
    """Print rows as a table; a column is every key that a row has, numbers stand to the right.

    Args:
        title: above the table.
        rows: one mapping a row; a key that a row lacks leaves its cell empty.
        console: where to print; the standard output if not given.
    """
    columns = list(dict.fromkeys(key for row in rows for key in row))
    table = Table(title=Text(title, style="bold"), title_justify="left", box=box.SIMPLE_HEAD, header_style="bold")
    for key in columns:
        numeric = all(isinstance(row.get(key), int | float) for row in rows if row.get(key) is not None)
        table.add_column(Text(str(key)), justify="right" if numeric else "left", overflow="fold")
    for row in rows:
        # Text, so that brackets in names and units are printed and not taken for markup.
        table.add_row(*(Text(cell(row.get(key))) for key in columns))
    (console or Console()).print(table)


def print_summary(summary: Mapping[str, Any], console: Console | None = None) -> None:
    """Print the summary of a replay (summary.json): what happened, and a row for each pad."""
    rows = [{"": words, "value": cell(summary[key]), "unit": unit} for key, words, unit in _SUMMARY if key in summary]
    print_table("Replay", rows, console)
    pads = summary.get("pads", {})
    rows = [
        {"pad": pad, **{words: pads[pad][key] for key, words in _PAD if key in pads[pad]}}
        for pad in PADS
        if pad in pads
    ]
    if rows:
        print_table("Pads", rows, console)


def cell(value: Any) -> str:
    """Write a value as it stands in a table: four significant figures, yes and no, nothing for None."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple):
        return ", ".join(cell(item) for item in value)
    return str(value)
