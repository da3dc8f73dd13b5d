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
    count, springs = len(specimen.pads), np.array(specimen.springs)
    if not specimen.free:
        sink = specimen.weight / specimen.springs[0]
        return Rest(specimen.seating[0] - sink, 0.0, 0.0, np.full(count, specimen.weight))
    arms = np.array(specimen.pad_places) - [specimen.centre_x, specimen.centre_y]
    shape = np.stack([-np.ones(count), -arms[:, 1], arms[:, 0]], axis=1)
    _check_sides(specimen, arms)
    seating = np.array(specimen.seating)
    touching = np.ones(count, dtype=bool)
    for _ in range(count):
        if np.linalg.matrix_rank(shape[touching]) < 3:
            break
        held = shape[touching].T * springs[touching]
        heave, roll, pitch = np.linalg.solve(
            held @ shape[touching], np.array([-specimen.weight, 0.0, 0.0]) - held @ seating[touching]
        )
        load = springs * (seating + shape @ [heave, roll, pitch])
        if np.array_equal(load > 0.0, touching):
            return Rest(float(heave), float(roll), float(pitch), np.where(touching, load, 0.0))
        touching = load > 0.0
    raise SettingError(
        f"{specimen.name}: with a centre of gravity {specimen.centre_x:g}, {specimen.centre_y:g} m off the middle "
        "and this seating the girder does not stand on at least three pads; reduce them"
    )


def _check_sides(specimen: Specimen, arms: NDArray[np.float64]) -> None:
    """Refuse pads that all stand on one side of the centre of gravity, or on one line.

    Args:
        specimen: of the pads.
        arms: (n_pads, 2) places from the centre of gravity [m].
    """
    for axis, (word, centre) in enumerate((("x", specimen.centre_x), ("y", specimen.centre_y))):
        if np.all(arms[:, axis] > 0.0) or np.all(arms[:, axis] < 0.0):
            raise SettingError(
                f"{specimen.name}: the pads cannot carry: all stand on one side of the girder's centre of gravity "
                f"({word} = {centre:g} m); it must lie between them"
            )
    if np.linalg.matrix_rank(arms - arms.mean(axis=0)) < 2:
        raise SettingError(
            f"{specimen.name}: the pads cannot carry: all stand on one line, on which the girder would tip over; place "
            "one beside it"
        )
