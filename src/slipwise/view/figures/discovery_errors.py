"""Pictures of what a law takes away: the error over the states, the loops, and every balance, before and after."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.discovery.result import Discovery
from slipwise.residual_map.splines import choose_knots
from slipwise.residual_map.states import DrivingState
from slipwise.rig.frame import frame_push
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.compare_figures import widest_loop
from slipwise.view.figures.diagnosis_figures import under_axis
from slipwise.view.figures.discovery_samples import (
    after,
    left_over,
    predicted_acceleration,
    predicted_forces,
    predicted_load,
)
from slipwise.view.figures.panels import AFTER, BEFORE, error_bars
from slipwise.view.words.discovery_words import state_axis

#: States over which the error is drawn, and bins of each.
_STATES, _BINS = 4, 24
#: A bin of fewer samples is left out.
_FEWEST = 8


def errors(found: Discovery) -> dict[str, dict[str, tuple[float, float | None]]]:
    """Return the rms error of every balance [floors]: runs -> balance -> before, and after where there is a law."""
    objective, solution = found.base.objective, after(found)
    groups = {"fitted runs": objective.fitted, "held-out runs": objective.held_out}
    return {
        words: {
            r: (
                found.base.solution.residuals.level(r, places),
                solution.residuals.level(r, places) if solution else None,
            )
            for r in objective.relations
        }
        for words, places in groups.items()
        if places
    }


def errors_figure(found: Discovery, *, narrow: bool = False) -> Figure:
    """Draw the error of every balance before and after, of fitted and of held-out runs; if narrow, in a column."""
    groups = errors(found)
    figure = new_figure(4.7, 3.4 * len(groups)) if narrow else new_figure(10.0, 3.8)
    shape = (len(groups), 1) if narrow else (1, len(groups))
    panels = figure.subplots(*shape, sharey=True, squeeze=False).ravel()
    for axes, (words, levels) in zip(panels, groups.items(), strict=True):
        places = error_bars(axes, list(levels.values()), ("before", "with the law"))
        axes.set_xticks(places, [under_axis(r) for r in levels], rotation=90, fontsize=8.0)
        axes.set_title(words)
    panels[0].set_ylabel("error / floor")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper right", ncols=3)
    return figure


def shown_states(found: Discovery) -> list[DrivingState]:
    """Return the states over which the error is drawn: those of the laws, then the best others of the screen."""
    named: dict[str, DrivingState] = {}
    matched = [law.fitted.law.match.candidate for law in found.laws]
    for candidate in [*matched, *found.looked_at]:
        if candidate.port.relation == found.worst:
            for state in candidate.states:
                named.setdefault(state.name, state)
    return list(named.values())[:_STATES]


def states_figure(found: Discovery) -> Figure:
    """Draw the rms of what is left, before and after, over each of the best few states, on the fitted runs."""
    states, later = shown_states(found), after(found)
    figure = new_figure(10.0, 3.1 * (1 if len(states) == 1 else -(-len(states) // 2)))
    panels = figure.subplots(-(-len(states) // 2), min(len(states), 2), sharey=True, squeeze=False)
    fits = [("before", found.base.solution, BEFORE)] + ([("with the law", later, AFTER)] if later else [])
    for axes, state in zip(panels.ravel(), states, strict=False):
        factor = 1.0
        for words, solution, colour in fits:
            values, left = left_over(found.base.objective, solution, found.worst, state)
            label, factor = state_axis(state.name, float(np.abs(values).max()))
            middles, rms = binned_rms(values, left)
            axes.plot(factor * middles, rms, "o-", color=colour, ms=3.0, lw=1.6, label=words)
            axes.set_xlabel(label)
        axes.axhline(1.0, color=mpl.rcParams["text.color"], lw=1.0, ls="--", label="noise floor")
        axes.set_ylim(bottom=0.0)
    for axes in panels[:, 0]:
        axes.set_ylabel("rms of what is left / floor")
    for axes in panels.ravel()[len(states) :]:
        axes.set_visible(False)
    panels[0, 0].legend()
    return figure


def binned_rms(values: Array, left: Array) -> tuple[Array, Array]:
    """Return middles of bins that follow the samples and the range by turns, and the rms of what is left in each."""
    edges = choose_knots(values, _BINS + 1)
    place = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, max(len(edges) - 2, 0))
    count = np.bincount(place)
    enough = count >= _FEWEST
    middles = np.bincount(place, weights=values)[enough] / count[enough]
    return middles, np.sqrt(np.bincount(place, weights=left**2)[enough] / count[enough])


def shown_runs(found: Discovery) -> list[int]:
    """Return the places of the runs whose loops are drawn: of the fitted ones the worst before, and a held-out one."""
    objective, relation = found.base.objective, found.worst
    blocks = found.base.solution.residuals.blocks(relation, objective.fitted)
    worst = max(blocks, key=lambda of: of.squares / of.value.size)
    return [worst.run, *objective.held_out[:1]]


def loops_figure(found: Discovery) -> Figure:
    """Draw the loop of a fitted and of a held-out run: measured, before, and with the law."""
    places = shown_runs(found)
    figure = new_figure(10.6, 4.6)
    panels = figure.subplots(1, len(places), sharey=True, squeeze=False)[0]
    for axes, place in zip(panels, places, strict=True):
        run = found.base.objective.run(place)
        _loop(axes, found, place)
        axes.set_title(f"{run.name} ({'held out' if run.role == 'holdout' else 'fitted'})")
        axes.set_xlabel("slip [mm]")
    panels[0].set_ylabel(f"{loop_words(found)} [kN]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper left", ncols=4)
    return figure


def loop_words(found: Discovery) -> str:
    """Name the force of which loops are drawn."""
    if found.worst == "girder":
        return "force on the girder that no pad carries"
    if found.worst == "heave":
        return "load of all pads"
    return f"friction of pad {found.base.objective.pads[_pad(found)]}"


def _pad(found: Discovery) -> int:
    """Return the place of the pad that is drawn: the first on which the law acts."""
    for law in found.laws:
        if law.fitted.law.match.candidate.port.relation == "pads":
            return int(np.argmax(np.max(law.fitted.law.opened[0], axis=0)))
    return 0


def _loop(axes: Axes, found: Discovery, place: int) -> None:
    run, part = found.base.objective.run(place), widest_loop(found.base.objective.run(place))
    ink, slip = mpl.rcParams["text.color"], 1e3 * run.slip
    measured = _measured(found, place)
    axes.plot(slip, 1e-3 * measured, color=mpl.rcParams["axes.edgecolor"], lw=0.6, rasterized=True, label="whole run")
    axes.plot(slip[part], 1e-3 * measured[part], color=ink, lw=3.2, label="measured, one cycle")
    for words, with_laws, colour in (("before", False, BEFORE), ("with the law", True, AFTER)):
        if with_laws and not found.laws:
            continue
        said = _predicted(found, place, with_laws)
        axes.plot(slip[part], 1e-3 * said[part], color=colour, lw=1.4, label=words)


def _measured(found: Discovery, place: int) -> Array:
    """Return the measured force of which a loop is drawn (n,) [N]: see `loop_words`."""
    run = found.base.objective.run(place)
    if found.worst == "girder":
        return _beside_pads(found, place, run.channel("girder_ax"))
    return run.load.sum(axis=1) if found.worst == "heave" else run.force[:, _pad(found)]


def _predicted(found: Discovery, place: int, with_laws: bool) -> Array:
    """Return the same as it is predicted."""
    if found.worst == "girder":
        return _beside_pads(found, place, predicted_acceleration(found, place, with_laws=with_laws))
    if found.worst == "heave":
        return predicted_load(found, place, with_laws=with_laws)
    return predicted_forces(found, place, with_laws=with_laws)[:, _pad(found)]


def _beside_pads(found: Discovery, place: int, acceleration: Array) -> Array:
    """Return what holds the girder back beside its pads (n,) [N]."""
    run, specimen = found.base.objective.run(place), found.base.objective.specimen
    mass = found.base.solution.values.get("rig.mass", specimen.mass)
    every = len(specimen.pads) / run.force.shape[1]
    return frame_push(run.record, specimen) - mass * acceleration - every * run.force.sum(axis=1)
