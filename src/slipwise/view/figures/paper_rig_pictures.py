"""Pictures of the paper's rig: the input, the loads on the pads, the loops and the extreme motion."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.channels import PADS
from slipwise.record import Record
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import EXPECTED, MUTED, PAD_COLOURS, SUM, TABLE, UPLIFT, envelope, styled

GRAVITY = 9.80665
_TITLES = {"bridge1": "Bridge 1", "bridge2": "Bridge 2"}


def input_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw what went into the table of Bridge 1, and the slip both ways."""
    time = curves["time"]
    with styled():
        figure = new_figure(11.0, 7.2)
        panels = figure.subplots(4, 1, sharex=True)
        rows = (("ground", "Ground, along", TABLE), ("pier", "Pier top, along (Fig. 6, left)", PAD_COLOURS["A"]),
                ("vertical", "Pier top, up (Fig. 6, right)", PAD_COLOURS["B"]))  # fmt: skip
        for axes, (name, title, colour) in zip(panels, rows, strict=False):
            axes.plot(*envelope(time, curves[name] / GRAVITY), color=colour, linewidth=0.8)
            axes.set(title=title, ylabel="a [g]")
        along = 1.05 * np.abs(curves["pier"]).max() / GRAVITY
        for axes in panels[:3]:
            axes.set_ylim(-along, along)
        axes = panels[3]
        axes.plot(
            *envelope(time, curves["deck_slip"]), color=EXPECTED, linewidth=2.4, label="superstructure on the bridge"
        )
        axes.plot(
            *envelope(time, curves["rig_slip"]), color=SUM, linewidth=1.0, label="girder on the table, times 10.69"
        )
        axes.set(title="Slip, in the prototype's size", ylabel="x [m]", xlabel="time of the model [s]")
        axes.margins(y=0.3)
        axes.legend(ncols=2, loc="upper right")
    return figure


def loads_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw Fig. 7 for both bridges and Fig. 8 below."""
    with styled():
        figure = new_figure(11.0, 7.8)
        panels = figure.subplots(4, 2, sharex="col", sharey="row")
        for column, (bridge, part) in enumerate(curves.items()):
            start, end = _strongest(part["time"], part["rocking"])
            rows = (
                (f"{_TITLES[bridge]}: load of pad A", part["load"], SUM),
                ("Factor A: mass times vertical acceleration", part["inertia"], MUTED),
                ("Factor B: the rest, rocking", part["rocking"], PAD_COLOURS["A"]),
            )
            for axes, (title, values, colour) in zip(panels[:3, column], rows, strict=True):
                axes.plot(part["time"], values / 1e3, color=colour, linewidth=1.0)
                axes.set_title(title)
            axes = panels[3, column]
            axes.plot(part["time"], part["rocking"] / 1e3, color=PAD_COLOURS["A"], label="pad A")
            axes.plot(part["time"], part["rocking_B"] / 1e3, color=PAD_COLOURS["B"], label="pad B")
            axes.set(title="Factor B of pads A and B (Fig. 8)", xlabel="time [s]", xlim=(start, end))
            axes.legend(ncols=2, loc="upper right")
        for axes in panels[:, 0]:
            axes.set_ylabel("kN")
        for row in (2, 3):
            largest = max(np.abs(p["rocking"]).max() for p in curves.values()) / 1e3
            panels[row, 0].set_ylim(-1.3 * largest, 1.3 * largest)
    return figure


def _strongest(time: np.ndarray, values: np.ndarray, seconds: float = 4.0) -> tuple[float, float]:
    """Return the part of this length around the middle of the strong motion."""
    power = np.cumsum(values**2)
    middle = float(time[np.searchsorted(power, 0.5 * power[-1])])
    return max(middle - seconds / 2.0, 0.0), max(middle - seconds / 2.0, 0.0) + seconds


def loops_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw the loops of Figs. 9 and 10."""
    with styled():
        figure = new_figure(11.0, 6.4)
        grid = figure.add_gridspec(2, 4, height_ratios=(1.0, 1.35))
        sine, records = curves["sine"], curves["records"]
        first: Axes | None = None
        for i, pad in enumerate(PADS):
            axes = figure.add_subplot(grid[0, i], sharex=first, sharey=first)
            first = first or axes
            axes.plot(sine["slip_x"] * 1e3, sine[f"pad_{pad}_Fx"] / 1e3, color=PAD_COLOURS[pad], linewidth=1.3)
            axes.set(title=f"Pad {pad}, sine", xlabel="slip [mm]")
            if i == 0:
                axes.set_ylabel("F [kN]")
        left = None
        for i, (vertical, title) in enumerate(((True, "Sum, with vertical motion"), (False, "Sum, without"))):
            axes = figure.add_subplot(grid[1, 2 * i : 2 * i + 2], sharex=left, sharey=left)
            left = left or axes
            _sum_loop(axes, records[vertical], SUM)
            axes.set(title=f"{title} (Fig. 10)", xlabel="slip [mm]")
            if i == 0:
                axes.set_ylabel("sum of F [kN]")
    return figure


