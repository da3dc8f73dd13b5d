"""Pads and buffers of a rig, where each stands and what it is: data, and the tables that the step loop reads."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

#: Columns of a pad's row in the loop: place, what it is, and what hides in it.
X, Y, AREA, STIFFNESS, DAMPING, HEIGHT, CURVATURE, MASS, FACTOR, PATCH, LAW = range(11)
#: Columns of a buffer's row; SIDE is +1 at y > 0 and -1 at y < 0.
BUFFER_X, BUFFER_Y, BUFFER_Z, ALONG, ACROSS, SIDE = range(6)
#: Columns of a storey's row.
FLOOR_MASS, FLOOR_Z, COLUMNS, DASHPOTS = range(4)


class Pad(NamedTuple):
    """A pad: a disc that slides, on a spring with a dashpot.

    Attributes:
        name: of its channels.
        x, y: from the middle of the table [m].
        area: of the disc [m^2].
        stiffness: vertical [N/m].
        damping: vertical [N s/m].
        height: above the sliding plane [m].
        curvature: 1/R of the sphere on which it slides, above zero for a bowl [1/m].
    """

    name: str
    x: float
    y: float
    area: float
    stiffness: float
    damping: float
    height: float = 0.0
    curvature: float = 0.0


class Buffer(NamedTuple):
    """A spring between table and girder.

    Attributes:
        name: of its channels.
        x, y: from the middle of the table [m].
        z: of its force above the sliding plane [m].
        stiffness_x, stiffness_y: [N/m].
    """

    name: str
    x: float
    y: float
    z: float
    stiffness_x: float
    stiffness_y: float


class Storey(NamedTuple):
    """A floor of a frame on the girder, on columns that stand on the floor below.

    Attributes:
        mass: of the floor [kg].
        z: its height above the sliding plane [m].
        stiffness: of the columns, along x and along y [N/m].
        damping: of the columns, along x and along y [N s/m].
    """

    mass: float
    z: float
    stiffness: float
    damping: float


class Use(NamedTuple):
    """An effect of the library's catalogue, or of a file of the same form, with its numbers.

    Attributes:
        effect: its name, or the path of the file.
        values: (parameter, value [SI]) of those that are not typical.
    """

    effect: str
    values: tuple[tuple[str, float], ...]


def pad_table(
    pads: tuple[Pad, ...], mass: float, seating: tuple[float, ...], hidden: tuple[tuple[float, ...], ...]
) -> NDArray[np.float64]:
    """Give the pads' rows (n, 11).

    Args:
        pads: of the rig.
        mass: of the girder, which pads share by their area as far as a law speaks of the load at rest [kg].
        seating: height of each pad above where it should be [m].
        hidden: factor of its friction, depth of its patch and share of the law outside the catalogue, of each pad.
    """
    areas = [pad.area for pad in pads]
    whole = math.fsum(areas)
    rows = [
        (p.x, p.y, p.area, p.stiffness, p.damping, high + p.height, p.curvature, mass * (p.area / whole), *of_pad)
        for p, high, *of_pad in zip(pads, seating, *hidden, strict=True)
    ]
    return np.array(rows, dtype=np.float64)


def buffer_table(buffers: tuple[Buffer, ...]) -> NDArray[np.float64]:
    """Give the buffers' rows (m, 6)."""
    rows = [(b.x, b.y, b.z, b.stiffness_x, b.stiffness_y, float(np.sign(b.y))) for b in buffers]
    return np.array(rows, dtype=np.float64).reshape(len(buffers), 6)


def storey_table(storeys: tuple[Storey, ...]) -> NDArray[np.float64]:
    """Give the storeys' rows (s, 4)."""
    return np.array(storeys, dtype=np.float64).reshape(len(storeys), 4)
