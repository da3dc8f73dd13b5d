"""Tables in the terminal."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from slipwise.errors import visible
from slipwise.view.pipe_safe_console import PatientConsole
from slipwise.view.words.numbers import NOTHING

#: Rows of a replay's summary: key, what it is called, unit.
_SUMMARY: tuple[tuple[str, str, str], ...] = (
    ("slip_x_half_range_mm", "slip along x, half range", "mm"),
    ("slip_x_max_mm", "slip along x, largest", "mm"),
    ("slip_y_half_range_mm", "slip along y, half range", "mm"),
    ("slip_y_max_mm", "slip along y, largest", "mm"),
    ("slip_max_mm", "slip, largest of the vector", "mm"),
    ("energy_kN_cm", "energy dissipated by the pads", "kN cm"),
    ("energy_x_kN_cm", "  of it along x", "kN cm"),
    ("energy_y_kN_cm", "  of it along y", "kN cm"),
    ("uplift_s", "time with a pad lifted off", "s"),
    ("energy_balance_error", "energy balance, error of input", "1"),
    ("dt_s", "time step", "s"),
    ("steps", "steps", ""),
    ("wall_s", "time to simulate", "s"),
    ("compile_s", "time to compile or load the law", "s"),
    ("write_s", "time to write the record", "s"),
    ("draw_s", "time to draw pictures and recording", "s"),
    ("engine", "engine", ""),
)
#: Letters of a row's name that are kept in one line at most.
_NAME = 24
_AFTER_LANDING = (
    "Pads lifted: what follows several landings hangs on the last digits of the motion, and the largest loads hang on "
    "the pads' damping, which is assumed. Compare motions that differ by less than the table's accuracy."
)
#: Rows that say nothing where the girder moves along x alone.
_ACROSS = (
    "slip_y_half_range_mm", "slip_y_max_mm", "slip_max_mm", "energy_x_kN_cm", "energy_y_kN_cm",
)  # fmt: skip
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
    table = Table(box=box.SIMPLE_HEAD, header_style="bold")
    for key in columns:
        numeric = all(isinstance(row.get(key), int | float) for row in rows if row.get(key) is not None)
        # A name that the user types again must not be broken: the column that says whose row it is gets its room first.
        room = min(max(len(cell(row.get(key))) for row in rows), _NAME) if rows and key == columns[0] else None
        heading, side = Text(visible(str(key))), "right" if numeric else "left"
        table.add_column(heading, justify=side, overflow="fold", min_width=room)
    for row in rows:
        # Text, so that brackets in names and units are printed and not taken for markup.
        table.add_row(*(Text(cell(row.get(key))) for key in columns))
    console = console or PatientConsole()
    console.print(Text(visible(title), style="bold"))  # a table's own title is broken at the table's width
    console.print(table)


def print_summary(summary: Mapping[str, Any], console: Console | None = None) -> None:
    """Print the summary of a replay (summary.json): what happened, and a row for each pad."""
    left_out = () if moves_across(summary) else _ACROSS
    rows = [
        {"": words, "value": cell(summary[key]), "unit": unit}
        for key, words, unit in _SUMMARY
        if key in summary and key not in left_out
    ]
    print_table("Replay", rows, console)
    pads = summary.get("pads", {})
    rows = [{"pad": pad, **{words: pads[pad][key] for key, words in _PAD if key in pads[pad]}} for pad in pads]
    if rows:
        print_table("Pads", rows, console)
    if summary.get("uplift_s"):
        (console or PatientConsole()).print(_AFTER_LANDING, highlight=False)


def moves_across(summary: Mapping[str, Any]) -> bool:
    """Return whether a replay moved along y by more than a thousandth of what it moved along x."""
    return summary.get("slip_y_max_mm", 0.0) > NOTHING * summary.get("slip_x_max_mm", 0.0)


def cell(value: Any) -> str:
    """Write a value as it stands in a table: four significant figures, yes and no, nothing for what is not known."""
    if value is None or value != value:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple):
        return ", ".join(cell(item) for item in value)
    return visible(str(value))
