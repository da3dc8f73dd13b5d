"""Every channel over time in the viewer, in the units that people read."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from slipwise.channels import channel, pads_in
from slipwise.record import Record
from slipwise.view.figures.style import (
    AXIS_COLOURS,
    NIGHT_INK,
    PAD_COLOURS,
    TABLE,
    UPLIFT,
    buffer_colour,
    envelope,
    packed,
    pad_colour,
    rgb,
    shown,
)
from slipwise.view.recordings.timeline import time_column

#: A longer series is thinned to the smallest and the largest value of so many stretches: more than a screen shows.
_STRETCHES = 1500
#: Slower than this a pad counts as sticking [m/s].
STICKING = 0.002
_STATES = {"slides": "#2f6f9f", "sticks": "#39434f", "lifted off": UPLIFT}


@dataclass(frozen=True)
class Plot:
    """A plot of channels of one unit: its title and the channels' names."""

    title: str
    names: tuple[str, ...]


Tabs = dict[str, tuple[Plot, ...]]


def tabs_of(pads: Sequence[str], buffers: Sequence[str]) -> Tabs:
    """Return the tabs of plots of a rig, in the order in which they are read."""

    def per_pad(pattern: str) -> tuple[str, ...]:
        return tuple(pattern.format(pad) for pad in pads)

    return {
        "overview": (
            Plot("Slip", ("slip_x", "slip_y")),
            Plot("Load on the pads", per_pad("pad_{}_N")),
            Plot("Friction of the pads along x", per_pad("pad_{}_Fx")),
        ),
        "acceleration": tuple(Plot(f"Acceleration {axis}", (f"table_a{axis}", f"girder_a{axis}")) for axis in "xyz")
        + (Plot("Vertical acceleration of the edges", ("girder_az_1", "girder_az_2")),),
        "motion": (
            Plot("Table", ("table_dx", "table_dy", "table_dz")),
            Plot("Slip speed", ("slip_vx", "slip_vy")),
            Plot("Turning of the girder", ("yaw", "pitch", "roll", "table_pitch")),
            Plot("Heave", ("heave",)),
        ),
        "across": (
            Plot("Friction of the pads along y", per_pad("pad_{}_Fy")),
            Plot("Buffers along y", tuple(f"buffer_{b}_Fy" for b in buffers)),
            Plot("Buffers along x", tuple(f"buffer_{b}_Fx" for b in buffers)),
        ),
        "pads": (Plot("Pressure", per_pad("pad_{}_P")), Plot("Temperature", per_pad("pad_{}_T"))),
    }


def overlaid_tabs_of(pads: Sequence[str], buffers: Sequence[str]) -> Tabs:
    """Return the same for records held against each other: one channel a plot."""
    return {
        "motion": tuple(Plot(name, (name,)) for name in ("slip_x", "girder_ax", "girder_az", "yaw")),
        "friction": tuple(Plot(f"Friction of pad {pad}", (f"pad_{pad}_Fx",)) for pad in pads),
        "load": tuple(Plot(f"Load on pad {pad}", (f"pad_{pad}_N",)) for pad in pads),
        "buffers": tuple(Plot(f"Buffer {b}", (f"buffer_{b}_Fx",)) for b in buffers),
    }


def colour_of(name: str) -> str:
    """Return the colour of a channel: that of its pad or buffer, of the table, or by its axis."""
    owner = name.split("_")
    if owner[0] == "pad":
        return pad_colour(owner[1])
    if owner[0] == "buffer":
        return buffer_colour(owner[1])
    if owner[0] in ("table", "girder") and owner[1][0] == "a":
        return TABLE if owner[0] == "table" else PAD_COLOURS["B"] if owner[-1] == "2" else NIGHT_INK
    turning = {"roll": "x", "pitch": "y", "yaw": "z", "heave": "z"}
    axis = turning.get(owner[-1], name[-1])
    return NIGHT_INK if axis == "x" else AXIS_COLOURS[axis]


