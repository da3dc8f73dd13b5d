"""What the storeys on a girder push it, from their measured accelerations.

    force  -sum m_i a_i                moment about a height h   -sum m_i a_i (z_i - h) + sum m_i (g + a_z) u_i

u_i is how far floor i stands beside the girder: what its columns carry over their stiffness, damping left out.

Source: d'Alembert on a shear building; Chopra, Dynamics of Structures, chapter 9.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.record import Record
from slipwise.rig.mjcf.writer import storey_names
from slipwise.rig.specimen import Specimen
from slipwise.rig.storeys import Storey


def storey_channels(storeys: Sequence[Storey], axis: str = "x") -> tuple[str, ...]:
    """Return the channels of the storeys' accelerations along an axis, from below."""
    return tuple(f"{name}_a{axis}" for name in storey_names(storeys))


def frame_push(record: Record, specimen: Specimen, axis: str = "x") -> Array:
    """Return the force of the storeys on the girder along an axis (n,) [N]; nothing where not all were measured."""
    return -np.sum([np.zeros(len(record)), *_inertia(record, specimen.storeys, axis)], axis=0)


def frame_moment(
    record: Record, storeys: Sequence[Storey], felt: Array, axis: str = "x", about: float = 0.0
) -> Array:  # fmt: skip
    """Return the moment of the storeys on the girder (n,) [N m], positive where it loads the pads at the + end.

    Nothing where not all storeys were measured.

    Args:
        record: with the storeys' accelerations.
        storeys: from below.
        felt: (n,) gravity and the girder's acceleration upwards together [m/s^2].
        axis: "x" or "y", along which they push.
        about: height above the sliding plane of the axis about which it turns [m].
    """
    moment = np.zeros(len(record))
    for inertia, beside, storey in zip(
        _inertia(record, storeys, axis), floor_sway(record, storeys, axis), storeys, strict=False
    ):
        moment += storey.mass * felt * beside - inertia * (storey.z - about)
    return moment


def floor_sway(record: Record, storeys: Sequence[Storey], axis: str = "x") -> list[Array]:
    """Return how far each floor stands beside the girder along an axis, (n,) each [m]; none where one was not measured.

    Args:
        record: with the storeys' accelerations.
        storeys: from below.
        axis: "x" or "y".
    """
    inertia = _inertia(record, storeys, axis)
    drifts = [
        -np.sum(inertia[place:], axis=0) / getattr(storey, f"stiffness_{axis}")
        for place, storey in enumerate(storeys[: len(inertia)])
    ]
    return list(np.cumsum(drifts, axis=0)) if drifts else []


def frame_noise(specimen: Specimen, noise: Mapping[str, float]) -> tuple[float, float]:
    """Return the noise of the storeys' push along x [N], and of its moment about the centre of gravity [N m]."""
    storeys = specimen.storeys
    levels = [noise.get(name, 0.0) * s.mass for name, s in zip(storey_channels(storeys), storeys, strict=True)]
    arms = [level * (s.z - specimen.centre_height) for level, s in zip(levels, storeys, strict=True)]
    return float(np.linalg.norm(levels)), float(np.linalg.norm(arms))


def _inertia(record: Record, storeys: Sequence[Storey], axis: str) -> list[Array]:
    names = storey_channels(storeys, axis)
    if not record.has_all(*names):
        return []
    return [record[name] * storey.mass for name, storey in zip(names, storeys, strict=True)]
