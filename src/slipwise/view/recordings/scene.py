"""The rig in 3-D: table, pads, buffers and girder, moving, with the forces on them as arrows."""

from dataclasses import dataclass

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.record import Record
from slipwise.view.figures.style import NIGHT_INK, UPLIFT, packed, pad_colour, rgb
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.arrows import log_forces
from slipwise.view.recordings.curved_plates import log_curved_plates
from slipwise.view.recordings.storeys import log_storeys
from slipwise.view.recordings.timeline import frames, time_column

_STEEL, _POST, _DECK = (150, 160, 172), (112, 122, 134), (150, 166, 186)
_TOP, _RUBBER = (92, 104, 118), (22, 22, 26)
#: The deck's lower face above the sliding plane [m].
_UNDER_DECK = 0.02
#: Pads are drawn this many times wider than they are [1].
_WIDER = 5.0
_NICE = (1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0)


@dataclass(frozen=True)
class Scene:
    """How one rig stands in the picture.

    Attributes:
        root: entity path.
        zoom: motion is drawn this many times larger than it is [1].
        table_moves: False in the table's frame.
        offset: of the rig from the middle of the picture [m].
        label: shown above the girder.
    """

    root: str
    zoom: float
    table_moves: bool
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    label: str = ""


def nice_zoom(largest: float, shown_as: float) -> float:
    """Return the round factor that draws a motion of `largest` [m] about as large as `shown_as` [m]."""
    wanted = shown_as / largest if largest > 0.0 else 1.0
    return max(factor for factor in _NICE if factor <= max(wanted, 1.0))


def largest_motion(record: Record, names: tuple[str, ...]) -> float:
    """Return the largest absolute value of some displacement channels, 0 where none was recorded [m]."""
    return max((float(np.abs(record[name]).max()) for name in names if name in record), default=0.0)


