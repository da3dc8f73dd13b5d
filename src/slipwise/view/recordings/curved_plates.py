"""The curved plates of a pendulum in 3-D: bowls on which the sliders climb."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.view.geometry import RigGeometry

_PLATE = (150, 160, 172, 150)
#: Edge of a plate in lengths of the girder, which hold the slip as drawn, and in radii of the slider as drawn [1].
_OF_GIRDER, _OF_SLIDER = 0.13, 1.3
#: Rings and spokes of a plate's mesh.
_RINGS, _SPOKES = 6, 36


def log_curved_plates(stream: rr.RecordingStream, path: str, geometry: RigGeometry, slider: float, zoom: float) -> None:
    """Draw the plate of each slider that is curved, on the side that does not carry the sliders.

    Slip and rise are both drawn `zoom` times larger, so that a plate is drawn as a bowl of `zoom` times its radius of
    curvature: the slider stays on it.

    Args:
        stream: what is being recorded.
        path: entity path of the plates, below the side that carries them.
        geometry: with the curvatures; of flat pads nothing is drawn.
        slider: radius with which a slider is drawn [m].
        zoom: motion is drawn this many times larger than it is [1].
    """
    curved = [(*place, c) for place, c in zip(geometry.pad_places, geometry.pad_curvatures, strict=False) if c != 0.0]
    if not curved:
        return
    edge = max(_OF_GIRDER * max(geometry.girder_size[:2]), _OF_SLIDER * slider)
    flat, triangles = _disc(edge)
    side = -1.0 if geometry.pads_on == "table" else 1.0
    bowls = [
        np.column_stack([flat + [x, y], side * 0.5 * curvature / zoom * np.sum(flat**2, axis=1)])
        for x, y, curvature in curved
    ]
    stream.log(
        path,
        rr.Mesh3D(
            vertex_positions=np.concatenate(bowls),
            triangle_indices=np.concatenate([triangles + i * len(flat) for i in range(len(bowls))]),
            albedo_factor=_PLATE,
        ),
        static=True,
    )


def _disc(edge: float) -> tuple[Array, NDArray[np.intp]]:
    """Return the points (n, 2) [m] and triangles (m, 3) of a flat disc of radius `edge` [m] round the origin."""
    angle = np.linspace(0.0, 2.0 * np.pi, _SPOKES, endpoint=False)
    rim = np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.concatenate([np.zeros((1, 2)), *(edge * r / _RINGS * rim for r in range(1, _RINGS + 1))])
    here = np.arange(_SPOKES)
    there = np.roll(here, -1)
    triangles = [np.column_stack([np.zeros(_SPOKES, dtype=int), 1 + here, 1 + there])]
    for ring in range(1, _RINGS):
        inner, outer = 1 + (ring - 1) * _SPOKES, 1 + ring * _SPOKES
        triangles.append(np.column_stack([inner + here, outer + here, outer + there]))
        triangles.append(np.column_stack([inner + here, outer + there, inner + there]))
    return points, np.concatenate(triangles)
