"""Pictures of a diagnosis: the falling error, every balance before and after, pads' loops, and what is left."""

from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.ladder import Ladder, LadderStep
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.unknown_surface import ResidualSurface
from slipwise.relations.base_shear import pair_forces
from slipwise.residual_map.states import UNITS, WORDS
from slipwise.units import convert
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.panels import AFTER, BEFORE, error_bars
from slipwise.view.figures.style import EXPECTED, INK
from slipwise.view.words.numbers import in_words, usual_unit

#: Inches across which a figure has on a desk, and on a phone.
_WIDE, _NARROW = 8.0, 4.7
#: Letters of a line under an axis.
_LINE = 14
#: Letters that fit under the axes of a ladder.
_WIDEST = 95
#: Letters that fit over one of two panels.
_TITLE = 40
#: Where a ladder begins so many floors up, its last steps are told apart on a logarithmic axis only.
_FAR = 20.0
#: A missing force below this is drawn in its SI unit [N].
_SMALL = 1000.0


def under_axis(relation: str) -> str:
    """Write what a balance is called under an axis, in short lines."""
    return fill(NAMES[relation][0], _LINE)


def balances_figure(found: Diagnosis, *, narrow: bool = False) -> Figure:
    """Draw the error of every balance, before and after, in multiples of the floor; held-out where runs are."""
    figure = new_figure(_NARROW if narrow else _WIDE, 3.4)
    axes = figure.subplots()
    errors = [(before, after if found.added else None) for before, after in found.relations.values()]
    places = error_bars(axes, errors, ("base model", _with(found)))
    axes.set_xticks(places, [under_axis(n) for n in found.relations], rotation=90 if narrow else 0, fontsize=8.0)
    held = found.search.base.objective.held_out
    axes.set_ylabel(f"{'held-out error' if held else 'error on fitted runs'} / floor")
    figure.legend(loc="outside upper right", ncols=1 if narrow else 3)  # bars may fill the panel
    return figure


def _with(found: Diagnosis) -> str:
    """Name the final model: its effects, or how many they are where the names do not fit over a panel."""
    names = f"with {' and '.join(found.added)}"
    return names if len(names) <= _TITLE else f"with the {in_words(len(found.added))} effects that were found"


def step_errors(found: Ladder) -> dict[str, list[float]]:
    """Return what is known of the steps: runs -> error of every step in floors."""
    unseen = [r.holdout_error for r in found.steps]
    held = bool(np.isfinite(unseen).any())
    lines = {
        "fitted runs": [r.fit_error for r in found.steps],
        "held-out runs": unseen,
        "held-out, replay" if held else "replay": [r.system_holdout_error for r in found.steps],
    }
    return {label: values for label, values in lines.items() if np.isfinite(values).any()}


def ladder_figure(found: Ladder) -> Figure:
    """Draw the error step by step, fitted and held-out, component and system level, and why the ladder ends."""
    figure = new_figure(8.0, 3.9)
    axes = figure.subplots()
    places = np.arange(len(found.steps))
    looks = {"fitted runs": (EXPECTED, "o"), "held-out runs": (AFTER, "o")}
    errors = step_errors(found)
    for label, values in errors.items():
        colour, marker = looks.get(label, (BEFORE, "s"))
        known = np.isfinite(values)  # of a search only the ends are replayed
        axes.plot(places[known], np.array(values)[known], marker=marker, color=colour, label=label, lw=2.0)
    axes.axhline(1.0, color=INK, lw=1.0, ls="--", label="noise floor")
    axes.set_xticks(places, ["base model", *map(_change, found.steps, found.steps[1:])])
    axes.set_xlim(-0.3, len(places) - 0.7)
    largest = max(1.0, *(float(np.nanmax(values)) for values in errors.values()))
    if largest > _FAR:
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter("{x:g}")
        axes.set_ylim(0.7, 1.5 * largest)
    else:
        axes.set_ylim(0.0, 1.08 * largest)
    axes.set_ylabel("error / floor")
    screened, refitted = found.tried
    words = f"candidates compared: {screened}, hypotheses refitted: {refitted}; {found.stopped}"
    axes.set_xlabel(fill(words, _WIDEST))
    figure.legend(loc="outside upper right", ncols=4)
    return figure