def _short(name: str) -> str:
    """Name a channel in a legend whose plot tells the rest."""
    return name.split("_")[1] if name.startswith(("pad_", "buffer_")) else name


@dataclass(frozen=True)
class Line:
    """How one of several records looks in plots that show them together.

    Attributes:
        entity: last part of the entity path; lines are drawn in the order of these names.
        label: shown in the legend.
        colour: of all its lines.
        width: of its lines [points].
    """

    entity: str
    label: str
    colour: str
    width: float


def log_series(stream: rr.RecordingStream, root: str, record: Record, line: Line | None = None) -> None:
    """Put every channel of a record into the recording, thinned so that no extreme is lost.

    Args:
        stream: what is being recorded.
        root: entity path; a channel is `root/name`, or `root/name/line.entity`.
        record: its channels.
        line: how the record looks among others; without it every channel has its own colour.
    """
    for name in record.channels:
        time, values = envelope(record.time, shown(record, name), _STRETCHES)
        path = f"{root}/{name}/{line.entity}" if line else f"{root}/{name}"
        stream.log(
            path,
            rr.SeriesLines(
                names=line.label if line else _short(name),
                colors=[rgb(line.colour if line else colour_of(name))],
                widths=line.width if line else 1.5,
                aggregation_policy="MinMax",
            ),
            static=True,
        )
        stream.send_columns(path, indexes=time_column(time), columns=rr.Scalars.columns(scalars=values))


def log_states(stream: rr.RecordingStream, root: str, record: Record) -> bool:
    """Put into the recording when each pad slides, sticks, or is lifted off; tell whether the record shows it."""
    pads = pads_in(record.channels)
    loads = [f"pad_{pad}_N" for pad in pads]
    if not pads or not record.has_all("slip_x", *loads):
        return False
    speed = np.hypot(*(_speed(record, axis) for axis in "xy"))
    words = list(_STATES)
    for pad, name in zip(pads, loads, strict=True):
        state = np.where(record[name] <= 0.0, 2, np.where(speed < STICKING, 1, 0))
        kept = np.concatenate([[0], np.flatnonzero(np.diff(state)) + 1])
        stream.log(
            f"{root}/pad_{pad}",
            rr.StateConfiguration(values=words, colors=np.array([packed(c) for c in _STATES.values()], np.uint32)),
            static=True,
        )
        stream.send_columns(
            f"{root}/pad_{pad}",
            indexes=time_column(record.time[kept]),
            columns=rr.StateChange.columns(state=[words[i] for i in state[kept]]),
        )
    return True


def _speed(record: Record, axis: str) -> NDArray[np.float64]:
    if f"slip_v{axis}" in record:
        return record[f"slip_v{axis}"]
    if f"slip_{axis}" in record:
        return np.gradient(record[f"slip_{axis}"], record.time)
    return np.zeros(len(record))


def series_tabs(root: str, records: Sequence[Record], layout: Tabs, states: str = "") -> list[rrb.Container]:
    """Lay the series out in tabs of plots, leaving out what no record holds, and one for what the pads do."""
    tabs: list[rrb.Container] = []
    for tab, plots in layout.items():
        views = []
        for plot in plots:
            there = [name for name in plot.names if any(name in record for record in records)]
            if there:
                views.append(
                    rrb.TimeSeriesView(
                        origin=root,
                        contents=[f"+ {root}/{name}/**" for name in there],
                        name=f"{plot.title} [{channel(there[0]).shown_in}]",
                        plot_legend=rrb.PlotLegend(corner=rrb.Corner2D.RightTop),
                        axis_x=rrb.archetypes.TimeAxis(link="LinkToGlobal"),
                    )
                )
        if views:
            tabs.append(rrb.Vertical(*views, name=tab))
    if states:
        tabs.append(rrb.Vertical(rrb.StateTimelineView(origin=states, name="What each pad does"), name="pads' states"))
    return tabs
