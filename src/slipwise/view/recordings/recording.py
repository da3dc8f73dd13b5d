"""A rerun recording of one replay: the rig in 3-D, its loops growing, every channel over time."""

import hashlib
import uuid
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rerun as rr
import rerun.blueprint as rrb

from slipwise.errors import InputError
from slipwise.jobs.atomic_write import atomic
from slipwise.record import Record
from slipwise.view.figures.pad_layout import layout_of
from slipwise.view.figures.style import NIGHT, rgb
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.arrows import FRICTION_ZOOM
from slipwise.view.recordings.loop_board import BOARD_SIZE, RECENT, log_loops, own_colours
from slipwise.view.recordings.scene import Scene, largest_motion, log_rig, nice_zoom
from slipwise.view.recordings.series import STICKING, log_series, log_states, series_tabs, tabs_of
from slipwise.view.recordings.timeline import TIMELINE

#: Raise it when a recording shows the same record differently.
_LAYOUT = 3
_IDS = uuid.UUID("5b1e2f52-6c39-4d0c-9b7e-51a9e5d0c0de")


def write_recording(record: Record, geometry: RigGeometry, path: Path, title: str) -> Path:
    """Write a replay as a recording for the rerun viewer.

    The same record gives the same content, ids of recording and views included; ids that rerun gives to its own
    chunks differ from one writing to the next.

    Args:
        record: a replay, or anything with slip_x; what was not recorded is named in the recording's text.
        geometry: of its rig.
        path: of the file, ending in .rrd.
        title: of the recording.

    Returns:
        The path; the file is there whole or not at all.

    Raises:
        InputError: the record has no slip_x or fewer than two samples, so that nothing moves.
    """
    check_drawable(record)
    with started(title, geometry, [record]) as (stream, memory):
        size = 0.1 * max(geometry.girder_size[:2])
        slip = largest_motion(record, ("slip_x", "slip_y"))
        zoom = nice_zoom(max(slip, largest_motion(record, ("table_dx", "table_dy", "table_dz"))), 1.5 * size)
        close = nice_zoom(slip, size)
        log_rig(stream, Scene("laboratory", zoom, table_moves=True), record, geometry)
        log_rig(stream, Scene("on_the_table", close, table_moves=False), record, geometry)
        growing = log_loops(stream, "loops", [own_colours(record)], layout_of(record, geometry))
        log_series(stream, "channels", record)
        states = "pads" if log_states(stream, "pads", record) else ""
        stream.log(
            "about",
            rr.TextDocument(_words(record, geometry, title, zoom, close), media_type="text/markdown"),
            static=True,
        )
        views = [
            rig_view("laboratory", f"In the laboratory (motion drawn {zoom:g} times)", geometry),
            rig_view("on_the_table", f"Seen from the table (slip drawn {close:g} times)", geometry),
        ]
        about = rrb.TextDocumentView(origin="about", name="What you see")
        left = rrb.Vertical(views[0], rrb.Horizontal(views[1], about, column_shares=[3, 2]), row_shares=[3, 2])
        send_layout(
            stream,
            left,
            loops_view("loops", growing),
            series_tabs("channels", [record], tabs_of(geometry.pads, geometry.buffers), states),
        )
        return write_bytes(memory, path)


def check_drawable(record: Record) -> None:
    """Refuse a record in which nothing can move.

    Raises:
        InputError: no slip_x, or fewer than two samples.
    """
    if "slip_x" not in record or len(record) < 2:
        raise InputError(
            f"a recording needs slip_x over at least two samples; this record has {len(record)} samples of: "
            f"{', '.join(sorted(record.channels)) or 'no channel'}"
        )


@contextmanager
def started(
    title: str, geometry: RigGeometry, records: Iterable[Record]
) -> Iterator[tuple[rr.RecordingStream, rr.MemoryRecording]]:
    """Begin a recording in memory whose id says what is in it.

    A viewer that is already open merges recordings of one id: another content must have another id.
    """
    digest = hashlib.sha256(f"{_LAYOUT} {title} {geometry}".encode())
    for record in records:
        digest.update(record.time.tobytes())
        for name, values in sorted(record.channels.items()):
            digest.update(name.encode())
            digest.update(values.tobytes())
    stream = rr.RecordingStream("slipwise", recording_id=digest.hexdigest()[:32], send_properties=False)
    memory = stream.memory_recording()
    stream.send_recording_name(title)
    try:
        yield stream, memory
    except BaseException:
        memory.drain_as_bytes()  # rerun writes to the terminal that it loses what is still there
        raise


