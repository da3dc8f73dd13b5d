"""Figures of a comparison: errors over the floor, overlaid histories and loops, where the error is, and mu(P, V)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from slipwise.channels import channel
from slipwise.compare import Comparison
from slipwise.compare.cells import ALLOWANCE
from slipwise.compare.component import NAMES
from slipwise.compare.motion_states import STATES
from slipwise.compare.patterns import Pattern
from slipwise.compare.words import UNITS
from slipwise.fit.data import FitRun
from slipwise.units import parse_unit
from slipwise.view.canvas import new_figure
from slipwise.view.style import INK, MUTED, PAD_COLOURS, PAD_PANELS, PAD_PLACES, UPLIFT, envelope, shown_unit, styled

Array = NDArray[np.float64]
_MEASURED, _MODEL, _HELD = INK, "#e69f00", "#0072b2"
_STATES_CALLED = {
    "since reversal": "way since the last reversal",
    "path": "slid path of the campaign",
    "time": "time in run",
}
_PLUS, _MINUS = "#0072b2", "#d55e00"


def shown_run(found: Comparison) -> int:
    """Give the place of the run that pictures show: the first held out, else the last."""
    held = found.base.problem.held_out
    return held[0] if held else len(found.base.problem.runs) - 1


def errors_figure(found: Comparison) -> Figure:
    """Draw every component's and channel's error in multiples of its floor, fitted and held-out runs apart."""
    rows: list[tuple[str, float | None, float | None]] = [
        (NAMES[r][0], found.error(r, held_out=False), found.error(r, held_out=True)) for r in found.relations
    ]
    split = len(rows)
    if found.system:
        from slipwise.compare.system_level import pooled_system

        for name, label in (
            ("slip_x", "slip"),
            ("girder_ax", "girder a x"),
            ("girder_az", "girder a z"),
            ("pad_*_N", "pad loads N"),
            ("pad_*_Fx", "pad friction F"),
        ):
            pair = [pooled_system(found.system.errors, name, held_out=h) for h in (False, True)]
            if any(p is not None for p in pair):
                rows.append((label, pair[0], pair[1]))
    with styled():
        figure = new_figure(9.0, 1.1 + 0.42 * len(rows))
        axes = figure.add_subplot()
        places = -np.arange(len(rows), dtype=float) - np.where(np.arange(len(rows)) >= split, 0.6, 0.0)
        largest = max(v for _, a, b in rows for v in (a, b) if v is not None)
        axes.axvspan(0.9, ALLOWANCE, color="#e3f1ec", zorder=0)
        axes.axvline(1.0, color="#00795c", linewidth=1.2, zorder=1)
        for place, (_, fitted, held) in zip(places, rows, strict=True):
            for value, shift, colour, height in ((fitted, 0.17, "#b9c1cb", 0.26), (held, -0.14, _HELD, 0.36)):
                if value is None:
                    continue
                above = value > ALLOWANCE and colour == _HELD
                axes.barh(place + shift, value, height=height, color=UPLIFT if above else colour, zorder=2)
                axes.text(
                    value * 1.03,
                    place + shift,
                    f"{value:.2f}" if value < 10 else f"{value:.0f}",
                    va="center",
                    fontsize=8.5 if colour == _HELD else 7.5,
                    color=INK if colour == _HELD else MUTED,
                )
        axes.set_yticks(places, [r[0] for r in rows])
        axes.set_ylim(places[-1] - 0.6, places[0] + 0.6)
        axes.set_xscale("log")
        axes.set_xlim(0.5, max(2.0, largest) * 1.5)
        ticks = [t for t in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= max(2.0, largest) * 1.5]
        axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
        axes.minorticks_off()
        axes.set_xlabel("error in multiples of the noise floor (1 = only noise is left)")
        axes.grid(False, axis="y")
        if found.system:
            for start, words in (
                (0, "component level: laws fed with what was measured"),
                (split, "system level: replay from the measured table motion"),
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
        figure.legend(handles, words, loc="outside upper right", ncols=3)
    return figure


def histories_figure(found: Comparison) -> Figure:
    """Draw measured channels with what the model makes of them over it, and their difference below."""
    place = shown_run(found)
    run = found.base.problem.runs[place]
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
        said = found.base.solution.residuals.pad_forces[place]
        series = [(name, f"{name} [{shown_unit(name)}]", run.force[:, 0], said[:, 0])]
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
    run = found.base.problem.runs[place]
    said = found.base.solution.residuals.pad_forces[place]
    part = _widest(run)
    with styled():
        if len(run.pads) == 1:
            figure = new_figure(8.0, 5.2)
            axes = figure.add_subplot()
            _loop(axes, run, run.force[:, 0], said[:, 0], part)
            axes.set(title=f"Pad {run.pads[0]}", xlabel="slip x [mm]", ylabel=f"friction [{_force_unit(run)[1]}]")
            axes.legend(loc="lower right")
            return figure
        figure = new_figure(11.0, 5.8)
        grid = figure.add_gridspec(2, 4)
        first: Axes | None = None
        for i, pad in enumerate(run.pads):
            row, column = PAD_PANELS[pad]
            axes = figure.add_subplot(grid[row, column], sharex=first, sharey=first)
            first = first or axes
            axes.set_title(f"Pad {pad} ({PAD_PLACES[pad]})", color=PAD_COLOURS[pad])
            _loop(axes, run, run.force[:, i], said[:, i], part)
            if row == 1:
                axes.set_xlabel("slip x [mm]")
            if column == 0:
                axes.set_ylabel("friction [kN]")
        axes = figure.add_subplot(grid[:, 2:])
        _loop(axes, run, run.force.sum(axis=1), said.sum(axis=1), part)
        axes.set(title="Sum of the pads", xlabel="slip x [mm]", ylabel="friction [kN]")
        axes.legend(loc="lower right")
    return figure


def map_figure(found: Comparison) -> Figure:
    """Draw every relation's error by state of motion, in floors: the colour begins where noise alone would end."""
    relations = [r for r in found.relations if any(c.relation == r for c in found.cells)]
    values = np.full((len(relations), len(STATES)), np.nan)
    above = np.zeros(values.shape, dtype=bool)
    for cell in found.cells:
        if cell.kind == "state" and cell.relation in relations:
            here = relations.index(cell.relation), STATES.index(cell.label)
            values[here], above[here] = cell.error, cell.above
    with styled():
        figure = new_figure(9.5, 1.2 + 0.45 * len(relations))
        axes = figure.add_subplot()
        top = max(3.0, float(np.nanmax(values)))
        axes.imshow(np.log(np.clip(values, 1.0, top)), cmap="magma_r", vmin=0.0, vmax=1.35 * np.log(top), aspect="auto")
        for (i, j), value in np.ndenumerate(values):
            if np.isfinite(value):
                dark = np.log(max(value, 1.0)) > 0.7 * np.log(top)
                axes.text(
                    j,
                    i,
                    f"{value:.3g}" if value >= 10 else f"{value:.2f}",
                    ha="center",
                    va="center",
                    color="white" if dark else INK,
                    fontweight="bold" if above[i, j] else "normal",
                )
            else:
                axes.text(j, i, "not judged", ha="center", va="center", fontsize=7.5, color=MUTED)
        axes.set_xticks(range(len(STATES)), STATES)
        axes.set_yticks(range(len(relations)), [NAMES[r][0] for r in relations])
        axes.tick_params(length=0, labeltop=True, labelbottom=False)
        axes.grid(False)
    return figure


