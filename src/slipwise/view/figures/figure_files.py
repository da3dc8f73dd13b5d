"""The figures of a page as files of their own: each as SVG, and what is drawn in it as a table beside."""

import csv
import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection, QuadMesh
from matplotlib.container import BarContainer
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle

from slipwise.record import write_text

#: Letters of a file's name at most.
_LONGEST = 60
_COLUMNS = ("panel", "series", "x", "y", "value")


@dataclass
class Exported:
    """Figures of a page that is being made.

    Attributes:
        folder: that takes them.
        files: written so far.
    """

    folder: Path
    files: list[Path] = field(default_factory=list[Path])


_WANTED: ContextVar[Exported | None] = ContextVar("figures wanted as files", default=None)


@contextmanager
def figures_into(folder: Path | None) -> Iterator[list[Path]]:
    """Write every figure of the pages that are made within into a folder as well; none if there is no folder.

    Gives the list that the files are added to.
    """
    wanted = None if folder is None else Exported(folder)
    before = _WANTED.set(wanted)
    try:
        yield [] if wanted is None else wanted.files
    finally:
        _WANTED.reset(before)


def export(figure: Figure, svg: str, words: str) -> None:
    """Write a figure and its numbers, if somebody wants them.

    Args:
        figure: that was drawn.
        svg: the same as SVG.
        words: what it shows; makes its name.

    Raises:
        OutputError: the folder cannot be written.
    """
    wanted = _WANTED.get()
    if wanted is None:
        return
    plain = re.sub(r"[^a-z0-9]+", "_", words.lower()).strip("_")
    name = f"{len(wanted.files) // 2 + 1:02d}_{plain[:_LONGEST].rstrip('_')}"
    text = io.StringIO()
    rows: csv.DictWriter[str] = csv.DictWriter(text, list(_COLUMNS), lineterminator="\n")
    rows.writeheader()
    rows.writerows(drawn(figure))
    for ending, content in ((".svg", svg + "\n"), (".csv", text.getvalue())):
        write_text(wanted.folder / f"{name}{ending}", content)
        wanted.files.append(wanted.folder / f"{name}{ending}")


def drawn(figure: Figure) -> list[dict[str, Any]]:
    """Return the numbers that are drawn in a figure: of lines, bars, dots and maps, in the units of its axes."""
    return [row for number, axes in enumerate(figure.axes, 1) for row in _of_panel(axes, _name(axes, number))]


def _name(axes: Axes, number: int) -> str:
    titles = (axes.get_title(), axes.get_title(loc="left"), axes.get_ylabel(), axes.get_xlabel())
    return " ".join(next((t for t in titles if t), f"panel {number}").split())


def _of_panel(axes: Axes, panel: str) -> Iterator[dict[str, Any]]:
    def row(series: object, x: object, y: object, value: object = "") -> dict[str, Any]:
        named = str(series)
        shown = ["" if v is np.ma.masked else f"{v:.7g}" if isinstance(v, float | np.floating) else v for v in (x, y)]
        whole = f"{value:.7g}" if isinstance(value, float | np.floating) else value
        values = ("" if named.startswith("_") else named, *shown, whole)
        return dict(zip(_COLUMNS, (panel, *values), strict=True))

    for line in axes.get_lines():
        if line.get_transform().contains_branch(axes.transData):  # not a level across the whole panel
            for x, y in zip(*(np.ravel(np.asarray(v, dtype=float)) for v in line.get_data()), strict=True):
                if np.isfinite(x) and np.isfinite(y):
                    yield row(line.get_label(), x, y)
    ticks = {axis: _labels(axis) for axis in (axes.xaxis, axes.yaxis)}
    for bars in (c for c in axes.containers if isinstance(c, BarContainer)):
        for bar in (p for p in bars.patches if isinstance(p, Rectangle)):
            if bars.orientation == "horizontal":
                middle = bar.get_y() + bar.get_height() / 2.0
                yield row(bars.get_label(), float(bar.get_x() + bar.get_width()), _at(ticks[axes.yaxis], middle))
            else:
                middle = bar.get_x() + bar.get_width() / 2.0
                yield row(bars.get_label(), _at(ticks[axes.xaxis], middle), float(bar.get_y() + bar.get_height()))
    for dots in (c for c in axes.collections if isinstance(c, PathCollection)):
        for x, y in np.ma.asarray(dots.get_offsets()):
            yield row(dots.get_label(), float(x), float(y))
    for mesh in (c for c in axes.collections if isinstance(c, QuadMesh)):
        corners, values = (
            np.asarray(mesh.get_coordinates()),
            np.ma.filled(np.ma.asarray(mesh.get_array(), dtype=float), np.nan),
        )
        middle = (corners[1:, 1:] + corners[:-1, :-1]) / 2.0
        for (x, y), value in zip(middle.reshape(-1, 2), values.ravel(), strict=True):
            if np.isfinite(value):
                yield row(mesh.get_label(), x, y, value)
    for image in (i for i in axes.get_images() if isinstance(i, AxesImage)):
        for x, y, value in _pixels(image):
            yield row(image.get_label(), _at(ticks[axes.xaxis], x), _at(ticks[axes.yaxis], y), value)


def _pixels(image: AxesImage) -> Iterator[tuple[float, float, float]]:
    values = np.ma.filled(np.ma.asarray(image.get_array(), dtype=float), np.nan)
    if values.ndim != 2:  # colours, not numbers
        return
    left, right, bottom, top = image.get_extent()
    rows, columns = values.shape
    for i, j in np.argwhere(np.isfinite(values)):
        up = (i + 0.5) / rows if image.origin == "lower" else 1.0 - (i + 0.5) / rows
        yield left + (right - left) * (j + 0.5) / columns, bottom + (top - bottom) * up, float(values[i, j])


def _labels(axis: Any) -> dict[float, str]:
    return {float(tick.get_loc()): tick.label1.get_text() for tick in axis.get_major_ticks()}


def _at(labels: dict[float, str], place: float) -> float | str:
    """Return the label of a bar's place; the place itself where the axis has numbers."""
    near = min(labels, key=lambda at: abs(at - place), default=place)
    return labels[near] if abs(near - place) < 0.5 and labels.get(near) else float(place)
