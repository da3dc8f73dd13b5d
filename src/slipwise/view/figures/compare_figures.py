"""Figures of a comparison: errors over the floor, overlaid histories and loops."""

from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from slipwise.arrays import Array
from slipwise.channels import channel
from slipwise.comparison.component_level import NAMES
from slipwise.comparison.result import Comparison
from slipwise.noise.level import AT_FLOOR, is_at_floor
from slipwise.relations.base_shear import pair_forces
from slipwise.relations.run_data import FitRun
from slipwise.units import parse_unit
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.pad_layout import layout_from_places
from slipwise.view.figures.panels import SUM_PANEL, pad_panels, zero_lines
from slipwise.view.figures.style import INK, MUTED, UPLIFT, envelope, shown_unit, styled

_MEASURED, _MODEL, _HELD = INK, "#e69f00", "#0072b2"


def shown_run(found: Comparison) -> int:
    """Return the place of the run that pictures show: the first held out, else the last."""
    objective = found.base.objective
    return [*objective.held_out, *objective.fitted[-1:]][0]


def errors_figure(found: Comparison, *, narrow: bool = False) -> Figure:
    """Draw every balance's and channel's error in multiples of its floor, fitted and held-out runs apart."""
    rows: list[tuple[str, float | None, float | None]] = [
        (NAMES[r][0], found.error(r, held_out=False), found.error(r, held_out=True)) for r in found.relations
    ]
    split = len(rows)
    if found.system:
        from slipwise.comparison.system_level import pool_system_errors

        for name, label in (
            ("slip_x", "slip"),
            ("girder_ax", "girder a x"),
            ("girder_az", "girder a z"),
            ("pad_*_N", "pad loads N"),
            ("pad_*_Fx", "pad friction F"),
        ):
            pair = [pool_system_errors(found.system.errors, name, held_out=h) for h in (False, True)]
            if any(p is not None for p in pair):
                rows.append((label, pair[0], pair[1]))
    with styled():
        figure = new_figure(4.7 if narrow else 9.0, 1.1 + 0.42 * len(rows))
        axes = figure.add_subplot()
        places = -np.arange(len(rows), dtype=float) - np.where(np.arange(len(rows)) >= split, 0.6, 0.0)
        largest = max(v for _, a, b in rows for v in (a, b) if v is not None)
        axes.axvspan(0.9, AT_FLOOR, color="#e3f1ec", zorder=0)
        axes.axvline(1.0, color="#00795c", linewidth=1.2, zorder=1)
        for place, (_, fitted, held) in zip(places, rows, strict=True):
            for value, shift, colour, height in ((fitted, 0.17, "#b9c1cb", 0.26), (held, -0.14, _HELD, 0.36)):
                if value is None:
                    continue
                above = not is_at_floor(value) and colour == _HELD
                words = "held-out runs" if colour == _HELD else "fitted runs"
                axes.barh(place + shift, value, height, color=UPLIFT if above else colour, zorder=2, label=words)
                axes.text(
                    value * 1.03,
                    place + shift,
                    f"{value:.2f}" if value < 10 else f"{value:.0f}",
                    va="center",
                    fontsize=8.5 if colour == _HELD else 7.5,
                    color=INK if colour == _HELD else MUTED,
                )
        axes.set_yticks(places, [fill(r[0], 16) if narrow else r[0] for r in rows])
        axes.set_ylim(places[-1] - 0.6, places[0] + 0.6)
        axes.set_xscale("log")
        axes.set_xlim(0.5, max(2.0, largest) * 1.5)
        ticks = [t for t in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= max(2.0, largest) * 1.5]
        axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
        axes.minorticks_off()
        axes.set_xlabel(
            "error in noise floors" if narrow else "error in multiples of the noise floor (1 = only noise is left)"
        )
        axes.grid(False, axis="y")
        if found.system:
            for start, words in (
                (0, "laws fed with what was measured"),
                (split, "replay from the measured table motion"),
            ):
                axes.text(
                    0.995,
                    places[start] + 0.46,
                    words,
                    transform=axes.get_yaxis_transform(),
                    ha="right",
                    va="bottom",
                    fontsize=8.0,
                    color=MUTED,
                )
        handles = [Patch(color=c) for c in ("#b9c1cb", _HELD, UPLIFT)]
        words = ["fitted runs", "held-out runs", "held out, above the floor"]
        figure.legend(handles, words, loc="outside upper right", ncols=2 if narrow else 3)
    return figure


