"""The picture of a consequence: how often a peak slip is exceeded, with what was named and without it."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from slipwise.studies.consequence import Consequence
from slipwise.studies.consequence.result import OF_THE_SENTENCE
from slipwise.units import convert
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import INK, MODEL_COLOURS, MUTED, styled

#: Colours without and with what was named.
_WITHOUT, _WITH = MUTED, MODEL_COLOURS[4]


def consequence_figure(found: Consequence, *, narrow: bool = False) -> Figure:
    """Draw both distributions of the peak slip as the share of earthquakes that stays below, at the bridge's scale.

    Args:
        found: the result.
        narrow: for a phone.
    """
    one = found.distributions[0]
    unit, factor = one.response.shown_in, one.to_bridge
    with styled():
        figure = new_figure(4.6 if narrow else 8.2, 4.4)
        axes = figure.subplots()
        names = " and ".join(found.named)
        marks = []
        for values, colour, label, line in (
            (one.without, _WITHOUT, f"without {names}", (0, (5, 2))),
            (one.with_named, _WITH, f"with {names}", "-"),
        ):
            shown = np.sort(values) * convert(factor, one.response.unit, unit)
            share = np.linspace(0.0, 100.0, len(shown))  # as quantiles are counted: on straight lines between values
            axes.plot(shown, share, color=colour, linewidth=1.8, linestyle=line, label=label)
            marks.append((float(np.quantile(shown, OF_THE_SENTENCE)), colour))
        level = 100.0 * OF_THE_SENTENCE
        axes.axhline(level, color=INK, linewidth=0.6, linestyle=(0, (1, 2)))
        ordered = sorted(marks)
        for (value, colour), side in zip(ordered, ("right", "left"), strict=True):
            axes.plot([value, value], [0.0, level], color=colour, linewidth=0.8)
            axes.annotate(
                f"{value:.3g}", (value, level), ha=side, color=INK, fontsize=9.0, textcoords="offset points",
                xytext=(-4, 4) if side == "right" else (4, -12),
            )  # fmt: skip
        axes.set(ylim=(0.0, 102.0), ylabel="earthquakes below [%]", xlabel=f"peak slip of {found.what} [{unit}]")
        axes.set_xlim(left=0.0)
        if found.scaled:
            inside = axes.secondary_xaxis("top", functions=(_times(1.0 / factor), _times(factor)))
            inside.set_xlabel(f"of the model [{unit}]")
        figure.legend(loc="outside upper left", ncols=1 if narrow else 2)
    return figure


def _times(factor: float) -> Callable[[Any], Any]:
    return lambda values: factor * values
