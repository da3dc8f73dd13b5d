"""A block that slides, sticks and heaves on its pads, integrated from event to event: what a replay is held against.

Coordinates relative to the table: slip x [m] and heave z [m] (zero where the unloaded pads just touch). The block does
not rock, so that all pads carry alike; they never lift. Its table moves as a replay's does: its acceleration is joined
by straight lines between the samples. Between events (sliding stops, stick gives way) the equations are smooth and are
integrated by the classical Runge-Kutta method in steps of 50 us; events are located to 1e-13 of a step.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from slipwise.rig import Specimen

G = 9.80665
_STEP = 5e-5


@dataclass(frozen=True)
class Friction:
    """mu = slow + fast (1 - exp(-V rate)) share(P), share = (1 - exp(-k P)) / (k P) of the real area, or 1 if k is 0.

    Attributes:
        slow: coefficient at rest [1].
        fast: what speed adds at small pressure [1].
        rate: how soon speed adds it [s/m].
        saturation: k [1/Pa].
    """

    slow: float
    fast: float = 0.0
    rate: float = 0.0
    saturation: float = 0.0


def integrate(specimen: Specimen, friction: Friction, acceleration: np.ndarray, dt: float) -> np.ndarray:
    """Integrate from rest on the pads.

    Args:
        specimen: whose mass, pads' springs, dampers and area are taken.
        friction: of the pads.
        acceleration: (n, 3) of the table [m/s^2].
        dt: step of the samples [s].

    Returns:
        (n,) slip along x at the samples [m].
    """
    numbers = np.array([
        specimen.mass, sum(specimen.springs), sum(p.damping for p in specimen.places), sum(specimen.pad_areas),
        friction.slow, friction.fast, friction.rate, friction.saturation,
    ])  # fmt: skip
    return _integrate(numbers, np.ascontiguousarray(acceleration), dt, max(round(dt / _STEP), 1))


@njit
def _most(numbers, speed, heave, rate):
    """Deceleration that friction can give [m/s^2]."""
    load = max(-numbers[1] * heave - numbers[2] * rate, 0.0)
    pressure = load / numbers[3]
    share = 1.0
    if numbers[7] > 0.0 and pressure > 0.0:
        share = -np.expm1(-numbers[7] * pressure) / (numbers[7] * pressure)
    return (numbers[4] + numbers[5] * share * -np.expm1(-numbers[6] * abs(speed))) * load / numbers[0]


@njit
def _rate(numbers, state, sense, along, up):
    out = np.empty(4)
    out[0] = state[1]
    out[1] = -along - sense * _most(numbers, state[1], state[2], state[3]) if sense != 0 else 0.0
    out[2] = state[3]
    out[3] = -G - up + (-numbers[1] * state[2] - numbers[2] * state[3]) / numbers[0]
    return out


@njit
def _stepped(numbers, state, sense, table, slope, h):
    middle, end = table + 0.5 * h * slope, table + h * slope
    k1 = _rate(numbers, state, sense, table[0], table[1])
    k2 = _rate(numbers, state + 0.5 * h * k1, sense, middle[0], middle[1])
    k3 = _rate(numbers, state + 0.5 * h * k2, sense, middle[0], middle[1])
    k4 = _rate(numbers, state + h * k3, sense, end[0], end[1])
    return state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


@njit
def _left(numbers, state, sense, along):
    """What is above zero until the next event: speed in the old sense, or what friction can hold and need not."""
    if sense != 0:
        return sense * state[1]
    return _most(numbers, 0.0, state[2], state[3]) - abs(along)


@njit
def _integrate(numbers, acceleration, dt, parts):
    out = np.zeros(len(acceleration))
    state = np.array([0.0, 0.0, -numbers[0] * G / numbers[1], 0.0])
    sense, h = 0, dt / parts
    for i in range(len(acceleration) - 1):
        table = np.array([acceleration[i, 0], acceleration[i, 2]])
        slope = (np.array([acceleration[i + 1, 0], acceleration[i + 1, 2]]) - table) / dt
        for part in range(parts):
            done = 0.0
            for _ in range(4):  # events of one part
                here = table + (part * h + done) * slope
                end = _stepped(numbers, state, sense, here, slope, h - done)
                if _left(numbers, end, sense, here[0] + (h - done) * slope[0]) >= 0.0:
                    state = end
                    break
                low, high = 0.0, h - done
                for _ in range(60):
                    middle = 0.5 * (low + high)
                    trial = _stepped(numbers, state, sense, here, slope, middle)
                    if _left(numbers, trial, sense, here[0] + middle * slope[0]) >= 0.0:
                        low = middle
                    else:
                        high = middle
                state = _stepped(numbers, state, sense, here, slope, high)
                along = here[0] + high * slope[0]
                state[1] = 0.0
                holds = abs(along) < _most(numbers, 0.0, state[2], state[3])
                sense = 0 if sense != 0 and holds else (-1 if along > 0.0 else 1)
                done += high
        out[i + 1] = state[0]
    return out
