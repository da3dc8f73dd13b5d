"""Panels of a picture: placed in inches, or empty with the reason why."""

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.record import Record
from slipwise.view.figures.style import MUTED


def stacked_panels(figure: Figure, rows: int, columns: int = 1, **shared: Any) -> list[list[Axes]]:
    """Return panels under each other in a figure of `new_figure`, placed in inches rather than by a layout engine.

    An engine measures every word of every panel twice, which takes longer than to draw them.

    Args:
        figure: empty.
        rows: of panels.
        columns: of panels.
        shared: `sharex` and `sharey` of matplotlib's `subplots`.

    Returns:
        Rows of axes.
    """
    width, height = figure.get_size_inches()
    figure.set_layout_engine("none")
    left, right, top, bottom, gap, beside = 0.95, 0.15, 0.85, 0.5, 0.42, 0.8
    panel = (height - top - bottom - gap * (rows - 1)) / rows
    across = (width - left - right - beside * (columns - 1)) / columns
    axes = figure.subplots(
        rows, columns, squeeze=False, **shared,
        gridspec_kw={
            "left": left / width, "right": 1.0 - right / width, "top": 1.0 - top / height, "bottom": bottom / height,
            "hspace": gap / panel, "wspace": beside / across,
        },
    )  # fmt: skip
    return [list(row) for row in axes]


def missing(axes: Axes, record: Record, names: Sequence[str]) -> bool:
    """Say in a panel which channels it lacks; tell whether any is missing."""
    absent = [name for name in names if name not in record]
    if absent:
        note(axes, "not recorded: " + ", ".join(absent))
    return bool(absent)


def note(axes: Axes, text: str) -> None:
    """Say in an empty panel why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=MUTED, fontsize=9.0, wrap=True)
