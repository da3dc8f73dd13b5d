"""Pictures of a bearing report: loops with the law over them, coefficients over speed and pressure, and degradation."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.bearings.loops import SUM, Loop
from slipwise.bearings.measured import RunLoops
from slipwise.bearings.result import CYCLE, RUN, BearingReport, BearingRow
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.panels import zero_lines
from slipwise.view.figures.style import INK, MODEL_COLOURS, pad_colour, styled
from slipwise.view.figures.style import SUM as SUM_COLOUR

_MEASURED, _LAW = INK, MODEL_COLOURS[0]
#: Panels of loops at most, and in one row.
_MOST, _IN_A_ROW = 6, 3
#: Samples beyond which a line becomes an image inside an SVG.
_VECTOR_POINTS = 4000


def drawn_runs(found: BearingReport) -> list[RunLoops]:
    """Return the runs whose loops are drawn: cyclic ones first."""
    return sorted(found.loops, key=lambda one: not one.cut.cyclic)[:_MOST]


def loops_figure(found: BearingReport, *, narrow: bool = False) -> Figure:
    """Draw force against slip of the total in each run, measured and by the law, closed cycles dark.

    Args:
        found: the report.
        narrow: one below the other, for a phone.
    """
    runs = drawn_runs(found)
    columns = 1 if narrow else min(len(runs), _IN_A_ROW)
    rows = -(-len(runs) // columns)
    with styled():
        figure = new_figure(3.7 * columns + 0.6, 3.3 * rows + 0.5)
        panels = figure.subplots(rows, columns, squeeze=False).ravel()
        for axes in panels[len(runs) :]:
            axes.set_visible(False)
        for axes, one in zip(panels, runs, strict=False):
            loop = next((each for each in one.loops if each.bearing == found.total), one.loops[0])
            _draw_loop(axes, found, one, loop)
        handles, words = panels[0].get_legend_handles_labels()
        figure.legend(handles, words, loc="outside upper right", ncols=3)
    return figure


def _draw_loop(axes: Axes, found: BearingReport, one: RunLoops, loop: Loop) -> None:
    unit, factor = ("kN", 1e-3) if float(np.abs(loop.force).max()) > 100.0 else ("N", 1.0)
    zero_lines(axes)
    slip, long = 1e3 * loop.slip, len(loop.slip) > _VECTOR_POINTS
    axes.plot(slip, factor * loop.force[:, 0], color="#c9d0d8", linewidth=0.8, rasterized=long, label="whole run")
    for number, cycle in enumerate(c for c in one.cut.cycles if one.cut.cyclic and c.closed):
        part = loop.of(cycle)
        label = None if number else "closed cycles"
        axes.plot(1e3 * part.slip, factor * part.force[:, 0], color=_MEASURED, linewidth=1.0, label=label)
    law = found.forces.get(one.run)
    wanted = one.pads if loop.bearing == SUM else (loop.bearing,)
    if law is not None and set(wanted) <= set(law.pads):
        said = law.force[:, [law.pads.index(pad) for pad in wanted], 0].sum(axis=1)
        axes.plot(
            slip, factor * said, color=_LAW, linewidth=0.9, linestyle=(0, (4, 3)), rasterized=long, label="fitted law"
        )
    name = "sum of the pads" if loop.bearing == SUM else f"pad {loop.bearing}"
    axes.set_title(f"{one.run}: {name}", fontsize=9.0)
    axes.set(xlabel="slip [mm]", ylabel=f"force [{unit}]")


def friction_figure(found: BearingReport) -> Figure:
    """Draw coefficients of every pad over speed and over pressure: of each closed cycle, or else of each run."""
    rows = [r for r in (found.of(CYCLE) or found.of(RUN)) if r.bearing != SUM] or list(found.of(RUN))
    with styled():
        figure = new_figure(10.4, 4.2)
        left, right = figure.subplots(1, 2, sharey=True)
        for axes, key, factor, label in (
            (left, "peak_speed", 1e3, "peak speed [mm/s]"),
            (right, "peak_speed_pressure", 1e-6, "pressure at peak speed [MPa]"),
        ):
            for bearing in dict.fromkeys(row.bearing for row in rows):
                own = [row for row in rows if row.bearing == bearing]
                colour = SUM_COLOUR if bearing == SUM else pad_colour(bearing)
                _scatter(axes, own, key, factor, colour, bearing)
            axes.set_xlabel(label)
        left.set_ylabel("coefficient at peak speed [1]")
        handles, words = left.get_legend_handles_labels()
        figure.legend(handles, words, loc="outside upper right", ncols=6)
    return figure


def _scatter(axes: Axes, rows: list[BearingRow], key: str, factor: float, colour: str, bearing: str) -> None:
    place = [factor * row.values[key].measured for row in rows]
    values = [row.values["friction_peak_speed"] for row in rows]
    axes.plot(place, [v.measured for v in values], "o", color=colour, markersize=5.0, label=f"{bearing}, measured")
    axes.plot(place, [v.law for v in values], "_", color=colour, markersize=11.0, label=f"{bearing}, law")


def degradation_figure(found: BearingReport) -> Figure:
    """Draw energy and characteristic strength of every cycle over those of the first one, of the total."""
    own = [d for d in found.degradation if d.bearing == found.total]
    with styled():
        figure = new_figure(10.4, 3.8)
        left, right = figure.subplots(1, 2, sharey=True)
        for number, place in enumerate(dict.fromkeys((d.run, d.series) for d in own)):
            series = [d for d in own if (d.run, d.series) == place]
            several = len({d.series for d in own if d.run == place[0]}) > 1
            label = f"{place[0]}, series {place[1]}" if several else place[0]
            colour = MODEL_COLOURS[number % len(MODEL_COLOURS)]
            cycles = [d.cycle for d in series]
            left.plot(cycles, [d.energy_first for d in series], "o-", color=colour, markersize=4.0, label=label)
            right.plot(cycles, [d.strength_first for d in series], "o-", color=colour, markersize=4.0)
        for axes, words in ((left, "Energy"), (right, "Characteristic strength Q_d")):
            axes.axhline(1.0, color=_MEASURED, linewidth=0.8)
            axes.set_title(f"{words} over the first cycle", fontsize=10.0)
            axes.set_xlabel("cycle of the series")
        left.set_ylabel("ratio [1]")
        handles, words = left.get_legend_handles_labels()
        figure.legend(handles, words, loc="outside lower center", ncols=3)
    return figure
