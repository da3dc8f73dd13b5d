"""Measured friction over load at every judged sample, against speed and against pressure, with the law through it."""

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.comparison.result import Comparison
from slipwise.relations.run_data import FitRun
from slipwise.residual_map.splines import choose_knots
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import MODEL_COLOURS
from slipwise.view.words.numbers import usual_unit

#: Points of a cloud in one colour, and bins over which the law is drawn.
_POINTS, _BINS = 1500, 25
#: A bin of fewer samples is left out; samples between these shares of all are in the picture.
_FEWEST, _SEEN = 8, (0.002, 0.998)
#: A variable that varies by less than this share of its size is one value: nothing is cut by it, or drawn over it [1].
_VARIES = 0.05
#: A pad that slides mostly across says little of the friction along [1].
_ALONG = 0.5
_COLOURS = (MODEL_COLOURS[1], MODEL_COLOURS[2], MODEL_COLOURS[4])


@dataclass(frozen=True)
class Friction:
    """Friction over load while sliding, of every pad at judged samples.

    Attributes:
        speed: (m,) [m/s].
        pressure: (m,) [Pa].
        measured: (m,) |F| / N [1].
        predicted: (m,) the same of the model [1].
    """

    speed: Array
    pressure: Array
    measured: Array
    predicted: Array


def friction(found: Comparison) -> Friction:
    """Return friction over load at the samples by which the pads are judged, of all runs."""
    objective, parts = found.base.objective, []
    residuals = found.base.solution.residuals
    for of in residuals.blocks("pads"):
        run = objective.run(of.run)
        speed, measured, predicted = coefficients(run, residuals.pad_forces[of.run])
        known = of.mask.reshape(speed.shape) & np.isfinite(measured) & np.isfinite(predicted)
        pressure = run.load / objective.specimen.pad_area
        parts.append(np.stack([each[known] for each in (speed, pressure, measured, predicted)]))
    return Friction(*(np.concatenate(parts, axis=1) if parts else np.zeros((4, 0))))


def coefficients(run: FitRun, said: Array) -> tuple[Array, Array, Array]:
    """Return slip speed [m/s], and friction over load [1] as measured and as predicted, of every pad, (n, p) each.

    Friction was recorded along x: |F| = |F_x| V / |v_x|. NaN where a pad carries nothing or slides mostly across.

    Args:
        run: as measured.
        said: (n, p) predicted force along x [N].
    """
    speed = np.hypot(*run.states.velocity.T)
    along = np.abs(run.velocity) / np.where(speed > 0.0, speed, np.inf)
    turned = np.where(along > _ALONG, along, np.nan)[:, None]
    load = np.where(run.load > 0.0, run.load, np.nan)
    shape = run.load.shape
    return np.broadcast_to(speed[:, None], shape), np.abs(run.force) / load / turned, np.abs(said) / load / turned


def clouds_figure(known: Friction) -> Figure:
    """Draw friction over load against speed and against pressure, the other one in three colours."""
    drawn = new_figure(10.6, 4.6)
    left, right = drawn.subplots(1, 2, sharey=True)
    axes_of = (("slip speed", "m/s", known.speed), ("pressure", "Pa", known.pressure))
    for axes, over, other in ((left, axes_of[0], axes_of[1]), (right, axes_of[1], axes_of[0])):
        _cloud(axes, known, over, other)
    lines = [np.asarray(line.get_ydata(), dtype=float) for axes in (left, right) for line in axes.lines]
    ends = np.concatenate([np.quantile(known.measured, _SEEN), *lines])
    low, high = float(ends.min()), float(ends.max())
    left.set_ylim(max(0.0, low - 0.15 * (high - low)), high + 0.15 * (high - low))
    left.set_ylabel("friction over load, |F| / N [1]")
    return drawn


def _cloud(axes: Axes, known: Friction, over: tuple[str, str, Array], other: tuple[str, str, Array]) -> None:
    words, unit, values = over
    factor = 1e3 if unit == "m/s" else 1e-6
    for label, chosen, colour in _classes(*other):
        at, measured, predicted = (x[chosen] for x in (values, known.measured, known.predicted))
        step = max(1, len(at) // _POINTS)
        axes.scatter(
            factor * at[::step], measured[::step], s=4.0, color=colour, alpha=0.35, linewidths=0.0, rasterized=True
        )
        if _varies(values):
            middles, law = binned_medians(at, predicted)
        else:
            middles, law = np.quantile(at, _SEEN), np.full(2, np.median(predicted))
        axes.plot(factor * middles, law, color=_ink(), lw=3.4, solid_capstyle="round")
        axes.plot(factor * middles, law, "o-", color=colour, lw=1.8, ms=2.0, label=label)
    axes.scatter([], [], s=14.0, color="#9aa5b1", label="measured, one sample each")
    axes.plot([], [], color=_ink(), lw=3.4, label="the model's law at the same samples")
    axes.set_xlim(*(factor * np.quantile(values, (0.0, _SEEN[1]))))
    axes.set_xlabel(f"{words} [{usual_unit(unit)}]")
    axes.set_title(f"over {words}")
    axes.legend(fontsize=8.0)


def _ink() -> str:
    return mpl.rcParams["text.color"]


def _classes(words: str, unit: str, values: Array) -> list[tuple[str, NDArray[np.bool_], str]]:
    """Cut samples into three by a variable: label, samples, colour; into one where it hardly varies."""
    factor, shown = (1e3 if unit == "m/s" else 1e-6), usual_unit(unit)
    if not _varies(values):
        return [(f"{words} {factor * np.median(values):.3g} {shown}", np.ones(len(values), dtype=bool), _COLOURS[1])]
    first, second = np.quantile(values, (1 / 3, 2 / 3))
    cuts = (
        (f"{words} below {factor * first:.3g} {shown}", values < first),
        (f"{factor * first:.3g} to {factor * second:.3g} {shown}", (values >= first) & (values < second)),
        (f"above {factor * second:.3g} {shown}", values >= second),
    )
    return [(label, chosen, colour) for (label, chosen), colour in zip(cuts, _COLOURS, strict=True) if chosen.any()]


def _varies(values: Array) -> bool:
    low, high = np.quantile(values, _SEEN)
    return bool(high - low >= _VARIES * abs(high))


def binned_medians(values: Array, heights: Array) -> tuple[Array, Array]:
    """Return medians of values and heights in bins that follow the samples and, where these are rare, the range."""
    edges = choose_knots(values, _BINS + 1)
    place = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, max(len(edges) - 2, 0))
    bins = [chosen for i in range(max(len(edges) - 1, 1)) if np.count_nonzero(chosen := place == i) >= _FEWEST]
    return np.array([np.median(values[b]) for b in bins]), np.array([np.median(heights[b]) for b in bins])
