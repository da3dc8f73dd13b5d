"""The two sliding branches of a closed loop: their distance and slope, and where friction has turned round.

Branches are lines fitted over the middle half of the stroke, where speed is nearly the same, so that friction that
falls with the speed towards a turn is not taken for stiffness.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array, Mask
from slipwise.bearings.loops import Loop

#: Part of the stroke over which a branch is fitted, and within which the force at the largest slip is taken [1].
_MIDDLE, _NEAR_TURN = 0.5, (0.9, 0.99)
#: Parts of half the stroke, at the ends of the middle half and in the middle; least ratio of the widths there [1].
_AT_ENDS, _AT_MIDDLE, _AS_WIDE = (0.4, 0.5), (0.0, 0.1), 0.8


def fit_sliding_branches(loop: Loop) -> tuple[Array, Array]:
    """Return half the distance of the branches at zero slip [N], and their mean slope [N/m], (d,) each."""
    inside = is_in_the_middle(loop)
    (up, rise), (down, fall) = (_line(loop, inside & (loop.direction == sign)) for sign in (1.0, -1.0))
    return 0.5 * (up - down), 0.5 * (rise + fall)


def is_in_the_middle(loop: Loop) -> Mask:
    """Tell which samples lie in the middle half of the stroke (m,)."""
    middle, half = _middle(loop)
    return np.abs(loop.slip - middle) <= _MIDDLE * half


def shows_sliding_alone(loop: Loop) -> bool:
    """Return whether the loop is nearly as wide at both ends of the middle half of the stroke as in its middle.

    It is not where friction turns round over so much of the stroke, by elastic parts or play, that branches bend there.
    """
    middle, half = _middle(loop)
    share = np.abs(loop.slip - middle) / half
    carried = np.isfinite(loop.load).all() and bool(np.all(loop.load > 0.0))
    force = loop.force[:, 0] / (loop.load if carried else 1.0)  # a load that varies makes friction vary with it
    widths = []
    for low, high in (_AT_ENDS, _AT_MIDDLE):
        inside = (share >= low) & (share <= high)
        both = [force[inside & (loop.direction == sign)] for sign in (1.0, -1.0)]
        if any(len(one) == 0 for one in both):
            return False
        widths.append(float(both[0].mean() - both[1].mean()))
    return widths[0] > _AS_WIDE * widths[1] > 0.0


def find_turned_round(loop: Loop, turn: int, other: int, size: Array, strength: float) -> NDArray[np.int64]:
    """Return the samples of a branch from where friction has reached half its strength in the new direction.

    Args:
        loop: closed.
        turn: sample at which the branch begins.
        other: sample of the other turn; the later branch goes on to the end of the cycle.
        size: (m,) friction, positive in the direction of the branch [N].
        strength: half the distance of the branches [N].
    """
    order = np.arange(turn, other + 1 if other > turn else len(loop.slip))
    there = size[order] > 0.5 * strength
    return order[int(np.argmax(there)) :] if there.any() else order[:0]


def force_at_turn(loop: Loop, turn: int, slope: Array) -> Array:
    """Return the force of sliding up to a turn (d,) [N], the branch prolonged to it by its slope (d,) [N/m].

    At the turn itself friction has any value.
    """
    middle, half = _middle(loop)
    towards = float(np.sign(loop.slip[turn] - middle))
    share = towards * (loop.slip - middle) / half
    before = np.arange(len(share)) < turn
    near = before & (loop.direction == towards) & (share > _NEAR_TURN[0]) & (share < _NEAR_TURN[1])
    if not near.any():
        near = np.arange(len(share)) == max(turn - 1, 0)
    return loop.force[near].mean(axis=0) + slope * float(loop.slip[turn] - loop.slip[near].mean())


def _middle(loop: Loop) -> tuple[float, float]:
    """Return the middle of the stroke and half of it [m]."""
    low, high = float(loop.slip.min()), float(loop.slip.max())
    return 0.5 * (low + high), 0.5 * (high - low)


def _line(loop: Loop, kept: Mask) -> tuple[Array, Array]:
    """Return level at zero and slope of a line through some samples, weighed by their way; NaN through fewer than 3."""
    weight, place = np.abs(np.gradient(loop.slip))[kept], loop.slip[kept] - loop.zero
    if np.count_nonzero(weight) < 3:
        nothing = np.full(loop.force.shape[1], np.nan)
        return nothing, nothing
    weight = weight / weight.sum()
    off = place - weight @ place
    slope = ((weight * off) @ loop.force[kept]) / float(weight @ off**2)
    return weight @ loop.force[kept] - slope * float(weight @ place), slope
