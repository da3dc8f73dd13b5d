"""Pictures of a law: the data, the curve of the screen with its band, and the forms over it."""

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.form import Form
from slipwise.discovery.law import Law
from slipwise.discovery.law_objective import STRENGTH
from slipwise.discovery.matching import product_at
from slipwise.estimation.intervals import compute_halfwidth
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.discovery_samples import Cloud, candidate_cloud, law_cloud
from slipwise.view.figures.style import MODEL_COLOURS
from slipwise.view.words.discovery_words import height_axis, state_axis

#: Points of a curve.
_POINTS = 400
#: Shares of the samples between which a picture reaches [1].
_SEEN = (0.003, 0.997)
#: Where a second state is held while a curve over the first is drawn, as shares of the samples [1].
_HELD = (0.15, 0.5, 0.85)
_CLOUD, _CURVE, LAW = "#9aa5b1", MODEL_COLOURS[0], MODEL_COLOURS[5]
_TIED = (MODEL_COLOURS[2], MODEL_COLOURS[3], MODEL_COLOURS[4], MODEL_COLOURS[1])
#: A form that is drawn: its name, its factors, its constants.
_Drawn = tuple[str, tuple[Form, ...], Mapping[str, float]]
_LEVELS = (MODEL_COLOURS[2], LAW, MODEL_COLOURS[3])


def law_figure(law: Law) -> Figure:
    """Draw a law over its data, one panel for each of its states."""
    candidate = law.fitted.law.match.candidate
    forms: list[_Drawn] = [(law.form, law.fitted.law.match.forms, law.fitted.values)]
    forms += [(name, tied.forms, tied.values) for name, tied in zip(law.tied, law.tied_forms, strict=True)]
    return _figure(law_cloud(law), candidate, forms)


def candidate_figure(candidate: CurveCandidate) -> Figure:
    """Draw the curve of the joint system over its data, where no form is called a law."""
    return _figure(candidate_cloud(candidate), candidate, [])


def _figure(cloud: Cloud, candidate: CurveCandidate, forms: Sequence[_Drawn]) -> Figure:
    count = len(candidate.states)
    figure = new_figure(8.6 if count == 1 else 10.6, 4.6)
    panels = figure.subplots(1, count, sharey=True, squeeze=False)[0]
    thin = cloud.thinned()
    for place, (axes, state) in enumerate(zip(panels, candidate.states, strict=True)):
        values = cloud.states[place]
        label, factor = state_axis(state.name, float(np.abs(values).max()))
        axes.scatter(
            factor * thin.states[place], thin.height, s=4.0, color=_CLOUD, alpha=0.55, linewidths=0.0, rasterized=True,
            label="measured, one sample each",
        )  # fmt: skip
        over = np.linspace(float(values.min()), float(values.max()), _POINTS)
        if count == 1:
            _one(axes, cloud, over, factor, forms)
        else:
            _slices(axes, cloud, over, factor, forms, place, candidate)
        axes.set_xlabel(label)
        axes.axhline(0.0, color=mpl.rcParams["axes.edgecolor"], lw=0.8, zorder=1)
    drawn = [line.get_ydata() for axes in panels for line in axes.lines if len(np.atleast_1d(line.get_ydata())) > 2]
    ends = np.concatenate([np.quantile(cloud.height, _SEEN), *(np.asarray(y, dtype=float) for y in drawn)])
    low, high = float(ends.min()), float(ends.max())
    panels[0].set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
    panels[0].set_ylabel(height_axis(candidate.port.name))
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper left", ncols=3, markerscale=2.5)
    return figure


def _one(axes: Axes, cloud: Cloud, over: Array, factor: float, forms: Sequence[tuple]) -> None:
    knots, (curve, band) = cloud.curve.knots, _curve(cloud, [over])
    axes.fill_between(factor * over, curve - band, curve + band, color=_CURVE, alpha=0.3, lw=0.0, label="its 95 % band")
    axes.plot(factor * over, curve, color=_CURVE, alpha=0.7, lw=4.0, label="curve without a form")
    shown = np.interp(knots[0], over, curve)
    if len(knots[0]) <= 15:
        axes.plot(factor * knots[0], shown, "o", color=_CURVE, ms=6.0)
    for number, (name, form, values) in enumerate(forms):
        height = values[STRENGTH] * product_at(form, [over], values)
        if number == 0:
            axes.plot(factor * over, height, color=LAW, lw=1.7, label=f"the form {name}")
        else:
            colour = _TIED[(number - 1) % len(_TIED)]
            axes.plot(factor * over, height, color=colour, lw=1.6, ls="--", label=f"not told from it: {name}")


def _slices(
    axes: Axes, cloud: Cloud, over: Array, factor: float, forms: Sequence[tuple], place: int, candidate: CurveCandidate
) -> None:
    """Draw curves over one of two states, the other held where a few, half and most of the samples lie."""
    other = cloud.states[1 - place]
    words, other_factor = state_axis(candidate.states[1 - place].name, float(np.abs(other).max()))
    for held, colour in zip(np.quantile(other, _HELD), _LEVELS, strict=True):
        states = [over, np.full_like(over, held)] if place == 0 else [np.full_like(over, held), over]
        curve, band = _curve(cloud, states)
        axes.fill_between(factor * over, curve - band, curve + band, color=colour, alpha=0.2, lw=0.0)
        axes.plot(factor * over, curve, color=colour, lw=1.0)
        for number, (_, form, values) in enumerate(forms):
            height = values[STRENGTH] * product_at(form, states, values)
            axes.plot(factor * over, height, color=colour, lw=2.4 if number == 0 else 1.4, ls="--" if number else "-")
        quantity, _, unit = words.rstrip("]").partition(" [")
        axes.plot([], [], color=colour, lw=2.0, label=f"{quantity} {other_factor * held:.3g} {unit}")
    axes.legend(title="at", fontsize=8.0, title_fontsize=8.0)


def _curve(cloud: Cloud, states: Sequence[Array]) -> tuple[Array, Array]:
    """Return the curve of straight pieces at states (m,), and the half width of its band."""
    at = cloud.curve.splines.evaluate
    return at(cloud.curve.heights(), states), compute_halfwidth(1.0) * at(cloud.curve.errors(), states)
