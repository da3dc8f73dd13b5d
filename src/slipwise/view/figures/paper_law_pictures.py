"""Pictures of the paper's law and claims: friction, identification, the map of one degree of freedom, scatter."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import EXPECTED, MODEL_COLOURS, MUTED, PAD_COLOURS, SUM, UPLIFT, styled


def law_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw eq. (8) and what rocking leaves in the sum."""
    with styled():
        figure = new_figure(11.0, 3.8)
        left, right = figure.subplots(1, 2)
        shades = ("#b9d7ea", "#8ebfdd", "#5aa3cd", "#2a85ba", "#005a8f")
        for colour, (name, mu) in zip(shades, curves["mu"].items(), strict=True):
            left.plot(curves["pressure"] / 1e6, mu, color=colour, linewidth=1.8, label=name)
        left.axvline(curves["rated"] / 1e6, color=EXPECTED, linewidth=1.0)
        left.set(title="Coefficient of friction, eq. (8)", xlabel="pressure P [MPa]", ylabel="mu", ylim=(0.0, None))
        left.legend(title="slip speed")
        right.plot(curves["swing"] * 100, curves["leftover"] * 100, color=SUM, linewidth=2.0)
        for swing, words in ((20.0, "0.8 % at ±20 %"), (60.0, "7.5 % at ±10 MPa"), (100.0, "24 % at uplift")):
            height = float(np.interp(swing, curves["swing"] * 100, curves["leftover"] * 100))
            right.plot(swing, height, "o", color=UPLIFT)
            place = {"xytext": (-8, 8), "ha": "right"} if swing > 30.0 else {"xytext": (-12, 14), "ha": "center"}
            right.annotate(words, (swing, height), textcoords="offset points", color=MUTED, **place)
        right.set(title="What rocking takes from the sum", xlabel="swing of load [%]", ylabel="lost [%]", ylim=(-1, 27))
    return figure


def identification_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw Figs. 12 and 13 and the worth of a swing."""
    time = curves["time"]
    inside = time <= time[0] + 1.5
    with styled():
        figure = new_figure(11.0, 6.6)
        grid = figure.add_gridspec(2, 6)
        pressure = figure.add_subplot(grid[0, :3])
        pressure.plot(time[inside], curves["pressure"][inside] / 1e6, color=PAD_COLOURS["C"], linewidth=1.5)
        for level in (5.0, 25.0):
            pressure.axhline(level, color=UPLIFT, linewidth=1.0, linestyle="--")
        pressure.set(title="Pressure at pad C (Fig. 12)", ylabel="P [MPa]", xlabel="time [s]", ylim=(0, 28))
        speed = figure.add_subplot(grid[0, 3:])
        speed.plot(time[inside], curves["speed"][inside] * 100, color=PAD_COLOURS["C"], linewidth=1.5)
        speed.set(title="Velocity (Fig. 12)", ylabel="v [cm/s]", xlabel="time [s]")
        left: Axes | None = None
        for column, (name, title, colour) in enumerate(
            (("measured", "Simulated, noisy (Fig. 13)", PAD_COLOURS["C"]), ("predicted", "Eq. (7) as identified", SUM))
        ):
            loop = figure.add_subplot(grid[1, 2 * column : 2 * column + 2], sharex=left, sharey=left)
            left = left or loop
            if column == 0:
                loop.set_ylabel("F of pad C [kN]")
            loop.plot(curves["slip"] * 1e3, curves[name] / 1e3, color=colour, linewidth=0.6)
            loop.set(title=title, xlabel="slip [mm]")
        worth = figure.add_subplot(grid[1, 4:])
        swings = [100 * row["swing"] for row in curves["swings"]]
        for colour, name in zip(MODEL_COLOURS, ("s'", "n", "k", "alpha"), strict=False):
            worth.plot(swings, [100 * r[name] for r in curves["swings"]], "o-", color=colour, label=name, linewidth=1.6)
        worth.set(
            title="How well each is known", xlabel="swing of load [%]", ylabel="standard deviation [%]", ylim=(0, None)
        )
        worth.legend()
    return figure


def map_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw where one degree of freedom stops being enough, and for how long a pad is off."""
    grid = curves["map"]
    with styled():
        figure = new_figure(11.0, 4.2)
        for axes, (name, title, factor, form) in zip(
            figure.subplots(1, 2),
            (("error", "Error of slip of one d.o.f. [% of its range]", 100.0, "{:.1f}"),
             ("uplift", "Time with a pad off [s]", 1.0, "{:.2f}")),
            strict=True,
        ):  # fmt: skip
            values = grid[name] * factor
            axes.imshow(
                values, origin="lower", aspect="auto", cmap="YlOrRd", vmin=0.0, vmax=max(np.nanmax(values), 1e-3) * 1.6
            )
            for (i, j), value in np.ndenumerate(values):
                words = form.format(value) if np.isfinite(value) else "diverged"
                axes.text(j, i, words, ha="center", va="center", fontsize=10)
            axes.set_xticks(range(len(grid["slenderness"])), [f"{h:.3f}" for h in grid["slenderness"]])
            axes.set_yticks(range(len(grid["scale"])), [f"{100 * s:.0f} %" for s in grid["scale"]])
            axes.set(title=title, xlabel="h/b", ylabel="vertical motion, of the tests'")
            axes.grid(visible=False)
    return figure


def claims_figure(curves: Mapping[str, Any]) -> Figure:
    """Draw how the largest slip changes by rocking, vertical motion and 500 % of it."""
    rows = (
        ("slip", "rocking", PAD_COLOURS["A"]),
        ("slip_tests", "vertical motion\nof the tests", PAD_COLOURS["C"]),
        ("slip_extreme", "500 % of it", PAD_COLOURS["B"]),
    )
    with styled():
        figure = new_figure(11.0, 3.2)
        axes = figure.subplots()
        for place, (name, _, colour) in enumerate(rows):
            change = 100.0 * (np.sort(curves[name]) - 1.0)
            # Spread the points of a row by their rank, so that a crowd can be seen; no random numbers.
            shift = 0.28 * np.sin(2.399963 * np.arange(len(change)))
            axes.plot(change, place + shift, ".", color=colour, alpha=0.55)
            axes.plot([np.median(change)] * 2, [place - 0.36, place + 0.36], color=SUM, linewidth=2.0)
        axes.axvline(0.0, color=EXPECTED, linewidth=1.2, zorder=1)
        axes.set_yticks(range(len(rows)), [row[1] for row in rows])
        axes.set(title="Change of the largest slip, one point a motion, line at the median", xlabel="%")
        axes.invert_yaxis()
    return figure
