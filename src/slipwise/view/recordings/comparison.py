"""A rerun recording of a measurement beside simulations of it, on one timeline."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rerun.blueprint as rrb
from numpy.typing import NDArray
from rerun import TextDocument

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.view.figures.pad_layout import layout_of
from slipwise.view.figures.style import MODEL_COLOURS, NIGHT_INK, mixed, packed
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.arrows import FRICTION_ZOOM
from slipwise.view.recordings.boards import Board, log_board
from slipwise.view.recordings.loop_board import log_loops, one_colour
from slipwise.view.recordings.recording import check_drawable, loops_view, rig_view, send_layout, started, write_bytes
from slipwise.view.recordings.scene import Scene, largest_motion, log_rig, nice_zoom
from slipwise.view.recordings.series import Line, Plot, log_series, overlaid_tabs_of, series_tabs
from slipwise.view.recordings.timeline import frames

_AGREES, _DIFFERS = "#5f6b7a", "#ff3d8b"
#: A pad has the full colour when its residual reaches this fraction of the measured rms force.
_FULL = 0.5
#: Residuals are averaged over this time so that the eye can follow [s].
_BLUR = 0.2


def write_comparison(
    measured: Record,
    simulated: Sequence[tuple[str, Record]],
    geometry: RigGeometry,
    path: Path,
    title: str,
    boards: Sequence[Board] = (),
) -> Path:
    """Write a measurement and simulations of it side by side: rigs, loops, series and residuals.

    Args:
        measured: with slip_x.
        simulated: label and record of each model; brought to the times of the measurement.
        geometry: of the rig that all share.
        path: of the file, ending in .rrd.
        title: of the recording.
        boards: pictures beside it, their dots at the samples of the measurement.

    Returns:
        The path; the file is there whole or not at all.

    Raises:
        InputError: a record without slip_x, no simulation or two of the same label, or records that share no time.
    """
    labels = [label for label, _ in simulated]
    if not labels or len(set(labels)) < len(labels) or "measured" in labels:
        raise InputError(f"a comparison needs simulations with labels of their own, none of them 'measured': {labels}")
    for record in (measured, *(record for _, record in simulated)):
        check_drawable(record)
    first = max(record.time[0] for record in (measured, *(r for _, r in simulated)))
    last = min(record.time[-1] for record in (measured, *(r for _, r in simulated)))
    whole, measured = measured, measured.between(first, last)
    if len(measured) < 2:
        raise InputError("the records share no time: align simulations with the measurement first")
    models = [(label, _at(record, measured.time)) for label, record in simulated]
    colours = {label: MODEL_COLOURS[i % len(MODEL_COLOURS)] for i, label in enumerate(labels)}

    with started(title, geometry, [measured, *(record for _, record in models)]) as (stream, memory):
        slip = max(largest_motion(record, ("slip_x", "slip_y")) for record in (measured, *(r for _, r in models)))
        zoom = nice_zoom(slip, 0.1 * max(geometry.girder_size[:2]))
        apart = 1.25 * max(geometry.girder_size[0], geometry.table_size[0])
        rigs = [("measured", measured), *models]
        layout = overlaid_tabs_of(geometry.pads, geometry.buffers)
        overlaid = [name for plots in layout.values() for plot in plots for name in plot.names]
        compared = (*layout["motion"], *layout["friction"])
        coloured = True
        for i, (label, record) in enumerate(rigs):
            place = (apart * (i - 0.5 * (len(rigs) - 1)), 0.0, 0.0)
            pads = None if i == 0 else _residual_colours(measured, record, geometry.pads)
            coloured = coloured and (i == 0 or pads is not None)
            log_rig(
                stream, Scene(f"rigs/{i}", zoom, table_moves=False, offset=place, label=label), record, geometry, pads
            )
            line = Line(str(i), label, NIGHT_INK if i == 0 else colours[label], 2.5 if i == 0 else 1.3)
            log_series(stream, "channels", _only(record, overlaid), line)
            if i > 0:
                log_series(stream, "residuals", _residual(measured, record, compared), line)
        traces = [one_colour("measured", measured, NIGHT_INK, 2.5)]
        traces += [one_colour(label, record, colours[label]) for label, record in models]
        growing = log_loops(stream, "loops", traces, layout_of(measured, geometry))
        words = _words(title, labels, zoom, coloured, boards)
        stream.log("about", TextDocument(words, media_type="text/markdown"), static=True)

        tabs: list[rrb.Container] = [
            rrb.Vertical(log_board(stream, f"boards/{i}", board, whole), name=board.name)
            for i, board in enumerate(boards)
        ]
        tabs += series_tabs("channels", [measured, *(record for _, record in models)], layout)
        left = [_residual(measured, record, compared) for _, record in models]
        tabs += series_tabs("residuals", left, {"residuals": compared})
        seen_from = (0.0, -0.6 - 0.58 * len(rigs), 0.3 + 0.3 * len(rigs))
        view = rig_view("rigs", f"Seen from the table (slip drawn {zoom:g} times)", geometry, seen_from)
        about = rrb.TextDocumentView(origin="about", name="What you see")
        send_layout(stream, rrb.Vertical(view, about, row_shares=[3, 1]), loops_view("loops", growing), tabs)
        return write_bytes(memory, path)


def _at(record: Record, time: Array) -> Record:
    """Bring a record to other times by straight lines between samples, which is enough for the eye."""
    return Record(time, {n: np.interp(time, record.time, v) for n, v in record.channels.items()}, record.provenance)


def _only(record: Record, names: Sequence[str]) -> Record:
    return Record(record.time, {name: record[name] for name in names if name in record})


def _residual(measured: Record, simulated: Record, plots: Sequence[Plot]) -> Record:
    """Return simulated minus measured for the channels whose residuals are shown, if both have them."""
    both = [plot.names[0] for plot in plots if plot.names[0] in measured and plot.names[0] in simulated]
    return Record(measured.time, {name: simulated[name] - measured[name] for name in both})


def _residual_colours(measured: Record, simulated: Record, pads: Sequence[str]) -> NDArray[np.uint32] | None:
    """Colour every pad by how far its friction is off, (n_frames, n_pads); None where friction was not recorded."""
    names = [f"pad_{pad}_Fx" for pad in pads]
    if not (measured.has_all(*names) and simulated.has_all(*names)):
        return None
    force = np.stack([measured[name] for name in names], axis=1)
    off = np.stack([simulated[name] for name in names], axis=1) - force
    width = max(1, round(_BLUR / measured.dt))
    window = np.ones(width) / width
    blurred = np.stack([np.convolve(column**2, window, mode="same") for column in off.T], axis=1)
    rms = np.sqrt(np.mean(force**2, axis=0))
    share = np.sqrt(blurred) / np.where(rms > 0.0, _FULL * rms, np.inf)
    scale = np.array([packed(mixed(_DIFFERS, _AGREES, i / 32)) for i in range(33)], dtype=np.uint32)
    return scale[np.rint(32 * np.clip(share, 0.0, 1.0)).astype(int)][frames(measured)]


def _words(title: str, labels: Sequence[str], zoom: float, coloured: bool, boards: Sequence[Board]) -> str:
    pads = (
        "Pads of a simulation are **grey where their friction agrees** with the measurement and "
        f"**magenta where it is off** by {_FULL:.0%} of the measured rms or more (averaged over {_BLUR:g} s)."
        if coloured
        else "Friction of single pads was not recorded on both sides, so pads do not show residuals."
    )
    dots = ["", "Coloured dots on a picture: where each pad is now."] if any(b.dots for b in boards) else []
    return "\n".join(
        [
            f"# {title}",
            "",
            f"From left to right: **measured**, {', '.join(f'**{label}**' for label in labels)}. "
            f"The table stands still; slip is drawn {zoom:g} times larger.",
            "",
            f"Coloured arrows: load N. White arrows: friction, {FRICTION_ZOOM:g} times longer for the same force.",
            pads,
            "",
            "Loops and series: white is measured, each simulation has a colour. Tab *residuals*: simulated − measured.",
            *dots,
        ]
    )