def _sum_loop(axes: Axes, record: Record, colour: str, label: str = "", width: float = 0.9) -> None:
    force = record.stacked("pad_{}_Fx").sum(axis=1)
    axes.plot(record["slip_x"] * 1e3, force / 1e3, color=colour, linewidth=width, label=label)


def energies_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw the energies of the ensemble beside the paper's pair."""
    pairs, ratio, reach = curves["pairs"], curves["ratio"], curves["reach_ratio"]
    with styled():
        figure = new_figure(11.0, 3.8)
        left, right = figure.subplots(1, 2)
        left.plot(pairs[:, 1] / 10, pairs[:, 0] / 10, ".", color=PAD_COLOURS["A"], alpha=0.6, label="one motion each")
        ends = np.array([pairs.min(), pairs.max()]) / 10
        left.plot(ends, ends, color=EXPECTED, zorder=1)
        left.plot(531, 532, "*", color=UPLIFT, markersize=15, label="paper: 531, 532")
        left.set(title="Energy of the pads", xlabel="without vertical motion [kN cm]", ylabel="with [kN cm]")
        left.legend()
        half = max(float(np.percentile(np.abs(ratio - 1.0), 99)), 0.01)
        bins = list(np.linspace(1.0 - half, 1.0 + half, 31))
        right.hist(ratio, bins, color=PAD_COLOURS["C"], label="all motions")
        right.axvline(532 / 531, color=UPLIFT, linewidth=2.0, label="paper: 1.002")
        right.plot(reach, np.full(len(reach), 0.4), "|", color=SUM, markersize=12, label="scaled to 532 kN cm")
        right.set(title="Energy with over without vertical motion", xlabel="ratio", ylabel="motions")
        right.margins(y=0.35)
        right.set_ylim(bottom=0.0)
        right.legend()
    return figure


def extreme_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw Figs. 14 and 15: load and loop, one degree of freedom and the full rig."""
    with styled():
        figure = new_figure(11.0, 6.6)
        panels = figure.subplots(2, 2, width_ratios=(1.5, 1.0), sharex="col")
        for i, (name, title) in enumerate((("none", "no vertical motion (Fig. 14)"), ("extreme", "500 % (Fig. 15)"))):
            full, single = curves["cases"][name]
            record = full.record
            load, loop = panels[i]
            start, end = _strongest(record.time, record["slip_vx"])
            inside = (record.time >= start) & (record.time <= end)
            load.plot(record.time[inside], record["pad_A_N"][inside] / 1e3, color=PAD_COLOURS["A"], label="rig, pad A")
            kept = (single.time >= start) & (single.time <= end)
            load.plot(
                single.time[kept], single.load[kept] / 4e3, color=UPLIFT, linewidth=1.0, label="one d.o.f., a quarter"
            )
            load.set(title=f"Load of a pad, {title}", ylabel="N [kN]", xlim=(start, end))
            load.set_ylim(-0.04 * load.get_ylim()[1], 1.25 * load.get_ylim()[1])
            load.legend(loc="upper right", ncols=2)
            _sum_loop(loop, record, PAD_COLOURS["A"], "rig")
            loop.plot(single.slip * 1e3, single.friction / 1e3, color=UPLIFT, linewidth=0.6, label="one d.o.f.")
            loop.set(title="Sum of the pads", ylabel="kN")
            loop.margins(y=0.2)
            loop.legend(loc="upper left", ncols=2)
        panels[1, 0].set_xlabel("time [s]")
        panels[1, 1].set_xlabel("slip [mm]")
    return figure
