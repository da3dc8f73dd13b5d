"""The recording of a discovery: measured, before and with the law side by side, and its pictures with moving dots."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.discovery.law import Law
from slipwise.discovery.result import Discovery
from slipwise.record import Record
from slipwise.view.figures.discovery_errors import errors_figure, loops_figure, shown_runs, shown_states, states_figure
from slipwise.view.figures.discovery_figures import candidate_figure, law_figure
from slipwise.view.figures.discovery_samples import law_heights, law_states, predicted_acceleration, predicted_forces
from slipwise.view.figures.style import styled
from slipwise.view.geometry import geometry_of
from slipwise.view.recordings.boards import Board, Dots
from slipwise.view.recordings.comparison import write_comparison
from slipwise.view.words.discovery_words import state_axis


def write_discovery_recording(found: Discovery, path: Path) -> Path:
    """Write a run, held out if there is one: measured, and the forces that a fit predicts before and with the laws.

    Motion and loads are as measured in all of them; the forces answer to these.

    Args:
        found: the discovery.
        path: of the file, ending in .rrd.

    Returns:
        The path; the file is there whole or not at all.
    """
    place = shown_runs(found)[-1]
    run = found.base.objective.run(place)
    fits = [("before", _record(found, place, with_laws=False))]
    fits += [("with the law", _record(found, place, with_laws=True))] if found.laws else []
    specimen = found.base.objective.specimen
    geometry = geometry_of(specimen)
    if not specimen.free:
        geometry = replace(geometry, buffer_places=())
    title = f"{found.campaign}, {run.name}: {found.sentence}"
    return write_comparison(run.record, fits, geometry, path, title, _boards(found, place))


def _record(found: Discovery, place: int, *, with_laws: bool) -> Record:
    run = found.base.objective.run(place)
    forces = predicted_forces(found, place, with_laws=with_laws)
    new = {f"pad_{pad}_Fx": forces[:, i] for i, pad in enumerate(run.pads)}
    if found.base.objective.balanced:
        new["girder_ax"] = predicted_acceleration(found, place, with_laws=with_laws)
    return run.record.replaced(**new)


def _boards(found: Discovery, place: int) -> list[Board]:
    """Draw by night what the page shows by day."""
    with styled(night=True):
        boards = [_law_board(law, place) for law in found.laws]
        if not found.laws and found.organised is not None:
            boards.append(Board("what comes nearest", candidate_figure(found.organised)))
        boards.append(Board("errors", errors_figure(found)))
        if shown_states(found):
            boards.append(Board("what is left", states_figure(found)))
        boards.append(Board("loops", loops_figure(found)))
    return boards


def _law_board(law: Law, place: int) -> Board:
    """Draw a law; the dots are what the run that is shown measured."""
    figure, pads = law_figure(law), law.fitted.objective.plain.run(place).pads
    states, heights = law_heights(law, law_states(law.fitted), place)
    dots = []
    for axes, name, values in zip(figure.axes, law.states, states, strict=True):
        _, factor = state_axis(name, max(abs(end) for end in law.valid[name]))
        shown = {pads[i]: np.stack([factor * values[:, i], heights[:, i]], axis=1) for i in range(values.shape[1])}
        dots.append(Dots(axes, shown))
    return Board(law.name, figure, tuple(dots))
