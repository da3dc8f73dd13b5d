"""Why not this effect: what it leaves where the measurement contradicts it most, beside what was named."""

import numpy as np
from matplotlib.figure import Figure

from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.why_not import Instant, WhyNot
from slipwise.selection.hypothesis import Hypothesis
from slipwise.units import convert
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.diagnosis_figures import under_axis
from slipwise.view.figures.panels import AFTER, BEFORE, error_bars, stacked_panels
from slipwise.view.figures.style import EXPECTED, INK
from slipwise.view.words.numbers import usual_unit

#: Of the stretch that contradicts, so many lengths are drawn on either side of it.
_BESIDE = 3.0
#: Inches across which a figure has on a desk, and on a phone.
_WIDE, _NARROW = 8.0, 4.7


def why_not_figure(found: WhyNot, *, narrow: bool = False) -> Figure | None:
    """Draw what an effect leaves, over time where it is contradicted most; by balance where nothing contradicts it.

    Args:
        found: why it was not named.
        narrow: for a phone.

    Returns:
        None where there is nothing to draw.
    """
    if found.shown is None:
        return None
    if found.instants:
        return _instant_figure(found, found.instants[0], *found.shown, narrow=narrow)
    return _balances_figure(found, narrow=narrow)


def _balances_figure(found: WhyNot, *, narrow: bool) -> Figure:
    """Draw the error of every balance without the effect and with it."""
    figure = new_figure(_NARROW if narrow else _WIDE, 3.2)
    axes = figure.subplots()
    worst: dict[str, tuple[float, float]] = {}
    for e in found.errors:
        if (e.role == "holdout") == found.unseen:
            before, after = worst.get(e.relation, (0.0, 0.0))
            worst[e.relation] = max(before, e.named), max(after, e.instead)
    without = f"with {found.replaced}" if found.replaced else "without it"
    places = error_bars(axes, list(worst.values()), (without, f"with {found.effect}"))
    axes.set_xticks(places, [under_axis(r) for r in worst], rotation=90 if narrow else 0, fontsize=8.0)
    axes.set_ylabel("error of the worst run / floor")
    figure.legend(loc="outside upper right", ncols=1 if narrow else 3)
    return figure


def _instant_figure(found: WhyNot, at: Instant, named: Hypothesis, instead: Hypothesis, *, narrow: bool) -> Figure:
    mine, theirs = (h.solution.residuals.block(at.relation, at.place) for h in (named, instead))
    run = named.objective.run(at.place)
    reach = _BESIDE * (at.end - at.start)
    shown = (mine.time >= at.start - reach) & (mine.time <= at.end + reach)
    time = mine.time[shown]
    si = NAMES[at.relation][1]
    unit = usual_unit(si)
    factor = convert(1.0, si, unit)
    figure = new_figure(_NARROW if narrow else _WIDE, 5.2 if narrow else 4.8)
    [[top], [below]] = stacked_panels(figure, 2, sharex=True)
    noise = factor * mine.noise.reshape(len(mine.time), -1)[shown, at.column]
    top.fill_between(time, -2.0 * noise, 2.0 * noise, color=EXPECTED, lw=0.0, label="two standard deviations of noise")
    for block, colour, label in ((theirs, BEFORE, found.effect), (mine, AFTER, found.replaced)):
        left = factor * (block.columns * block.noise.reshape(len(block.time), -1))[shown, at.column]
        judged = block.mask.reshape(len(block.time), -1)[shown, at.column]
        top.plot(time, np.where(judged, left, np.nan), color=colour, lw=1.3, label=f"left with {label}")
    what = NAMES[at.relation][0] + (f" of pad {at.pad}" if at.pad else "")
    top.set_ylabel(f"measured less model [{unit}]" if unit != "1" else "measured less model")
    top.set_title(f"{what}, {at.run}")
    figure.legend(*top.get_legend_handles_labels(), loc="upper right", ncols=1 if narrow else 3)
    below.plot(time, 1e3 * run.velocity[shown], color=INK, lw=1.1)
    below.set_ylabel("slip velocity [mm/s]")
    below.set_xlabel("time [s]")
    for axes in (top, below):
        axes.axhline(0.0, color=INK, lw=0.6)
        axes.axvspan(at.start, at.end, color=BEFORE, alpha=0.12, lw=0.0)
    below.set_xlim(float(time[0]), float(time[-1]))
    return figure