def patterns_figure(found: Comparison, relation: str) -> Figure:
    """Draw the mean residual of a relation over every state of motion, both directions apart."""
    own = [p for p in found.patterns if p.relation == relation]
    with styled():
        height = 2.7 * int(np.ceil(len(own) / 3)) + 0.3
        figure = new_figure(10.5, height)
        panels = figure.subplots(int(np.ceil(len(own) / 3)), 3, squeeze=False, sharey=True).ravel()
        for axes, pattern in zip(panels, own, strict=False):
            _pattern(axes, pattern)
        for axes in panels[len(own) :]:
            axes.set_axis_off()
        panels[0].legend(loc="best", fontsize=8.0)
        for axes in panels[::3]:
            axes.set_ylabel("mean residual [floors]")
    return figure


def plane_figure(found: Comparison, relation: str) -> Figure:
    """Draw a relation's error over slip and velocity of the runs: where in the motion it is large."""
    runs = found.base.problem.runs
    slip = np.concatenate([r.slip for r in runs]) * 1e3
    speed = np.concatenate([r.velocity for r in runs]) * 1e2
    parts = [p if p.ndim == 2 else p[:, None] for p in found.residuals[relation]]
    squares = np.concatenate([(p**2).sum(axis=1) for p in parts])
    counts = np.concatenate([(p != 0.0).sum(axis=1) for p in parts]).astype(float)
    reach = [np.quantile(np.abs(v), 0.998) * 1.05 for v in (slip, speed)]
    edges = [np.linspace(-r, r, n) for r, n in zip(reach, (45, 37), strict=True)]
    total = np.histogram2d(slip, speed, bins=edges, weights=squares)[0]
    number = np.histogram2d(slip, speed, bins=edges, weights=counts)[0]
    error = np.sqrt(np.divide(total, number, out=np.full_like(total, np.nan), where=number > 0.0))
    with styled():
        figure = new_figure(8.0, 4.6)
        axes = figure.add_subplot()
        top = max(3.0, float(np.nanquantile(error, 0.99)))
        drawn = axes.pcolormesh(*edges, error.T, cmap="magma_r", vmin=1.0, vmax=top, rasterized=True)
        figure.colorbar(drawn, ax=axes, label="error [floors]", extend="both")
        axes.set(xlabel="slip x [mm]", ylabel="velocity [cm/s]")
        axes.grid(False)
    return figure


