"""A frame above the girder: a shear building, whose floors are masses that move sideways on springs and dampers."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import SettingError
from slipwise.rig.bounds import out_of_bounds

Array = NDArray[np.float64]
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


def fixed_base_frequencies(storeys: Sequence[Storey], axis: str = "x") -> Array:
    """Give the natural frequencies of the frame on a base that does not move (n,) [Hz], lowest first."""
    stiffness = np.array([getattr(storey, f"stiffness_{axis}") for storey in storeys])
    above = np.append(stiffness[1:], 0.0)
    matrix = np.diag(stiffness + above) - np.diag(stiffness[1:], 1) - np.diag(stiffness[1:], -1)
    scale = 1.0 / np.sqrt([storey.mass for storey in storeys])
    return np.sqrt(np.maximum(np.linalg.eigvalsh(matrix * scale[:, None] * scale), 0.0)) / (2.0 * np.pi)
