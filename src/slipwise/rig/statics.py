"""How the girder stands on its pads at rest: the start of every simulation."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import SettingError
from slipwise.rig.specimen import Specimen


@dataclass(frozen=True)
class Rest:
    """Equilibrium under weight alone.

    Attributes:
        heave: height of the girder over unloaded pads [m], negative.
        roll: [rad].
        pitch: [rad].
        load: (n_pads,) [N].
    """

    heave: float
    roll: float
    pitch: float
    load: NDArray[np.float64]


def at_rest(specimen: Specimen) -> Rest:
    """Solve the equilibrium of a rigid girder on springs that cannot pull.

    Pad i is pressed by seating_i - heave - roll y_i + pitch x_i; loads and moments about the centre of gravity balance.

    Raises:
        SettingError: the girder would tip over or stand on fewer than three pads.
    """
    count = len(specimen.pads)
    if not specimen.free:
        sink = specimen.weight / count / specimen.pad_stiffness
        return Rest(specimen.seating[0] - sink, 0.0, 0.0, np.full(count, specimen.weight / count))
    arms = np.array(specimen.pad_places) - [specimen.centre_x, specimen.centre_y]
    shape = np.stack([-np.ones(count), -arms[:, 1], arms[:, 0]], axis=1)
    seating = np.array(specimen.seating)
    touching = np.ones(count, dtype=bool)
    for _ in range(count):
        if touching.sum() < 3:
            break
        stiffness = specimen.pad_stiffness * shape[touching].T @ shape[touching]
        push = specimen.pad_stiffness * shape[touching].T @ seating[touching]
        heave, roll, pitch = np.linalg.solve(stiffness, np.array([-specimen.weight, 0.0, 0.0]) - push)
        load = specimen.pad_stiffness * (seating + shape @ [heave, roll, pitch])
        if np.array_equal(load > 0.0, touching):
            return Rest(float(heave), float(roll), float(pitch), np.where(touching, load, 0.0))
        touching = load > 0.0
    raise SettingError(
        f"{specimen.name}: with a centre of gravity {specimen.centre_x:g}, {specimen.centre_y:g} m off the middle "
        "and this seating the girder does not stand on at least three pads; reduce them"
    )
