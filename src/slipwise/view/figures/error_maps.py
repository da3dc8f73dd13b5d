"""Figures of where a model errs: by state of motion, over slip and velocity, and mu(P, V) as fitted."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from slipwise.comparison.component_level import NAMES
from slipwise.comparison.motion_states import STATES
from slipwise.comparison.patterns import Pattern
from slipwise.comparison.result import Comparison
from slipwise.comparison.sentences import UNITS
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import INK, MUTED, styled

_STATES_CALLED = {
    "since reversal": "way since the last reversal",
    "path": "slid path of the campaign",
    "time": "time in run",
}
_PLUS, _MINUS = "#0072b2", "#d55e00"


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
        axes.imshow(np.clip(values, 1.0, top), cmap="magma_r", norm=LogNorm(1.0, top**1.35), aspect="auto")
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
    """Draw the mean residual of a relation over every state of motion that has samples, both directions apart.

    The state that explains most comes first; bins with too few independent samples for an error are hollow.
    """
    own = [p for p in found.patterns if p.relation == relation and np.isfinite([p.plus, p.minus, *p.few]).any()]
    own.sort(key=lambda p: (-p.explained, -_largest(p)))
    with styled():
        height = 2.7 * int(np.ceil(len(own) / 3)) + 0.3
        figure = new_figure(10.5, height)
        panels = figure.subplots(int(np.ceil(len(own) / 3)), 3, squeeze=False, sharey=True).ravel()
        for axes, pattern in zip(panels, own, strict=False):
            _pattern(axes, pattern)
        for axes in panels[len(own) :]:
            axes.set_axis_off()
        marks = [Line2D([], [], color=c, marker="o", markersize=4.0) for c in (_PLUS, _MINUS)]
        hollow = Line2D([], [], color=MUTED, marker="o", markersize=4.0, markerfacecolor="white", linestyle="none")
        words = ("sliding to +x", "sliding to −x", "too few independent samples")
        figure.legend([*marks, hollow], words, loc="outside upper right", ncols=3, fontsize=8.0)
        for axes in panels[::3]:
            axes.set_ylabel("mean residual [floors]")
    return figure


def plane_figure(found: Comparison, relation: str) -> Figure:
    """Draw a relation's error over slip and velocity of the runs: where in the motion it is large."""
    blocks = found.base.solution.residuals.blocks(relation)
    runs = [found.base.objective.run(of.run) for of in blocks]
    slip = np.concatenate([r.slip for r in runs]) * 1e3
    speed = np.concatenate([r.velocity for r in runs]) * 1e2
    squares = np.concatenate([(of.columns**2).sum(axis=1) for of in blocks])
    counts = np.concatenate([of.mask.reshape(of.columns.shape).sum(axis=1) for of in blocks]).astype(float)
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


def shown_relations(found: Comparison, most: int = 3) -> Sequence[str]:
    """Return the relations whose patterns are worth a picture: those with a place above the floor, else the first."""
    worst = [p.relation for p in found.places][:most]
    return worst or found.relations[:1]


def _pattern(axes: Axes, pattern: Pattern) -> None:
    unit, factor = UNITS[pattern.kind]
    middle = factor * 0.5 * (pattern.edges[1:] + pattern.edges[:-1])
    axes.axhspan(-1.0, 1.0, color="#eef1f4", zorder=0)
    axes.axhline(0.0, color="#b8c0cb", linewidth=0.8)
    for mean, error, few, colour, words in (
        (pattern.plus, pattern.plus_error, pattern.few[0], _PLUS, "sliding to +x"),
        (pattern.minus, pattern.minus_error, pattern.few[1], _MINUS, "sliding to −x"),
    ):
        axes.plot(
            middle, few, color=colour, marker="o", markersize=3.5, markerfacecolor="white", linewidth=0.6,
            linestyle=":", label=f"{words}, few independent samples",
        )  # fmt: skip
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
    axes.set_title(_explains(pattern), fontsize=9.0)


def _explains(pattern: Pattern) -> str:
    if pattern.explained >= 0.005:
        return f"explains {pattern.explained:.0%}"
    return "no more than noise would" if np.isfinite([pattern.plus, pattern.minus]).any() else "too few to judge"


def _largest(pattern: Pattern) -> float:
    """Return the largest mean residual of any bin [floors]."""
    return float(np.nanmax(np.abs([pattern.plus, pattern.minus, *pattern.few])))
