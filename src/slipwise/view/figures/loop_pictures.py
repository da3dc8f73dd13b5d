"""The picture of a record's hysteresis loops: friction against slip, pad by pad and in sum."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.signals.hysteresis_loop import branches, loop_shape
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.pad_layout import PadLayout, layout_of
from slipwise.view.figures.panels import SUM_PANEL, missing, pad_panels, zero_lines
from slipwise.view.figures.style import MUTED, SUM, pad_colour, styled
from slipwise.view.geometry import RigGeometry
from slipwise.view.words.numbers import NOTHING

#: Panels that are less of the picture's width have shorter lines of numbers [1].
_NARROW = 0.17
#: Longer lines become an image inside an SVG: megabytes of vectors help nobody.
_VECTOR_POINTS = 4000
#: Friction that is less of the load is rounding [1].
_NO_FRICTION = 1e-9
_LOOP_WORDS = (
    "kN cm: energy dissipated over the record.  edge: slope of |F| over slip while it slides, 0 for a rectangle "
    "[kN/mm].  flatness: 1 − rms deviation of |F| from its branch's mean over the mean |F|, 1 for a rectangle [1].\n"
    "corners: energy over that of the same trapezoid with sharp corners, less than 1 where they are round [1].  "
    "Bold: the widest cycle."
)


def loops_figure(record: Record, geometry: RigGeometry | None = None) -> Figure:
    """Draw every pad's loop, arranged as seen from above, and their sum; along y too where the girder slid that way.

    Of bearings that do not slide the loop of all buffers together is drawn.
    """
    along, layout = "xy" if _slid(record, "y") else "x", layout_of(record, geometry)
    if not _rubs(record, layout.pads):
        return _buffers_figure(record, along)
    height = 0.6 + 6.2 * len(along) + 0.5
    with styled():
        figure = new_figure(12.0, height, "Friction against slip")
        figure.set_layout_engine("none")
        for i, axis in enumerate(along):
            top = height - 0.8 - 6.2 * i
            _loops_along(figure, record, layout, axis, top / height, (top - 5.3) / height)
        figure.text(0.01, 0.08 / height, _LOOP_WORDS, fontsize=8.0, color=MUTED, va="bottom")
    return figure


def _rubs(record: Record, pads: Sequence[str]) -> bool:
    """Return whether pads carry friction, or none of it was recorded; where buffers are the isolators they do not."""
    forces = [record[n] for pad in pads if (n := f"pad_{pad}_Fx") in record]
    loads = [record[n] for pad in pads if (n := f"pad_{pad}_N") in record]
    if not forces or not loads or not _buffer_channels(record, "x"):
        return True
    return float(np.max(np.abs(forces))) > _NO_FRICTION * float(np.max(loads))


def _buffer_channels(record: Record, axis: str) -> list[str]:
    return [name for name in record.channels if name.startswith("buffer_") and name.endswith(f"_F{axis}")]


def _buffers_figure(record: Record, along: str) -> Figure:
    """Draw the sum of the buffers' forces over slip, along each axis."""
    with styled():
        figure = new_figure(6.4 * len(along), 5.2, "Force of the buffers against slip")
        for axes, axis in zip(figure.subplots(1, len(along), squeeze=False)[0], along, strict=True):
            _loop(axes, record, axis, _buffer_channels(record, axis), SUM)
            axes.set(xlabel=f"slip {axis} [mm]", ylabel=f"ΣF of the buffers along {axis} [kN]")
    return figure


def _slid(record: Record, axis: str) -> bool:
    """Return whether a record slides along an axis by more than a thousandth of what it slides along x."""
    slips = {name: float(np.ptp(record[name])) for name in ("slip_x", f"slip_{axis}") if name in record}
    return f"slip_{axis}" in slips and slips[f"slip_{axis}"] > NOTHING * max(slips.values())


def _loops_along(figure: Figure, record: Record, layout: PadLayout, axis: str, top: float, bottom: float) -> None:
    """Draw the loops along one axis between two heights of the figure [1]."""
    wide = layout.columns
    grid = figure.add_gridspec(
        layout.rows, wide + 2, left=0.06, right=0.985, top=top, bottom=bottom, wspace=0.24, hspace=0.24,
        width_ratios=(*(1.0,) * wide, 0.05, 1.95 if wide == 2 else 0.8 * wide),
    )  # fmt: skip
    labels = (f"slip {axis} [mm]", f"friction F along {axis} [kN]")
    panels = pad_panels(figure, grid, layout, wide + 1, labels, 10.0 if wide == 2 else 9.0)
    panels[SUM_PANEL].set(title=f"Sum of the pads, along {axis}", ylabel=f"ΣF along {axis} [kN]")
    for pad in layout.panels:
        _loop(panels[pad], record, axis, [f"pad_{pad}_F{axis}"], pad_colour(pad))
    _loop(panels[SUM_PANEL], record, axis, [f"pad_{pad}_F{axis}" for pad in layout.pads], SUM)


def _loop(axes: Axes, record: Record, axis: str, forces: Sequence[str], colour: str) -> None:
    """Draw the sum of some channels of force over slip with the loop's numbers beside it."""
    if missing(axes, record, [f"slip_{axis}", *forces]):
        return
    force = np.sum([record[name] for name in forces], axis=0)
    zero_lines(axes)
    slip, long = record[f"slip_{axis}"], len(record) > _VECTOR_POINTS
    axes.plot(slip * 1e3, force / 1e3, color=colour, linewidth=0.8, alpha=0.45, rasterized=long)
    widest = _widest_cycle(slip)
    axes.plot(slip[widest] * 1e3, force[widest] / 1e3, color=colour, linewidth=2.0)
    axes.margins(0.08, 0.24)
    try:
        shape = loop_shape(slip, force)
    except InputError:
        text = "no loop: it did not slide both ways"
    else:
        between = "\n" if axes.get_position().width < _NARROW else ",  "
        text = (
            f"{shape.energy / 10:.1f} kN cm{between}edge {shape.edge_slope / 1e6:+.4f} kN/mm\n"
            f"flatness {shape.flatness:.3f},  corners {shape.corner_sharpness:.3f}"
        )
    axes.text(0.03, 0.985, text, transform=axes.transAxes, va="top", fontsize=8.0, color=MUTED, linespacing=1.4)


def _widest_cycle(slip: Array) -> slice:
    """Find the longest way between two turns together with the way back: it shows the shape that a crowd hides."""
    ends = np.flatnonzero(np.diff(branches(slip)))
    turns = np.concatenate([[0], ends + 1, [len(slip) - 1]])
    ways = np.abs(np.diff(slip[turns]))
    if len(ways) < 3:
        return slice(0, len(slip))
    there_and_back = ways[:-1] + ways[1:]
    i = int(there_and_back.argmax())
    return slice(int(turns[i]), int(turns[i + 2]) + 1)
