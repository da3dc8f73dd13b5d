"""The recording of a comparison: measured and simulated side by side on one timeline."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.comparison.result import Comparison
from slipwise.record import Record
from slipwise.relations.run_data import FitRun
from slipwise.view.figures.compare_figures import shown_run
from slipwise.view.figures.friction_clouds import clouds_figure, coefficients, friction
from slipwise.view.figures.style import styled
from slipwise.view.geometry import geometry_of
from slipwise.view.recordings.boards import Board, Dots
from slipwise.view.recordings.comparison import write_comparison


def write_compare_recording(found: Comparison, path: Path) -> Path:
    """Write the run that the report shows: measured, and replayed; or, where slip is prescribed, the law's forces.

    Args:
        found: the comparison.
        path: of the file, ending in .rrd.

    Returns:
        The path; the file is there whole or not at all.
    """
    place = shown_run(found)
    run = found.base.objective.run(place)
    label = "replayed" if found.system else "law at measured N, v"
    measured, simulated = _pair(found, place, run)
    geometry = geometry_of(found.model.built_specimen())
    if not found.campaign.specimen.free:
        geometry = replace(geometry, buffer_places=())
    title = f"{found.campaign.name}, {run.name}"
    return write_comparison(measured, [(label, simulated)], geometry, path, title, _boards(found, place, run))


def _boards(found: Comparison, place: int, run: FitRun) -> list[Board]:
    """Draw friction over load against speed and pressure; the dots are what the run that is shown measured."""
    known = friction(found)
    if not len(known.speed):
        return []
    with styled(night=True):
        drawn = clouds_figure(known)
    said = found.base.solution.residuals.pad_forces[place]
    speed, measured, _ = coefficients(run, said)
    pressure = run.load / found.base.objective.specimen.pad_area
    dots = [
        Dots(axes, {pad: np.stack([over[:, i], measured[:, i]], axis=1) for i, pad in enumerate(run.pads)})
        for axes, over in zip(drawn.axes, (1e3 * speed, 1e-6 * pressure), strict=True)
    ]
    return [Board("friction over load", drawn, tuple(dots))]


def _pair(found: Comparison, place: int, run: FitRun) -> tuple[Record, Record]:
    """Return measured and simulated channels where both are known; a replay has no past at a window's start."""
    if found.system is None and not run.forces_measured:
        return run.record, run.record
    if found.system is None:
        said = found.base.solution.residuals.pad_forces[place]
        forces = {f"pad_{pad}_Fx": said[:, i] for i, pad in enumerate(run.pads)}
        return run.record, run.record.replaced(**forces)
    one = found.system.runs[place]
    known = np.all([np.isfinite(v) for v in one.simulated.values()], axis=0)
    table = {n: v[known] for n, v in run.record.channels.items() if n.startswith("table_")}
    simulated = Record(one.time[known], {**table, **{n: v[known] for n, v in one.simulated.items()}})
    return run.record, simulated