def surface_figure(found: Comparison) -> Figure:
    """Draw mu over speed for some pressures, with the band that the fitted numbers leave."""
    own = found.surface
    assert own is not None
    with styled():
        figure = new_figure(8.0, 4.0)
        axes = figure.add_subplot()
        chosen = np.unique(np.linspace(0, len(own.pressure) - 1, 4).round().astype(int))
        for rank, i in enumerate(chosen):
            colour = ("#56b4e9", "#0072b2", "#009e73", "#1b2733")[rank]
            axes.plot(own.speed * 1e2, own.friction[i], color=colour, label=f"{own.pressure[i] / 1e6:.3g} MPa")
            band = 2.0 * own.deviation[i]
            axes.fill_between(own.speed * 1e2, own.friction[i] - band, own.friction[i] + band, color=colour, alpha=0.25)
        axes.set(xlabel="speed [cm/s]", ylabel="coefficient of friction F/N", ylim=(0.0, None))
        axes.legend(title="pressure", loc="lower right")
    return figure


def _pattern(axes: Axes, pattern: Pattern) -> None:
    unit, factor = UNITS[pattern.kind]
    middle = factor * 0.5 * (pattern.edges[1:] + pattern.edges[:-1])
    axes.axhspan(-1.0, 1.0, color="#eef1f4", zorder=0)
    axes.axhline(0.0, color="#b8c0cb", linewidth=0.8)
    for mean, error, colour, words in (
        (pattern.plus, pattern.plus_error, _PLUS, "sliding to +x"),
        (pattern.minus, pattern.minus_error, _MINUS, "sliding to −x"),
    ):
        axes.errorbar(
            middle,
            mean,
            yerr=2.0 * error,
            color=colour,
            marker="o",
            markersize=3.5,
            linewidth=1.2,
            capsize=2.0,
            label=words,
        )
    axes.set_xlabel(f"{_STATES_CALLED.get(pattern.kind, pattern.kind)} [{unit}]")
    axes.set_title(f"explains {pattern.explained:.0%}", fontsize=9.0)


def _loop(axes: Axes, run: FitRun, measured: Array, said: Array, part: slice) -> None:
    factor = _force_unit(run)[0]
    axes.axhline(0.0, color="#b8c0cb", linewidth=0.8, zorder=1)
    axes.axvline(0.0, color="#b8c0cb", linewidth=0.8, zorder=1)
    slip = run.slip * 1e3
    axes.plot(slip, measured * factor, color="#c9d0d8", linewidth=0.6, rasterized=True)
    axes.plot(slip[part], measured[part] * factor, color=_MEASURED, linewidth=1.8, label="measured")
    axes.plot(slip[part], said[part] * factor, color=_MODEL, linewidth=1.1, label="law at measured N, v")


def _factor(name: str) -> float:
    known = channel(name)
    return 1.0 / parse_unit(known.shown_in, known.unit, name)


def _force_unit(run: FitRun) -> tuple[float, str]:
    return (1e-3, "kN") if float(np.abs(run.force).max()) > 100.0 else (1.0, "N")


def _widest(run: FitRun) -> slice:
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


def shown_relations(found: Comparison, most: int = 3) -> Sequence[str]:
    """Give the relations whose patterns are worth a picture: those with a place above the floor, else the pads."""
    worst = [p.relation for p in found.places][:most]
    return worst or ["pads"]
