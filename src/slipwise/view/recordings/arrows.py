"""Forces in 3-D: arrows from where they act."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.record import Record
from slipwise.view.figures.style import NIGHT_INK, buffer_colour, pad_colour, rgb
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.timeline import frames, time_column

#: Friction is about a tenth of the load: its arrows are drawn this many times longer for the same force.
FRICTION_ZOOM = 10.0


def log_forces(stream: rr.RecordingStream, table: str, carrier: str, record: Record, geometry: RigGeometry) -> None:
    """Put load, friction and buffer forces into the recording; a force that was not recorded does not show.

    Args:
        stream: what is being recorded.
        table: entity path of the table, which carries the buffers.
        carrier: entity path of the side that carries the pads.
        record: its channels.
        geometry: where the forces act.
    """
    shown, pads = frames(record), geometry.pads
    scale = 0.18 * max(geometry.girder_size[:2]) / geometry.pad_load
    own = [pad_colour(pad) for pad in pads]
    loads = [("", "", f"pad_{pad}_N") for pad in pads]
    frictions = [(f"pad_{pad}_Fx", f"pad_{pad}_Fy", "") for pad in pads]
    buffers = [(f"buffer_{b}_Fx", f"buffer_{b}_Fy", "") for b in geometry.buffers]
    green = [buffer_colour(b) for b in geometry.buffers]
    for path, names, places, factor, colours in (
        (f"{carrier}/load", loads, geometry.pad_places, scale, own),
        (f"{carrier}/friction", frictions, geometry.pad_places, FRICTION_ZOOM * scale, [NIGHT_INK] * len(pads)),
        (f"{table}/buffer_force", buffers, geometry.buffer_places, scale, green),
    ):
        if any(name in record for row in names for name in row):
            _log_arrows(stream, path, record, shown, names, np.array(places)[: len(names)], factor, colours)


def _log_arrows(
    stream: rr.RecordingStream,
    path: str,
    record: Record,
    shown: NDArray[np.intp],
    names: list[tuple[str, str, str]],
    places: Array,
    factor: float,
    colours: list[str],
) -> None:
    count = len(names)
    vectors, origins = np.zeros((len(shown), count, 3)), np.zeros((len(shown), count, 3))
    origins[:, :, :2] = places
    for i, row in enumerate(names):
        for axis, name in enumerate(row):
            if name in record:
                vectors[:, i, axis] = factor * record[name][shown]
    stream.log(
        path, rr.Arrows3D.from_fields(radii=[0.03] * count, colors=[rgb(c) for c in colours[:count]]), static=True
    )
    stream.send_columns(
        path,
        indexes=time_column(record.time[shown]),
        columns=rr.Arrows3D.columns(vectors=vectors.reshape(-1, 3), origins=origins.reshape(-1, 3)).partition(
            [count] * len(shown)
        ),
    )
