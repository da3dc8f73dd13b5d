"""A buffer as other programs have one: a backbone of straight pieces, a dashpot, and a loop with a yield force.

The model's own laws are asked: moved to and fro so slowly that no rate counts, they show backbone and loop; moved as in
the replay, what is left of their force goes with the rate.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.record import Record
from slipwise.simulation.predict import Predictor, predictor

#: Points of the slow way to one side, how long all of it lasts [s], and how far beyond the replay it goes [1].
_POINTS, _SLOW, _BEYOND = 400, 1e6, 1.2
#: Of its points one in so many is written of a backbone.
_THINNED = 10
#: What changes the force by less than this share of the largest one is left out [1].
_SMALL = 1e-3


@dataclass(frozen=True)
class BufferLink:
    """One direction of a buffer.

    Attributes:
        stiffness: of the backbone, as a straight line [N/m].
        backbone: (k, 2) deflection [m] and force [N]; empty where a straight line is enough.
        damping: of the dashpot [N s/m].
        loop_force: half the height of the loop, 0 for none [N].
        loop_length: deflection u in which it turns round after a reversal [m].
        rounded: whether it does so gradually, by 1 - exp(-s/u), or along a straight line.
        error: root mean square of what all this leaves of the force in the replay, over that of the force [1].
    """

    stiffness: float
    backbone: Array
    damping: float
    loop_force: float
    loop_length: float
    rounded: bool
    error: float


def link_buffers(model: Model, record: Record) -> list[tuple[BufferLink, BufferLink]]:
    """Return each buffer along x and along y, in the order of the rig, for the slip of a record."""
    specimen = model.built_specimen()
    if not specimen.buffers:
        return []
    places, heights = np.array(specimen.buffer_places), np.array(specimen.buffer_heights)
    still = np.zeros(len(record.time))
    slip_x, slip_y, yaw, pitch, roll = (
        record[name][:, None] if name in record else still[:, None]
        for name in ("slip_x", "slip_y", "yaw", "pitch", "roll")
    )
    moved = np.stack(
        [slip_x - yaw * places[:, 1] + pitch * heights, slip_y + yaw * places[:, 0] - roll * heights], axis=2
    )
    rate = np.gradient(moved, record.time, axis=0)
    largest = _BEYOND * float(np.abs(moved).max()) or 1e-3
    law = predictor(model)
    force = law.buffers(record.time, moved, rate)
    up, down, first = _to_and_fro(law, largest, len(places))
    return [
        (
            _link(largest, up[:, i, 0], down[:, i, 0], first[:, i, 0], moved[:, i, 0], rate[:, i, 0], force[:, i, 0]),
            _link(largest, up[:, i, 1], down[:, i, 1], first[:, i, 1], moved[:, i, 1], rate[:, i, 1], force[:, i, 1]),
        )
        for i in range(len(places))
    ]


def _to_and_fro(law: Predictor, largest: float, count: int) -> tuple[Array, Array, Array]:
    """Return the forces (2 points + 1, count, 2) of a slow way: up and down, and down again after a reversal.

    The first two over deflections from the lowest to the largest, of a loop that goes twice as far, so that it has
    turned round before; the last from a reversal at the largest deflection on downwards.
    """
    law.reset()
    step, points = largest / _POINTS, _POINTS
    turns = np.array([0, 2, -2, 1, -1]) * points
    way = np.concatenate([[0], *(_steps(a, b) for a, b in zip(turns[:-1], turns[1:], strict=True))]) * step
    time = np.linspace(0.0, _SLOW, len(way))
    moved = np.repeat(way[:, None], 2 * count, axis=1).reshape(-1, count, 2)
    force = law.buffers(time, moved, np.asarray(np.gradient(moved, time, axis=0)))
    law.reset()
    down = force[3 * points : 5 * points + 1][::-1]
    return force[7 * points : 9 * points + 1], down, force[9 * points :]


def _steps(first: int, last: int) -> Array:
    """Return the whole numbers from one to the other, the first left out."""
    sign = 1 if last > first else -1
    return np.arange(first + sign, last + sign, sign, dtype=float)


def _link(largest: float, up: Array, down: Array, gone: Array, moved: Array, rate: Array, force: Array) -> BufferLink:
    """Return what one direction of a buffer is, from its slow loop and from the replay."""
    leg = np.linspace(-largest, largest, len(up))
    backbone = 0.5 * (up + down)
    half = float(np.median(0.5 * (up - down)))
    peak = float(np.abs(backbone).max())
    length, rounded = 0.0, False
    if half > _SMALL * peak:
        length, rounded = _turn((gone - backbone[::-1]) / half, float(leg[1] - leg[0]))
    else:
        half = 0.0
    stiffness = float(leg @ backbone / (leg @ leg))
    straight = bool(np.abs(backbone - stiffness * leg).max() <= _SMALL * peak)
    points = np.empty((0, 2)) if straight else np.stack([leg, backbone], axis=1)[::_THINNED]
    left = force - (stiffness * moved if straight else np.interp(moved, points[:, 0], points[:, 1]))
    if half:
        left = left - half * _along_loop(moved / length, rounded)
    fast = float(np.abs(rate).max(initial=0.0))
    damping = float(left @ rate / (rate @ rate)) if fast > 0.0 else 0.0
    if damping * fast <= _SMALL * peak:
        damping = 0.0
    whole = float(np.sqrt(np.mean(force**2)))
    error = float(np.sqrt(np.mean((left - damping * rate) ** 2))) / whole if whole > 0.0 else 0.0
    return BufferLink(stiffness, points, damping, half, length, rounded, error)


def _turn(loop: Array, step: float) -> tuple[float, bool]:
    """Return how a loop turns round after a reversal: length u [m], and whether gradually.

    Args:
        loop: (n,) force of the loop over its half height, from +1 at the reversal to -1 [1].
        step: deflection between its values [m].
    """
    crossed = int(np.argmax(loop <= 0.0))
    if crossed == 0:
        return step, False
    zero = crossed - loop[crossed] / (loop[crossed] - loop[crossed - 1])
    # twice as far a straight line has reached -1, an exponential only -1/2
    rounded = bool(np.interp(2.0 * zero, np.arange(len(loop)), loop) > -0.75)
    return float(zero * step / (np.log(2.0) if rounded else 1.0)), rounded


def _along_loop(way: Array, rounded: bool) -> Array:
    """Return the force of a loop over its half height (n,) along deflections (n,) over its length [1]."""
    out, z = np.zeros(len(way)), 0.0
    for place, moved in enumerate(np.diff(way, prepend=0.0)):
        if rounded:
            sign = 1.0 if moved > 0.0 else -1.0
            z = sign * (1.0 - (1.0 - sign * z) * np.exp(-abs(moved)))
        else:
            z = min(max(z + moved, -1.0), 1.0)
        out[place] = z
    return out
