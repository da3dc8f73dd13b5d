"""The picture of a plan: effects by sets of gauges, shaded by the chance to name each."""

import numpy as np
from matplotlib.figure import Figure

from slipwise.planning.result import PlannedTest
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import INK, styled
from slipwise.view.words.plan_tables import list_matrix_rows

#: Shade from which figures in a cell are white [%].
_DARK = 55


def chances_figure(found: PlannedTest, *, narrow: bool = False) -> Figure:
    """Draw effects by sets of gauges; what a set cannot show is left blank.

    Args:
        found: a plan with chances.
        narrow: for a phone.
    """
    rows = list_matrix_rows(found)
    letters = [key for key in (rows[0] if rows else {}) if key != "effect"]
    shares = np.array([[np.nan if row[k] == "-" else row[k] for k in letters] for row in rows], float)
    with styled():
        figure = new_figure(3.6 if narrow else 9.0, 1.0 + 0.27 * max(len(rows), 1))
        axes = figure.subplots()
        axes.imshow(np.ma.masked_invalid(shares), cmap="Blues", vmin=0.0, vmax=110.0, aspect="auto")
        for (i, j), value in np.ndenumerate(shares):
            words, colour = ("-", INK) if np.isnan(value) else (f"{value:.0f}", "white" if value > _DARK else INK)
            axes.text(j, i, words, ha="center", va="center", color=colour, fontsize=8)
        axes.set_xticks(range(len(letters)), letters)
        axes.set_yticks(range(len(rows)), [row["effect"] for row in rows])
        axes.tick_params(length=0, labeltop=True, labelbottom=False)
        axes.grid(False)
        for spine in axes.spines.values():
            spine.set_visible(False)
        axes.set_xlabel("chance to name [%]" if narrow else "set of gauges; chance to name [%]")
    return figure
