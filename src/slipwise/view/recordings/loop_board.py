"""Loops that grow with time in the viewer: axes and whole loops as a picture, past and present drawn over it."""

import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import rerun as rr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.channels import pads_in
from slipwise.record import Record
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.pad_layout import PadLayout
from slipwise.view.figures.panels import SUM_PANEL, pad_panels, zero_lines
from slipwise.view.figures.style import NIGHT, NIGHT_INK, NIGHT_MUTED, mixed, pad_colour, rgb, styled
from slipwise.view.recordings.timeline import frames, time_column

#: Size of the picture under the loops [pixel].
BOARD_SIZE = (1600, 720)
#: Pieces by which a loop grows [1/s].
_PIECES = 25.0
#: Points of a growing loop [1/s].
_POINTS = 250.0
#: This much of the past is drawn bright [s].
RECENT = 1.5


@dataclass(frozen=True)
class LoopTrace:
    """One record on the board.

    Attributes:
        label: shown in the legend; nothing for a single record.
        record: with slip_x and pads' friction.
        colours: of each pad's panel and of the sum's; what is not named has its own.
        width: of its lines [points].
    """

    label: str
    record: Record
    colours: dict[str, str]
    width: float = 2.0

    def colour(self, panel: str) -> str:
        """Return the colour of a panel's line."""
        return self.colours.get(panel) or pad_colour(panel)


def own_colours(record: Record) -> LoopTrace:
    """Return a record in the pads' own colours."""
    return LoopTrace("", record, {SUM_PANEL: NIGHT_INK})


def one_colour(label: str, record: Record, colour: str, width: float = 2.0) -> LoopTrace:
    """Return a record in one colour on every panel."""
    return LoopTrace(label, record, dict.fromkeys((*pads_in(record.channels), SUM_PANEL), colour), width)


def panels_of(record: Record, pads: Sequence[str]) -> dict[str, Array]:
    """Return the friction [N] of every panel that the record can fill: pads, and the sum if all of them are there."""
    there = {pad: record[f"pad_{pad}_Fx"] for pad in pads if f"pad_{pad}_Fx" in record}
    if "slip_x" not in record:
        return {}
    if len(there) == len(pads):  # of a lone slider too, whose panel would stand empty
        there[SUM_PANEL] = np.sum(list(there.values()), axis=0)
    return there


def log_loops(stream: rr.RecordingStream, root: str, traces: Sequence[LoopTrace], layout: PadLayout) -> list[str]:
    """Put the board into the recording.

    Args:
        stream: what is being recorded.
        root: entity path of the board.
        traces: one for a replay; the measurement first for a comparison.
        layout: where each pad's panel stands.

    Returns:
        Entity paths of the growing lines, each to be shown with all its past ("/past") or its last 1.5 s ("/recent").
    """
    with styled(night=True):
        figure = new_figure(BOARD_SIZE[0] / 100, BOARD_SIZE[1] / 100)
        axes = _axes(figure, layout)
        for trace in traces:
            for panel, force in panels_of(trace.record, layout.pads).items():
                slip = trace.record["slip_x"]
                axes[panel].plot(slip * 1e3, force / 1e3, color=trace.colour(panel), alpha=0.28, linewidth=0.8)
        for trace in traces:
            if trace.label:
                axes[SUM_PANEL].plot([], [], color=trace.colour(SUM_PANEL), linewidth=3.0, label=trace.label)
        if any(trace.label for trace in traces):
            axes[SUM_PANEL].legend(loc="lower right", fontsize=13.0)
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=100, metadata={"Software": None})
    stream.log(f"{root}/board", rr.EncodedImage(contents=picture.getvalue(), media_type="image/png"), static=True)
    growing = []
    for number, trace in enumerate(traces):
        for panel, force in panels_of(trace.record, layout.pads).items():
            path = f"{root}/{number}/{panel}"
            places = axes[panel].transData.transform(np.column_stack([trace.record["slip_x"] * 1e3, force / 1e3]))
            places[:, 1] = BOARD_SIZE[1] - places[:, 1]
            _log_line(stream, path, trace, panel, places, 10.0 * number)
            growing += [f"{path}/past", f"{path}/recent"]
    return growing


def _axes(figure: Figure, layout: PadLayout) -> dict[str, Axes]:
    grid, few = figure.add_gridspec(layout.rows, 2 * layout.columns), len(layout.pads) <= 4
    small = 17.0 if few else 12.0
    axes = pad_panels(figure, grid, layout, layout.columns, ("slip x [mm]", "friction [kN]"), small)
    axes[SUM_PANEL].set_title("Sum of the pads", fontsize=17.0)
    for panel in axes.values():
        panel.tick_params(labelsize=15.0 if few else 11.0)
        panel.margins(0.08)
        zero_lines(panel, "#3a4552", 1.0)
        for label in (panel.xaxis.label, panel.yaxis.label):
            label.set(fontsize=small - 2.0, color=NIGHT_MUTED)
    return axes


def _log_line(stream: rr.RecordingStream, path: str, trace: LoopTrace, panel: str, places: Array, above: float) -> None:
    """Send the past as pieces that add up, once dim and once bright, and the present as a dot."""
    record, colour = trace.record, rgb(trace.colour(panel))
    thin = frames(record, _POINTS)
    per_piece = max(1, round(1.0 / (_PIECES * record.dt * (thin[1] if len(thin) > 1 else 1))))
    starts = range(0, max(len(thin) - 1, 1), per_piece)
    pieces = [places[thin[start : start + per_piece + 1]] for start in starts]
    ends = thin[[min(start + per_piece, len(thin) - 1) for start in starts]]
    dim = rgb(mixed(trace.colour(panel), NIGHT, 0.5))
    for part, shade, width, order in (("past", dim, 0.3, 20.0), ("recent", colour, 0.55, 25.0)):
        stream.log(
            f"{path}/{part}",
            rr.LineStrips2D.from_fields(
                colors=[shade], radii=rr.Radius.ui_points(width * trace.width), draw_order=order + above
            ),
            static=True,
        )
        stream.send_columns(
            f"{path}/{part}", indexes=time_column(record.time[ends]), columns=rr.LineStrips2D.columns(strips=pieces)
        )
    shown = frames(record)
    stream.log(
        f"{path}/now",
        rr.Points2D.from_fields(colors=[colour], radii=rr.Radius.ui_points(5.0), draw_order=28.0 + above),
        static=True,
    )
    stream.send_columns(
        f"{path}/now", indexes=time_column(record.time[shown]), columns=rr.Points2D.columns(positions=places[shown])
    )
