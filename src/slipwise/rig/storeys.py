"""A frame above the girder: a shear building, whose floors are masses that move sideways on springs and dampers."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.rig.bounds import out_of_bounds

#: Most storeys that a frame may have: MuJoCo keeps its matrices whole up to 60 degrees of freedom.
MOST_STOREYS = 20


@dataclass(frozen=True)
class Storey:
    """A floor, and the columns on which it stands on the floor below, the lowest on the girder.

    Attributes:
        mass: of the floor, lumped above the girder's centre of gravity [kg].
        z: its height above the sliding plane [m].
        stiffness_x: of the columns along x [N/m].
        stiffness_y: along y [N/m].
        damping_x: along x [N s/m].
        damping_y: along y [N s/m].
    """

    mass: float
    z: float
    stiffness_x: float
    stiffness_y: float
    damping_x: float
    damping_y: float


def check_storeys(rig: str, storeys: Sequence[Storey], base: float) -> None:
    """Refuse values that no storey has, and one that is not above the one before, from the height `base` [m] on.

    Raises:
        SettingError: the message gives the number of the storey.
    """
    if len(storeys) > MOST_STOREYS:
        raise SettingError(f"{rig}: it has {len(storeys)} storeys; at most {MOST_STOREYS} are possible")
    below = base
    for number, storey in enumerate(storeys, 1):
        values = {
            "mass": storey.mass,
            "storey_height": storey.z,
            "storey_stiffness": (storey.stiffness_x, storey.stiffness_y),
            "storey_damping": (storey.damping_x, storey.damping_y),
        }
        for name, value in values.items():
            if wrong := out_of_bounds(name, value):
                raise SettingError(f"{rig}, storey {number}: {wrong}")
        if storey.z < below:
            raise SettingError(
                f"{rig}, storey {number}: it stands at {storey.z:g} m, below what it stands on, at {below:g} m; list "
                "storeys from below, with z from the sliding plane"
            )
        below = storey.z


@dataclass(frozen=True)
class FrameMode:
    """One natural mode of a frame on a base that does not move.

    Attributes:
        frequency: [Hz].
        damping: its share of critical [1].
        shape: (n_storeys,) displacement of the floors for a modal mass of one [kg^-1/2].
        share: sum of mass times shape: its square is the mass that sways with the base in this mode [kg^1/2].
    """

    frequency: float
    damping: float
    shape: Array
    share: float


def frame_modes(storeys: Sequence[Storey], axis: str = "x") -> list[FrameMode]:
    """Return the modes of a frame on a base that does not move, lowest first; what dampers couple is left out.

    Source: Chopra, Dynamics of Structures, chapters 10 and 11.
    """
    masses = np.array([storey.mass for storey in storeys])
    scale = 1.0 / np.sqrt(masses)
    stiffness, damping = (
        _chained([getattr(storey, f"{of}_{axis}") for storey in storeys]) * scale[:, None] * scale
        for of in ("stiffness", "damping")
    )
    squared, shapes = np.linalg.eigh(stiffness)
    turn = np.sqrt(np.maximum(squared, 0.0))
    ratios = np.sum(shapes * (damping @ shapes), axis=0) / (2.0 * turn)
    return [
        FrameMode(float(w / (2.0 * np.pi)), float(z), scale * shape, float(masses @ (scale * shape)))
        for w, z, shape in zip(turn, ratios, shapes.T, strict=True)
    ]


def fixed_base_frequencies(storeys: Sequence[Storey], axis: str = "x") -> Array:
    """Return the natural frequencies of the frame on a base that does not move (n,) [Hz], lowest first."""
    return np.array([mode.frequency for mode in frame_modes(storeys, axis)])


def _chained(links: Sequence[float]) -> Array:
    """Return the matrix of floors each linked to the one below, the lowest to the base."""
    below = np.array(links)
    above = np.append(below[1:], 0.0)
    return np.diag(below + above) - np.diag(below[1:], 1) - np.diag(below[1:], -1)
