"""Pictures in a recording: a figure drawn by night, and dots that show where every pad is on it now."""

import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.record import Record
from slipwise.view.figures.style import NIGHT, pad_colour, rgb, styled
from slipwise.view.recordings.timeline import frames, time_column

#: Pixels of an inch of a board.
_DPI = 100


@dataclass(frozen=True)
class Dots:
    """Where the pads are on the axes of a board, sample by sample.

    Attributes:
        axes: of the board's figure.
        places: pad -> (n, 2) in the units of the axes.
    """

    axes: Axes
    places: Mapping[str, Array]


@dataclass(frozen=True)
class Board:
    """A picture for a recording.

    Attributes:
        name: over its view.
        figure: drawn within `styled(night=True)`.
        dots: that move on it.
    """

    name: str
    figure: Figure
    dots: tuple[Dots, ...] = ()


def log_board(stream: rr.RecordingStream, root: str, board: Board, record: Record) -> rrb.View:
    """Put a board into the recording, and give the view that shows it.

    Args:
        stream: what is being recorded.
        root: entity path of the board.
        board: the picture and its dots.
        record: whose samples the dots belong to.
    """
    picture = io.BytesIO()
    with styled(night=True):
        board.figure.savefig(picture, format="png", dpi=_DPI, metadata={"Software": None})
    width, height = (round(_DPI * inches) for inches in board.figure.get_size_inches())
    stream.log(f"{root}/board", rr.EncodedImage(contents=picture.getvalue(), media_type="image/png"), static=True)
    shown = frames(record)
    for number, dots in enumerate(board.dots):
        low, high = np.reshape(dots.axes.get_window_extent().extents, (2, 2))
        for pad, places in dots.places.items():
            at = np.asarray(dots.axes.transData.transform(places[shown]))
            inside = ((at >= low) & (at <= high)).all(axis=1)
            at[:, 1] = height - at[:, 1]
            path = f"{root}/{number}/{pad}"
            stream.log(
                path,
                rr.Points2D.from_fields(colors=[rgb(pad_colour(pad))], radii=rr.Radius.ui_points(5.0), draw_order=30.0),
                static=True,
            )
            stream.send_columns(
                path,
                indexes=time_column(record.time[shown]),
                columns=rr.Points2D.columns(positions=at[inside]).partition(inside.astype(int)),
            )
    return rrb.Spatial2DView(
        origin=root,
        name=board.name,
        background=list(rgb(NIGHT)),
        visual_bounds=rrb.VisualBounds2D(x_range=[0, width], y_range=[0, height]),
    )
