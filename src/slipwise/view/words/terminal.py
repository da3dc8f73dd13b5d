"""Tables in the terminal."""

import textwrap
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
#: Characters between two columns of a table.
_BETWEEN = 3
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

    No word is broken, so that a name can be typed again: where the terminal is too narrow for that, every row is a
    block of lines.

    Args:
        title: above the table.
        rows: one mapping a row; a key that a row lacks leaves its cell empty.
        console: where to print; the standard output if not given.
    """
    console = console or PatientConsole()
    console.print(Text(visible(title), style="bold"))  # a table's own title is broken at the table's width
    columns = list(dict.fromkeys(key for row in rows for key in row))
    texts = [[visible(str(key)), *(cell(row.get(key)) for row in rows)] for key in columns]
    widths = _widths(texts, console.width)
    if widths is None:
        _print_blocks(texts, console)
        return
    table = Table(box=box.SIMPLE_HEAD, header_style="bold")
    for key, column, width in zip(columns, texts, widths, strict=True):
        numeric = all(isinstance(row.get(key), int | float) for row in rows if row.get(key) is not None)
        # Text, so that brackets in names and units are printed and not taken for markup.
        table.add_column(Text(column[0]), justify="right" if numeric else "left", overflow="fold", width=width)
    for row in zip(*(column[1:] for column in texts), strict=True):
        table.add_row(*map(Text, row))
    console.print(table)


def _widths(texts: Sequence[Sequence[str]], room: int) -> list[int] | None:
    """Return how wide each column is where no word is broken, or None where the terminal is too narrow for that.

    Args:
        texts: heading and cells of each column.
        room: characters of a line.
    """
    least = [max(len(word) for text in column for word in text.split() or [""]) for column in texts]
    most = [max(map(len, column)) for column in texts]
    left = room - sum(least) - _BETWEEN * len(texts) - 1
    if left < 0:
        return None
    wanted = [high - low for high, low in zip(most, least, strict=True)]
    share = min(1.0, left / sum(wanted)) if any(wanted) else 0.0
    widths = [low + int(share * more) for low, more in zip(least, wanted, strict=True)]
    for place in sorted(range(len(widths)), key=lambda at: widths[at] - most[at])[: left - sum(widths) + sum(least)]:
        widths[place] += widths[place] < most[place]  # what rounding down has left
    return widths


def _print_blocks(texts: Sequence[Sequence[str]], console: Console) -> None:
    """Print a block for every row: its first cell, and below it the others, each behind its heading."""
    heads, *rows = zip(*texts, strict=True)
    for first, *others in rows:
        console.print()
        console.print(Text(f"  {first}", style="bold"), soft_wrap=True)
        for head, text in zip(heads[1:], others, strict=True):
            if text:
                # a longer word is left whole: whoever copies it gets it in one piece
                lines = textwrap.wrap(
                    f"{head}: {text}", console.width - 1, initial_indent=" " * 4, subsequent_indent=" " * 6,
                    break_long_words=False, break_on_hyphens=False,
                )  # fmt: skip
                for line in lines:
                    console.print(Text(line), soft_wrap=True)
    console.print()


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
