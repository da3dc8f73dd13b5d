"""Coefficients of friction of a loop: at breakaway and at peak speed, each of the force without its restoring part.

Of the two directions of sliding a mean is taken, so that the zero of a force gauge drops out. Friction along x goes
with the share of the speed that is along x.

Source: EN 1337-2:2004, Annex D (static coefficient: of the first movement; dynamic: while it slides).
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array, Mask
from slipwise.bearings.loops import Loop

#: Part of the stroke, after friction has turned round, within which it breaks away [1].
_BREAKAWAY = 0.05
#: At peak speed: not slower than this share of it [1].
_FASTEST = 0.95
#: Neighbours whose mean speed counts there.
_SMOOTHED = 5
#: A pad that carries less than this share of its mean load says nothing of a coefficient [1].
_CARRIES = 0.05
#: A record that begins faster than this share of its peak speed does not show the first movement [1].
_BEGINS_AT_REST = 0.1
#: Friction along x of a pad that slides mostly across is divided by no less than this share [1].
_LEAST_ALONG = 0.5


def take_restoring_out(loop: Loop, slope: Array) -> Array:
    """Return friction: the force without k x, over its share along x, (m, d) [N].

    Args:
        loop: of a cycle or a run.
        slope: k, (d,) [N/m]; NaN counts as 0.
    """
    restoring = np.outer(loop.slip - loop.zero, np.nan_to_num(slope))
    return (loop.force - restoring) / np.maximum(loop.along, _LEAST_ALONG)[:, None]


def fit_restoring_stiffness(loop: Loop) -> Array:
    """Return k of F = mu N sign(v) + k x by least squares over the way, (d,) [N/m]; 0 where loads are not known."""
    weight = np.sqrt(np.abs(np.gradient(loop.slip)))
    columns = np.stack([loop.load * loop.direction * loop.along, loop.slip - loop.zero], axis=1) * weight[:, None]
    if not np.isfinite(columns).all():
        return np.zeros(loop.force.shape[1])
    scale = np.sqrt(np.mean(columns**2, axis=0))
    scale[scale == 0.0] = 1.0
    found = np.linalg.lstsq(columns / scale, loop.force * weight[:, None], rcond=None)[0]
    return found[1] / scale[1]


def breakaway(loop: Loop, size: Array, order: NDArray[np.int64]) -> tuple[Array, Array]:
    """Return the largest coefficient soon after friction has turned round, and the pressure there [Pa], (d,) each.

    Args:
        loop: of a cycle.
        size: (m, d) friction, positive in the direction of sliding [N].
        order: samples from where it has turned round; none gives NaN.
    """
    if len(order) == 0:
        return _nothing(size)
    return _largest(loop, size, order)


def first_breakaway(loop: Loop, friction: Array, typical: Array) -> tuple[Array, Array]:
    """Return the largest coefficient of the first movement, and the pressure there [Pa], (d,) each.

    Args:
        loop: of a run; one that does not begin at rest gives NaN.
        friction: (m, d) [N].
        typical: (d,) mean coefficient of the run; the first movement begins when friction has reached half of it.
    """
    away = loop.slip - loop.slip[0]
    clear = np.abs(away) > _BREAKAWAY * float(np.ptp(loop.slip))
    if not clear.any() or loop.speed[:3].max() > _BEGINS_AT_REST * loop.speed.max():
        return _nothing(friction)
    sign = float(np.sign(away[np.argmax(clear)]))
    back = clear & (sign * away < 0.0)
    end = int(np.argmax(back)) if back.any() else len(away)
    end = int(np.argmax(sign * away[:end])) + 1  # where the first movement turns
    begun = sign * friction[:end, 0] > 0.5 * typical[0] * loop.load[:end]
    if not begun.any():
        return _nothing(friction)
    order = np.arange(int(np.argmax(begun)), end)
    return _largest(loop, sign * friction, order)


def is_fastest(loop: Loop, kept: Mask) -> Mask:
    """Tell which of the samples kept (m,) are as fast as the fastest of them."""
    speed = np.convolve(loop.speed, np.ones(_SMOOTHED) / _SMOOTHED, "same")  # or noise of the speed would choose
    return kept & (speed >= _FASTEST * speed[kept].max(initial=0.0))


def at_peak_speed(loop: Loop, friction: Array, fastest: Mask) -> Array:
    """Return friction (m, d) [N] over load at the fastest samples (m,), the mean of both directions, (d,) [1]."""
    parts = []
    for sign in (1.0, -1.0):
        kept = fastest & (loop.direction == sign)
        if kept.any():
            parts.append(sign * friction[kept].sum(axis=0) / (float(loop.load[kept].sum()) or np.nan))
    return np.mean(parts, axis=0)


def _largest(loop: Loop, size: Array, order: NDArray[np.int64]) -> tuple[Array, Array]:
    """Return the largest coefficient of three neighbours together on the way of a breakaway, and the pressure there.

    Args:
        loop: of a cycle or a run.
        size: (m, d) friction, positive in the direction of sliding [N].
        order: samples that follow each other, from where the way begins.
    """
    kept = order[np.abs(loop.slip[order] - loop.slip[order[0]]) <= _BREAKAWAY * float(np.ptp(loop.slip))]
    size, load = size[kept], loop.load[kept]
    if len(load) >= 3:  # one sample alone would be the largest by its noise
        size, load = (size[2:] + size[1:-1] + size[:-2]) / 3.0, (load[2:] + load[1:-1] + load[:-2]) / 3.0
    carried = load > _CARRIES * float(np.mean(loop.load))
    if not carried.any():
        return _nothing(size)
    shares = size[carried] / load[carried, None]
    place = int(shares[:, 0].argmax())  # of all forces: what a law's other numbers change is taken there
    return shares[place], np.full(size.shape[1], load[carried][place] / loop.area)


def _nothing(values: Array) -> tuple[Array, Array]:
    nothing = np.full(values.shape[1], np.nan)
    return nothing, nothing
