"""How a girder rocks on its pads: two modes of pitch and roll, which move together where pads stand unevenly.

With moments E about the middle of the springs as (roll, pitch), slopes a by which pads are compressed, stiffness
K = sum k (y, x)(y, x)^T and inertia J about the centre of gravity:

    J a'' + K (a + t a') = E,        moments of the loads Q = K (a + t a') = sum_j J v_j v_j^T P_j E

with K v_j = w_j^2 J v_j, v_j^T J v_j = 1 and P_j = w_j^2 (1 + t s) / (s^2 + t w_j^2 s + w_j^2): a mode's fraction of
critical damping goes with its frequency. Source: Clough & Penzien (1975), damping in proportion to stiffness.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from slipwise.arrays import Array
from slipwise.rig.specimen import Specimen

#: Coupling below this part of the two stiffnesses is rounding of places [1].
_NONE = 1e-9


@dataclass(frozen=True)
class RockingMode:
    """One of the two.

    Attributes:
        ratio: its frequency, and fraction of critical damping, over those of the pitch [1].
        drive: what of the moments (roll, pitch) shakes it, (2,).
        shown: moments (roll, pitch) of the loads for that, (2,).
    """

    ratio: float
    drive: Array
    shown: Array


def rocking_modes(specimen: Specimen) -> tuple[RockingMode, RockingMode]:
    """Return the modes of a specimen: the one that is mostly roll, and the one that is mostly pitch."""
    off = np.array(specimen.pad_places) - specimen.middle
    arms, inertia = off[:, ::-1], np.diag(specimen.inertia[:2])
    stiffness = (arms * np.array(specimen.springs)[:, None]).T @ arms
    if abs(stiffness[0, 1]) < _NONE * np.sqrt(stiffness[0, 0] * stiffness[1, 1]):
        ratio = float(np.sqrt(stiffness[0, 0] / inertia[0, 0] / (stiffness[1, 1] / inertia[1, 1])))
        roll, pitch = np.eye(2)
        return RockingMode(ratio, roll, roll), RockingMode(1.0, pitch, pitch)
    squares, vectors = eigh(stiffness, inertia)
    main = int(np.argmax(vectors[1] ** 2))
    other = 1 - main
    ratio = float(np.sqrt(squares[other] / squares[main]))
    first, second = (RockingMode(r, vectors[:, j], inertia @ vectors[:, j]) for r, j in ((ratio, other), (1.0, main)))
    return first, second


def rolls(specimen: Specimen) -> bool:
    """Return whether motion along x and upwards makes the girder roll: uneven pads, or a weight off their middle."""
    off = specimen.centre_y - specimen.middle[1]
    return coupled(specimen) or abs(off) > _NONE * specimen.half_spacing[1]


def coupled(specimen: Specimen) -> bool:
    """Return whether pitch makes the girder roll."""
    return bool(rocking_modes(specimen)[1].drive[0] != 0.0)