def histories_figure(found: Comparison) -> Figure:
    """Draw measured channels with what the model makes of them over it, and their difference below."""
    place = shown_run(found)
    run = found.base.objective.run(place)
    series: list[tuple[str, str, Array, Array]] = []
    if found.system:
        one = found.system.runs[place]
        names = [n for n in ("slip_x", "girder_ax", "girder_az", "pad_A_N") if n in one.simulated]
        series = [(n, f"{n} [{shown_unit(n)}]", one.measured[n], one.simulated[n]) for n in names]
        forces = [n for n in one.simulated if n.startswith("pad_") and n.endswith("_Fx")]
        if forces:
            total = [np.sum([s[n] for n in forces], axis=0) for s in (one.measured, one.simulated)]
            series.append((forces[0], "sum of pad friction [kN]", total[0], total[1]))
    else:
        name = f"pad_{run.pads[0]}_Fx"
        measured, said = pair_forces(run, found.base.solution.residuals, place)
        series = [(name, f"{_force_name(run)} [{shown_unit(name)}]", measured[:, 0], said[:, 0])]
    with styled():
        figure = new_figure(10.0, 1.9 * len(series) + 0.6)
        rows = figure.subplots(len(series), 1, sharex=True, squeeze=False)[:, 0]
        for axes, (name, label, measured, simulated) in zip(rows, series, strict=True):
            factor = _factor(name)
            both = np.isfinite(simulated)
            for values, colour, width, words in (
                (measured, _MEASURED, 1.6, "measured"),
                (np.where(both, simulated, np.nan), _MODEL, 0.9, "model"),
            ):
                axes.plot(*_thinned(run.time, values * factor), color=colour, linewidth=width, label=words)
            off = np.where(both, measured - simulated, 0.0) * factor
            low = float(np.nanmin(measured * factor)) - 0.25 * float(np.ptp(measured * factor))
            axes.plot(*_thinned(run.time, off + low), color=UPLIFT, linewidth=0.7, label="difference, moved down")
            axes.set_ylabel(label)
        rows[0].legend(loc="upper right", ncols=3)
        rows[-1].set_xlabel("time [s]")
    return figure


def loops_figure(found: Comparison) -> Figure:
    """Draw measured and predicted friction over slip, every pad as seen from above, and their sum."""
    place = shown_run(found)
    run = found.base.objective.run(place)
    measured, said = pair_forces(run, found.base.solution.residuals, place)
    part = widest_loop(run)
    with styled():
        if said.shape[1] == 1:
            figure = new_figure(8.0, 5.2)
            axes = figure.add_subplot()
            _loop(axes, run, measured[:, 0], said[:, 0], part)
            unit = _force_unit(measured)[1]
            if run.forces_measured:
                axes.set(title=f"Pad {run.pads[0]}", xlabel="slip x [mm]", ylabel=f"friction [{unit}]")
            else:
                axes.set(title="All bearings, from inertia", xlabel="slip x [mm]", ylabel=f"force [{unit}]")
            figure.legend(*axes.get_legend_handles_labels(), loc="outside upper right", ncols=2)  # loops fill the panel
            return figure
        figure = new_figure(11.0, 5.8)
        rig = run.states.specimen
        layout = layout_from_places(rig.pads, rig.pad_places)
        grid = figure.add_gridspec(layout.rows, 2 * layout.columns)
        panels = pad_panels(figure, grid, layout, layout.columns, ("slip x [mm]", "friction [kN]"))
        for i, pad in enumerate(run.pads):
            _loop(panels[pad], run, run.force[:, i], said[:, i], part)
        _loop(panels[SUM_PANEL], run, run.force.sum(axis=1), said.sum(axis=1), part)
        figure.legend(*panels[SUM_PANEL].get_legend_handles_labels(), loc="outside upper right", ncols=2)
    return figure


def _loop(axes: Axes, run: FitRun, measured: Array, said: Array, part: slice) -> None:
    factor = _force_unit(measured)[0]
    zero_lines(axes)
    slip = run.slip * 1e3
    axes.plot(slip, measured * factor, color="#c9d0d8", linewidth=0.6, rasterized=True)
    axes.plot(slip[part], measured[part] * factor, color=_MEASURED, linewidth=1.8, label="measured")
    axes.plot(slip[part], said[part] * factor, color=_MODEL, linewidth=1.1, label="law at measured N, v")


def _factor(name: str) -> float:
    known = channel(name)
    return 1.0 / parse_unit(known.shown_in, known.unit, name)


def _force_unit(force: Array) -> tuple[float, str]:
    return (1e-3, "kN") if float(np.abs(force).max()) > 100.0 else (1.0, "N")


def _force_name(run: FitRun) -> str:
    return f"pad_{run.pads[0]}_Fx" if run.forces_measured else "force of all bearings"


def widest_loop(run: FitRun) -> slice:
    """Find two seconds, or the longest there is, round the largest slip: a loop that the eye can follow."""
    peak = int(np.argmax(np.abs(run.slip - np.median(run.slip))))
    turns = np.flatnonzero(np.signbit(run.velocity[1:]) != np.signbit(run.velocity[:-1])) + 1
    ways = np.abs(np.diff(run.slip[turns])) if len(turns) > 1 else np.zeros(0)
    large = turns[:-1][ways > 0.3 * ways.max()] if len(ways) else turns
    before, after = large[large <= peak][-2:], large[large > peak][:2]
    start = int(before[0]) if len(before) else max(peak - 500, 0)
    end = int(after[-1]) + 1 if len(after) else min(peak + 500, len(run.slip))
    return slice(start, end)


def _thinned(time: Array, values: Array) -> tuple[Array, Array]:
    known = np.isfinite(values)
    return envelope(time[known], values[known], 700) if known.any() else (time[:0], values[:0])