def log_rig(
    stream: rr.RecordingStream,
    scene: Scene,
    record: Record,
    geometry: RigGeometry,
    pad_colours: NDArray[np.uint32] | None = None,
) -> None:
    """Put a rig into the recording.

    Args:
        stream: what is being recorded.
        scene: where and how large.
        record: its channels; a motion or a force that was not recorded does not show.
        geometry: its shape.
        pad_colours: (n_frames, n_pads) as 0xRRGGBBAA; without it pads have their own colours and show uplift.
    """
    table, girder = f"{scene.root}/table", f"{scene.root}/table/girder"
    shown = frames(record)
    stream.log(scene.root, rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    _log_table(stream, table, geometry)
    _log_girder(stream, girder, geometry, scene.label)
    moving = ("table_dx", "table_dy", "table_dz") if scene.table_moves else ()
    _log_motion(stream, table, record, shown, moving, ("table_pitch",) if moving else (), scene.zoom, scene.offset)
    _log_motion(
        stream, girder, record, shown, ("slip_x", "slip_y", "heave"), ("roll", "pitch", "yaw"), scene.zoom, (0, 0, 0)
    )
    log_storeys(stream, f"{girder}/storeys", record, geometry, _UNDER_DECK + _deck(geometry), scene.zoom)
    carrier, other = (table, girder) if geometry.pads_on == "table" else (girder, table)
    log_curved_plates(stream, f"{other}/plates", geometry, _WIDER * geometry.pad_radius, scene.zoom)
    _log_pads(stream, carrier, record, shown, geometry, pad_colours)
    log_forces(stream, table, carrier, record, geometry)


def _log_table(stream: rr.RecordingStream, path: str, geometry: RigGeometry) -> None:
    thick = geometry.table_size[2]
    below = -0.155 - 0.5 * thick
    stream.log(
        f"{path}/top",
        rr.Boxes3D(sizes=[geometry.table_size], centers=[[0, 0, below]], colors=[_TOP], fill_mode="solid"),
        static=True,
    )
    places = np.array(geometry.buffer_places).reshape(-1, 2)
    if len(places):
        stream.log(
            f"{path}/rubber",
            rr.Cylinders3D(
                lengths=[0.12] * len(places),
                radii=[0.13] * len(places),
                centers=np.column_stack([places, np.full(len(places), -0.095)]),
                colors=[_RUBBER] * len(places),
                fill_mode="solid",
            ),
            static=True,
        )


def _log_girder(stream: rr.RecordingStream, path: str, geometry: RigGeometry, label: str) -> None:
    """Draw a deck above the pads and a weight on a post, its middle at the centre of gravity."""
    long, wide, high = geometry.girder_size
    centre = geometry.girder_centre_height
    deck = _deck(geometry)
    stream.log(
        f"{path}/deck",
        rr.Boxes3D(
            sizes=[[long, wide, deck]],
            centers=[[0, 0, _UNDER_DECK + 0.5 * deck]],
            colors=[_DECK],
            radii=0.012,
            fill_mode=rr.components.FillMode.TransparentFillMajorWireframe,
        ),
        static=True,
    )
    foot = _UNDER_DECK + deck
    weight = min(0.45 * high, 2.0 * max(centre - foot, 0.05))
    under = max(centre - 0.5 * weight - foot, 0.0)
    stream.log(
        f"{path}/weight",
        rr.Boxes3D(
            sizes=[[0.45 * long, 0.5 * wide, weight], [0.15 * long, 0.3 * wide, under]],
            centers=[[*geometry.centre, centre], [*geometry.centre, foot + 0.5 * under]],
            colors=[_STEEL, _POST],
            fill_mode="solid",
        ),
        static=True,
    )
    stream.log(
        f"{path}/centre_of_gravity",
        rr.Points3D(
            [[*geometry.centre, centre + 0.5 * weight]],
            radii=0.04,
            colors=[rgb(NIGHT_INK)],
            labels=label or "centre of gravity",
            show_labels=bool(label),
        ),
        static=True,
    )
    places = np.array(geometry.buffer_places).reshape(-1, 2)
    if len(places):
        stream.log(
            f"{path}/keys",
            rr.Cylinders3D(
                lengths=[0.14] * len(places), radii=[0.03] * len(places),
                centers=np.column_stack([places, np.full(len(places), -0.03)]),
                colors=[_STEEL] * len(places), fill_mode="solid",
            ),
            static=True,
        )  # fmt: skip


def _deck(geometry: RigGeometry) -> float:
    """Return the thickness of the deck [m]."""
    return min(0.12, 0.25 * geometry.girder_size[2])


def _log_motion(
    stream: rr.RecordingStream,
    path: str,
    record: Record,
    shown: NDArray[np.intp],
    shifts: tuple[str, ...],
    turns: tuple[str, ...],
    zoom: float,
    offset: tuple[float, float, float],
) -> None:
    """Move an entity by the channels of the record, enlarged; turning angles are small, so they simply add."""
    move, turn = np.zeros((len(shown), 3)), np.zeros((len(shown), 3))
    for column, name in enumerate(shifts):
        if name in record:
            move[:, column] = zoom * record[name][shown]
    for name in turns:
        if name in record:
            turn[:, ("roll", "pitch", "yaw").index(name.removeprefix("table_"))] = zoom * record[name][shown]
    half = np.column_stack([0.5 * turn, np.ones(len(shown))])
    stream.send_columns(
        path,
        indexes=time_column(record.time[shown]),
        columns=rr.Transform3D.columns(
            translation=move + np.array(offset), quaternion=half / np.linalg.norm(half, axis=1, keepdims=True)
        ),
    )


def _log_pads(
    stream: rr.RecordingStream,
    carrier: str,
    record: Record,
    shown: NDArray[np.intp],
    geometry: RigGeometry,
    colours: NDArray[np.uint32] | None,
) -> None:
    """Draw pads wider than they are, coloured by what they do."""
    pads = geometry.pads
    height = -0.075 if geometry.pads_on == "table" else 0.0
    centres = np.column_stack([np.array(geometry.pad_places), np.full(len(pads), height)])
    path = f"{carrier}/pads"
    length = 0.15 if geometry.pads_on == "table" else 0.04
    stream.log(
        path,
        rr.Cylinders3D.from_fields(
            lengths=[length] * len(pads), radii=[_WIDER * geometry.pad_radius] * len(pads), centers=centres,
            fill_mode="solid", labels=list(pads), show_labels=False,
        ),
        static=True,
    )  # fmt: skip
    if colours is None:
        colours = _uplift_colours(record, shown, pads)
    changed = np.flatnonzero(np.any(colours[1:] != colours[:-1], axis=1)) + 1
    kept = np.concatenate([[0], changed])
    stream.send_columns(
        path,
        indexes=time_column(record.time[shown[kept]]),
        columns=rr.Cylinders3D.columns(colors=colours[kept].ravel()).partition([len(pads)] * len(kept)),
    )
    outward = 0.1 * np.max(np.abs(centres)) * np.sign(centres) * [1, 1, 0]
    stream.log(
        f"{carrier}/pad_names",
        rr.Points3D(
            centres + outward, radii=0.001, colors=[rgb(pad_colour(pad)) for pad in pads], labels=list(pads),
            show_labels=True,
        ),
        static=True,
    )  # fmt: skip


def _uplift_colours(record: Record, shown: NDArray[np.intp], pads: tuple[str, ...]) -> NDArray[np.uint32]:
    colours = np.tile(np.array([packed(pad_colour(pad)) for pad in pads], dtype=np.uint32), (len(shown), 1))
    for column, pad in enumerate(pads):
        if f"pad_{pad}_N" in record:
            colours[record[f"pad_{pad}_N"][shown] <= 0.0, column] = packed(UPLIFT)
    return colours
