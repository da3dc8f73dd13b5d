"""What the friction of a single slider may have beside mu(V), in closed form over what the machine does.

Each law takes mu (n,), the test and its size, and gives mu.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: Speed over which breakaway decays, below a slow test's [m/s]; distance of a run-in over the stroke [1]. Assumed.
DECAY, SETTLING = 0.01, 4.0


@dataclass(frozen=True)
class Drive:
    """What the machine does to a slider in one test, each (n,).

    Attributes:
        time: [s].
        slip: [m].
        velocity: [m/s].
        load: [N].
    """

    time: Array
    slip: Array
    velocity: Array
    load: Array

    def thinned(self, every: int) -> "Drive":
        """Give every n-th sample."""
        taken = slice(None, None, every)
        return Drive(self.time[taken], self.slip[taken], self.velocity[taken], self.load[taken])


def settling_distance(drive: Drive) -> float:
    """Give the distance of a run-in [m]: so many strokes."""
    return SETTLING * float(np.abs(drive.slip).max())


def asymmetry(friction: Array, drive: Drive, size: float) -> Array:
    """Friction that differs between to and fro."""
    return friction * (1.0 + size * np.sign(drive.velocity))


def run_in(friction: Array, drive: Drive, size: float) -> Array:
    """Friction that settles with the distance slid, anew in each test: sheets are changed."""
    distance = np.cumsum(np.abs(np.diff(drive.slip, prepend=drive.slip[0])))
    return friction * (1.0 + size * np.exp(-distance / settling_distance(drive)))


def breakaway(friction: Array, drive: Drive, size: float) -> Array:
    """Friction that is higher at low speed."""
    return friction + size * np.exp(-((drive.velocity / DECAY) ** 2))


def pressure(friction: Array, drive: Drive, size: float) -> Array:
    """Friction that goes with a power of the load."""
    return friction * (drive.load / drive.load.mean()) ** size


FRICTION: dict[str, Callable[[Array, Drive, float], Array]] = {
    "direction_asymmetry": asymmetry,
    "run_in": run_in,
    "breakaway": breakaway,
    "pressure_law": pressure,
}
