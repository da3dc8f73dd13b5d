"""Figures without global state: made, saved whole or not at all, or turned into SVG for a page."""

import hashlib
import io
import re
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from slipwise.jobs.atomic_write import atomic
from slipwise.view.figures.style import styled

#: Of a figure in a notebook.
_DPI = 90
_REFERENCE = re.compile(r'(\bid="|href="#|url\(#)')


class ShownFigure(Figure):
    """A figure that a notebook shows by itself, whatever backend is chosen there."""

    def _repr_png_(self) -> bytes:
        drawn = io.BytesIO()
        with styled():
            self.savefig(drawn, format="png", dpi=_DPI, metadata={"Software": None})
        return drawn.getvalue()


def new_figure(width: float, height: float, title: str = "") -> Figure:
    """Make a figure in the house's style; use within `styled()`.

    Args:
        width: [inch].
        height: [inch].
        title: above everything.
    """
    figure = ShownFigure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    if title:
        figure.suptitle(title, x=0.01, ha="left", fontsize=13.0, fontweight="bold")
    return figure


def save_figure(figure: Figure, path: Path) -> Path:
    """Write a PNG so that it is there whole or not at all; the same figure gives the same bytes."""
    with styled(), atomic(path) as stream:
        # Laid out once and for all: a save with a layout engine lays out twice, which takes as long as to draw.
        if isinstance(figure.get_layout_engine(), ConstrainedLayoutEngine):
            figure.draw_without_rendering()
            figure.set_layout_engine("none")
        figure.savefig(stream, format="png", dpi=150, metadata={"Software": None}, pil_kwargs={"compress_level": 4})
    return path


def figure_svg(figure: Figure) -> str:
    """Return a figure as an SVG element for embedding in HTML.

    The same figure gives the same text: no date, and ids that come from the content, so that several figures on one
    page do not share ids.
    """
    text = io.StringIO()
    with styled():
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    svg = text.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    mark = "f" + hashlib.sha256(svg.encode()).hexdigest()[:8] + "-"
    return _REFERENCE.sub(lambda found: found.group(1) + mark, svg).strip()