def _change(before: LadderStep, after: LadderStep) -> str:
    """Name what one step takes away from the one below it, and what it adds."""
    gone = [f"− {e}" for e in before.effects if e not in after.effects]
    return "\n".join([*gone, *(f"+ {e}" for e in after.effects if e not in before.effects)])


def loops_figure(found: Diagnosis) -> Figure:
    """Draw one force against slip in a held-out run: measured, base model and, if it differs, final model.

    It is the friction of the first pad, or what all bearings carry together where no pad's was measured.
    """
    objective = found.search.base.objective
    place = (objective.held_out or [0])[0]
    run = objective.run(place)
    models = [("base model", found.search.base, BEFORE)]
    models += [(_with(found), found.final, AFTER)] if found.added else []
    figure = new_figure(8.6, 4.2)
    panels = figure.subplots(1, len(models), sharey=True, sharex=True, squeeze=False)[0]
    for axes, (label, fit, colour) in zip(panels, models, strict=True):
        measured, force = (of[:, 0] for of in pair_forces(run, fit.solution.residuals, place))
        said = np.where(run.sliding, force, np.nan) if run.forces_measured else force
        _loop(axes, run.slip, measured, EXPECTED, "measured", 2.2)
        _loop(axes, run.slip, said, colour, label, 0.9)
        axes.set_title(label, loc="left")
        axes.set_xlabel("slip [mm]")
    lines = {str(line.get_label()): line for axes in panels for line in axes.get_lines()}
    figure.legend(lines.values(), lines.keys(), loc="outside upper right", ncols=3)  # loops fill the panels
    panels[0].set_ylabel(f"friction of pad {run.pads[0]} [kN]" if run.forces_measured else "force of all bearings [kN]")
    return figure


def _loop(axes: Axes, slip: Array, force: Array, colour: str, label: str, width: float) -> None:
    axes.plot(slip * 1e3, force / 1e3, color=colour, lw=width, label=label)


def surface_figure(surface: ResidualSurface) -> Figure:
    """Draw the missing force over the one or two states that organise it best, with its band."""
    figure = new_figure(8.0, 4.0)
    axes = figure.subplots()
    labels, edges = zip(*map(_state_axis, surface.states, surface.edges), strict=True)
    middles = [(e[1:] + e[:-1]) / 2.0 for e in edges]
    small = float(np.nanmax(np.abs(surface.mean), initial=0.0)) < _SMALL
    unit = surface.unit if small else usual_unit(surface.unit)
    mean, band = (convert(1.0, surface.unit, unit) * x for x in (surface.mean, surface.band))
    axes.set_xlabel(labels[0])
    if len(surface.states) == 1:
        axes.fill_between(middles[0], mean - band, mean + band, color=EXPECTED, label="95 %")
        axes.plot(middles[0], mean, color=AFTER, marker="o", ms=3, label="missing force")
        axes.axhline(0.0, color=INK, lw=0.8)
        axes.set_ylabel(f"{surface.relation} [{unit}]")
        axes.legend()
        return figure
    limit = float(np.nanmax(np.abs(mean)))
    sure = np.where(np.abs(mean) > band, mean, np.nan)
    axes.set_facecolor("#eef1f4")
    drawn = axes.pcolormesh(*edges, sure.T, cmap="RdBu_r", vmin=-limit, vmax=limit)
    axes.set_ylabel(labels[1])
    axes.set_title("missing force; grey where it is not told from zero")
    figure.colorbar(drawn, ax=axes, label=f"{surface.relation} [{unit}]")
    return figure


def _state_axis(state: str, edges: Array) -> tuple[str, Array]:
    """Return the label of a state's axis and its edges, in the unit in which people read it."""
    unit = UNITS[state]
    words = WORDS[state].removeprefix("the ")
    return f"{words} [{usual_unit(unit)}]", convert(1.0, unit, usual_unit(unit)) * edges
