"""The frame on a girder in 3-D: its floors, and its columns, which lean as the floors sway."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.record import Record
from slipwise.rig.frame import floor_sway
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.timeline import frames, time_column

_POST = (112, 122, 134)
#: Thickness of a floor and of its columns [m].
_FLOOR = 0.08


def log_storeys(
    stream: rr.RecordingStream, path: str, record: Record, geometry: RigGeometry, foot: float, zoom: float
) -> None:
    """Draw the floors of a frame on their columns; they sway where their accelerations were recorded.

    Args:
        stream: what is being recorded.
        path: entity path of the frame, below the girder, with which it moves.
        record: with the storeys' accelerations, or without.
        geometry: with the storeys; without any nothing is drawn.
        foot: height on which the lowest columns stand [m].
        zoom: sway is drawn this many times larger than it is [1].
    """
    if not geometry.storeys:
        return
    shown = frames(record)
    centres = _floor_centres(record, shown, geometry, zoom)
    count = len(geometry.storeys)
    long, wide = 0.8 * geometry.girder_size[0], 0.8 * geometry.girder_size[1]
    time = time_column(record.time[shown])
    stream.log(
        f"{path}/floors",
        rr.Boxes3D.from_fields(
            half_sizes=[[0.5 * long, 0.5 * wide, 0.5 * _FLOOR]] * count, colors=[_POST], fill_mode="solid"
        ),
        static=True,
    )
    stream.send_columns(
        f"{path}/floors", time, rr.Boxes3D.columns(centers=centres.reshape(-1, 3)).partition([count] * len(shown))
    )
    columns = _columns(centres, [*geometry.centre, foot - 0.5 * _FLOOR], (0.5 * (long - _FLOOR), 0.5 * (wide - _FLOOR)))
    stream.log(f"{path}/columns", rr.LineStrips3D.from_fields(radii=0.5 * _FLOOR, colors=[_POST]), static=True)
    stream.send_columns(
        f"{path}/columns",
        time,
        rr.LineStrips3D.columns(strips=list(columns.reshape(-1, 2, 3))).partition([columns.shape[1]] * len(shown)),
    )


def _floor_centres(record: Record, shown: NDArray[np.intp], geometry: RigGeometry, zoom: float) -> Array:
    """Return where the middle of each floor is in each frame (n_frames, n_storeys, 3) [m]."""
    centres = np.empty((len(shown), len(geometry.storeys), 3))
    centres[:] = [[*geometry.centre, storey.z] for storey in geometry.storeys]
    for place, axis in enumerate("xy"):
        for floor, beside in enumerate(floor_sway(record, geometry.storeys, axis)):
            centres[:, floor, place] += zoom * beside[shown]
    return centres


def _columns(centres: Array, foot: list[float], corner: tuple[float, float]) -> Array:
    """Return the lower and the upper end of four columns under each floor (n_frames, 4 n_storeys, 2, 3) [m]."""
    below = np.concatenate([np.broadcast_to(foot, (len(centres), 1, 3)), centres[:, :-1]], axis=1)
    corners = np.array([[x, y, 0.0] for x in (-corner[0], corner[0]) for y in (-corner[1], corner[1])])
    ends = np.stack([below + [0.0, 0.0, 0.5 * _FLOOR], centres - [0.0, 0.0, 0.5 * _FLOOR]], axis=2)
    both = ends[:, :, None] + corners[None, None, :, None]
    return both.reshape(len(centres), -1, 2, 3)