def rig_view(
    root: str, name: str, geometry: RigGeometry, seen_from: tuple[float, float, float] = (0.95, -0.85, 0.55)
) -> rrb.View:
    """Show rigs from a place given in lengths of the girder from the middle."""
    # a frame is looked at from farther away, and at half its height
    top = max((storey.z for storey in geometry.storeys), default=0.0)
    reach = max(*geometry.girder_size[:2], 1.3 * top)
    return rrb.Spatial3DView(
        origin=root,
        name=name,
        background=list(rgb(NIGHT)),
        line_grid=rrb.LineGrid3D(
            plane=rr.components.Plane3D.XY.with_distance(-0.155 - geometry.table_size[2]), color=[255, 255, 255, 22]
        ),
        eye_controls=rrb.EyeControls3D(
            position=[reach * along for along in seen_from], look_target=[0.0, 0.0, 0.4 * top - 0.04 * reach]
        ),
    )


def loops_view(root: str, growing: list[str]) -> rrb.View:
    """Show the board of loops with the whole past of its growing lines."""
    now = rrb.TimeRangeBoundary.cursor_relative()
    since = {"past": rrb.TimeRangeBoundary.infinite(), "recent": rrb.TimeRangeBoundary.cursor_relative(seconds=-RECENT)}
    ranges: dict[rr.encodings.EntityPathLike, Any] = {
        path: rrb.VisibleTimeRanges(timeline=TIMELINE, start=since[path.rpartition("/")[2]], end=now)
        for path in growing
    }
    return rrb.Spatial2DView(
        origin=root,
        name="Friction against slip",
        background=list(rgb(NIGHT)),
        visual_bounds=rrb.VisualBounds2D(x_range=[0, BOARD_SIZE[0]], y_range=[0, BOARD_SIZE[1]]),
        overrides=ranges,
    )


def send_layout(stream: rr.RecordingStream, left: rrb.Container, loops: rrb.View, tabs: list[rrb.Container]) -> None:
    """Open the viewer with the rig on the left, loops and series on the right."""
    right = rrb.Vertical(loops, rrb.Tabs(*tabs, active_tab=0, name="channels"), row_shares=[4, 5])
    root = rrb.Horizontal(left, right, column_shares=[1, 1])
    _fix_ids(root, "layout")
    stream.send_blueprint(
        rrb.Blueprint(
            root,
            rrb.BlueprintPanel(state="collapsed"),
            rrb.SelectionPanel(state="collapsed"),
            rrb.TimePanel(state="collapsed", timeline=TIMELINE, play_state="playing", loop_mode="all"),
            auto_layout=False,
            auto_views=False,
        )
    )


def _fix_ids(part: rrb.Container | rrb.View, place: str) -> None:
    """Return views and containers ids by their place, where rerun would draw lots."""
    part.id = uuid.uuid5(_IDS, place)
    if isinstance(part, rrb.Container):
        part.contents = list(part.contents)
        for i, inner in enumerate(part.contents):
            _fix_ids(inner, f"{place}/{i}")


def write_bytes(memory: rr.MemoryRecording, path: Path) -> Path:
    """Write what was recorded so that the file is there whole or not at all."""
    content = memory.drain_as_bytes()
    with atomic(path) as file:
        file.write(content)
    return path


def _where(geometry: RigGeometry) -> str:
    """Say which pads stand where along x."""
    middle = geometry.basis.middle[0]
    ahead, behind = (
        ", ".join(p for p, (x, _) in zip(geometry.pads, geometry.pad_places, strict=True) if side * (x - middle) > 1e-6)
        for side in (1.0, -1.0)
    )
    return f"Pads at +x: {ahead}; at −x: {behind}." if ahead and behind else f"Pads: {', '.join(geometry.pads)}."


def _words(record: Record, geometry: RigGeometry, title: str, zoom: float, close: float) -> str:
    """Explain the recording in markdown."""
    wanted = ["table_dx", "slip_y", "yaw", *(f"pad_{p}_{kind}" for kind in ("N", "Fx") for p in geometry.pads)]
    missing = [name for name in wanted if name not in record]
    lines = [
        f"# {title}",
        "",
        "Press **space** to play or stop. Drag to turn the rig, scroll to come closer.",
        "",
        f"- **Coloured upright arrows**: load N on a pad, {geometry.pad_load / 1e3:.1f} kN at rest. {_where(geometry)}",
        "- **White arrows**: friction, the force of the girder on the pad, "
        f"{FRICTION_ZOOM:g} times longer than N for the same force.",
        "- **Green arrows**: buffer forces, on the scale of N.",
        "- A **magenta pad** carries nothing: it is lifted off.",
        f"- Motion is drawn {zoom:g} times larger in the laboratory, slip {close:g} times larger on the table.",
        "- **Loops** stand as the pads do, seen from above. "
        f"Pale: the whole run; dim: until now; bright: the last {RECENT:g} s.",
        f"- A pad **sticks** while it is slower than {STICKING * 1e3:g} mm/s.",
    ]
    if missing:
        lines += ["", f"Not recorded, so not shown: {', '.join(missing)}."]
    about = {key: value for key, value in record.provenance.items() if isinstance(value, str | int | float)}
    if about:
        lines += ["", "| | |", "|---|---|", *(f"| {key} | {value} |" for key, value in sorted(about.items()))]
    return "\n".join(lines)
