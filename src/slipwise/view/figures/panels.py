"""Panels that pictures share: placed in inches, of pads and their sum, of errors, or empty with the reason why."""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

from slipwise.record import Record
from slipwise.view.figures.pad_layout import PadLayout
from slipwise.view.figures.style import MODEL_COLOURS, MUTED, pad_colour

#: The panel of the pads' sum; colours of errors before and after a change of the model.
SUM_PANEL = "sum"
BEFORE, AFTER = MODEL_COLOURS[0], MODEL_COLOURS[5]


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


def pad_panels(
    figure: Figure, grid: GridSpec, layout: PadLayout, beside: int, labels: tuple[str, str], size: float = 11.0
) -> dict[str, Axes]:
    """Return a panel for each pad, as seen from above with axes in common, and one of their sum beside them.

    Args:
        figure: to draw in.
        grid: of the panels.
        layout: where each pad's panel stands.
        beside: column of the grid from which on the sum is drawn.
        labels: of the axes, written at the left and below.
        size: of the pads' titles [points].
    """
    panels: dict[str, Axes] = {}
    first: Axes | None = None
    for pad, (row, column) in layout.panels.items():
        axes = panels[pad] = figure.add_subplot(grid[row, column], sharex=first, sharey=first)
        first = first or axes
        axes.set_title(layout.titles[pad], color=pad_colour(pad), fontsize=size)
        if column == 0:
            axes.set_ylabel(labels[1])
        if row == layout.rows - 1:
            axes.set_xlabel(labels[0])
    panels[SUM_PANEL] = figure.add_subplot(grid[:, beside:])
    panels[SUM_PANEL].set(title="Sum of the pads", xlabel=labels[0], ylabel=labels[1])
    return panels


def zero_lines(axes: Axes, colour: str = "#b8c0cb", width: float = 0.8) -> None:
    """Draw where both axes are zero, below the curves."""
    axes.axhline(0.0, color=colour, linewidth=width, zorder=1)
    axes.axvline(0.0, color=colour, linewidth=width, zorder=1)


def error_bars(axes: Axes, errors: Sequence[tuple[float, float | None]], labels: tuple[str, str]) -> np.ndarray:
    """Draw errors in noise floors as bars, before and, where there is one, after; return where they stand."""
    places = np.arange(len(errors))
    both = any(later is not None for _, later in errors)
    axes.bar(places - (0.19 if both else 0.0), [e for e, _ in errors], 0.36, color=BEFORE, label=labels[0])
    if both:
        axes.bar(places + 0.19, [later or 0.0 for _, later in errors], 0.36, color=AFTER, label=labels[1])
    axes.axhline(1.0, color=mpl.rcParams["text.color"], lw=1.0, ls="--", label="noise floor")
    return places


def missing(axes: Axes, record: Record, names: Sequence[str]) -> bool:
    """Say in a panel which channels it lacks; tell whether any is missing."""
    absent = [name for name in names if name not in record]
    if absent:
        note(axes, "not recorded: " + ", ".join(absent))
    return bool(absent)


def note(axes: Axes, text: str) -> None:
    """Say in an empty panel why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=MUTED, fontsize=9.0, wrap=True)
