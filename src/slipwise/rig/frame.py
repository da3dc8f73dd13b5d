"""What the storeys on a girder push it, from their measured accelerations.

    force  -sum m_i a_i                moment about a height h   -sum m_i a_i (z_i - h) + sum m_i (g + a_z) u_i

u_i is how far floor i stands beside the girder: what its columns carry over their stiffness, damping left out.

Source: d'Alembert on a shear building; Chopra, Dynamics of Structures, chapter 9.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from slipwise.record import Record
from slipwise.rig.mjcf_writer import storey_names
from slipwise.rig.specimen import Specimen

Array = NDArray[np.float64]


def storey_channels(specimen: Specimen, axis: str = "x") -> tuple[str, ...]:
    """Give the channels of the storeys' accelerations along an axis, from below."""
    return tuple(f"{name}_a{axis}" for name in storey_names(specimen))


def frame_push(record: Record, specimen: Specimen, axis: str = "x") -> Array:
    """Give the force of the storeys on the girder along an axis (n,) [N]; nothing where not all were measured."""
    return -np.sum([np.zeros(len(record)), *_inertia(record, specimen, axis)], axis=0)


def frame_moment(record: Record, specimen: Specimen, upward: Array, axis: str = "x", about: float = 0.0) -> Array:
    """Give the moment of the storeys on the girder (n,) [N m], positive where it loads the pads at the + end.

    Nothing where not all storeys were measured.

    Args:
        record: with the storeys' accelerations.
        specimen: of the storeys.
        upward: (n,) acceleration of the girder upwards [m/s^2].
        axis: "x" or "y", along which they push.
        about: height above the sliding plane of the axis about which it turns [m].
    """
    inertia, moment, beside = _inertia(record, specimen, axis), np.zeros(len(record)), np.zeros(len(record))
    for place, (own, storey) in enumerate(zip(inertia, specimen.storeys, strict=False)):
        beside = beside - np.sum(inertia[place:], axis=0) / getattr(storey, f"stiffness_{axis}")
        moment += storey.mass * (specimen.gravity + upward) * beside - own * (storey.z - about)
    return moment


def frame_noise(specimen: Specimen, noise: Mapping[str, float]) -> tuple[float, float]:
    """Give the noise of the storeys' push along x [N], and of its moment about the centre of gravity [N m]."""
    levels = [
        noise.get(name, 0.0) * s.mass for name, s in zip(storey_channels(specimen), specimen.storeys, strict=True)
    ]
    arms = [level * (s.z - specimen.centre_height) for level, s in zip(levels, specimen.storeys, strict=True)]
    return float(np.linalg.norm(levels)), float(np.linalg.norm(arms))


def _inertia(record: Record, specimen: Specimen, axis: str) -> list[Array]:
    names = storey_channels(specimen, axis)
    if not record.has_all(*names):
        return []
    return [record[name] * storey.mass for name, storey in zip(names, specimen.storeys, strict=True)]
