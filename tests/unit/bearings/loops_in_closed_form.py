"""Loops of bearings in closed form: slip, force, and the quantities that follow from their numbers."""

from dataclasses import dataclass

import numpy as np

from slipwise.bearings.cycles import find_cycles
from slipwise.bearings.loops import Loop

LOAD, AREA = 1.0e5, 0.01
STRENGTH, AMPLITUDE, RESTORING = 5.0e3, 0.05, 2.0e4
#: Elastic slip of the trapezoid, and the length over which Bouc and Wen's loop turns round [m].
ELASTIC, LENGTH = 0.002, 0.004


@dataclass(frozen=True)
class Known:
    """Quantities of a steady cycle."""

    energy: float
    strength: float = STRENGTH
    restoring: float = RESTORING

    @property
    def stiffness(self) -> float:
        return self.strength / AMPLITUDE + self.restoring

    @property
    def damping(self) -> float:
        return self.energy / (2.0 * np.pi * self.stiffness * AMPLITUDE**2)


KNOWN = {
    "coulomb": Known(4.0 * STRENGTH * AMPLITUDE),
    "trapezoid": Known(4.0 * STRENGTH * (AMPLITUDE - 0.5 * ELASTIC)),
    "bouc-wen": Known(4.0 * STRENGTH * (AMPLITUDE - LENGTH * np.tanh(AMPLITUDE / LENGTH))),
}


def motion(cycles: float = 4.0, rate: float = 400.0, sign: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Give time and slip of a sine of 1 Hz that begins at zero."""
    time = np.arange(0.0, cycles + 0.5 / rate, 1.0 / rate)
    return time, sign * AMPLITUDE * np.sin(2.0 * np.pi * time)


def friction(kind: str, slip: np.ndarray, elastic: float = ELASTIC) -> np.ndarray:
    """Give the friction force over a path of slip, without the restoring part."""
    step = np.diff(slip, prepend=slip[0])
    if kind == "coulomb":
        return STRENGTH * np.sign(np.gradient(slip))
    share = np.zeros(len(slip))
    for i in range(1, len(slip)):
        if kind == "trapezoid":  # the force turns round from -Q to Q over the elastic slip
            share[i] = np.clip(share[i - 1] + 2.0 * step[i] / elastic, -1.0, 1.0)
        else:  # Bouc and Wen's dz/dx = (1 - z sgn v) / length
            end = np.sign(step[i])
            share[i] = end + (share[i - 1] - end) * np.exp(-abs(step[i]) / LENGTH)
    return STRENGTH * share


def loop_of(time: np.ndarray, slip: np.ndarray, force: np.ndarray, offset: float = 0.0) -> Loop:
    """Make the loop of one bearing under a constant load."""
    velocity = np.stack([np.gradient(slip, time), np.zeros(len(time))], axis=1)
    load = np.full(len(time), LOAD)
    return Loop("A", find_cycles(slip).zero, slip, velocity, load, AREA, (force + offset)[:, None])
