"""What a slider is doing at every sample: stuck, at rest, slow, lifted, at the end of its record."""

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign.aligned import long_enough, spread
from slipwise.signals.filters import LowPass

#: Slower than this for `_STUCK_SAMPLES` samples is stuck, faster than `_FAST` is sliding [m/s].
_STUCK = 3e-3
_STUCK_SAMPLES = 6
_FAST = 2e-2
#: For a slow slider the limits are these parts of its usual speed (95 % of samples are slower) [1].
_STUCK_PART, _FAST_PART = 0.05, 0.2
#: Speeds below this many times the error of the velocity are none [1].
_STUCK_ERRORS = 4.0
#: A pad with less than this part of its share at rest is lifting [1], and rings this long after it [s].
_LIFTED = 0.05
_RINGING = 0.2
#: Samples at the ends where filters and smoother see one side only.
_ENDS = 8


def is_stuck(speed: Array, error: float, scale: float = 1.0) -> Mask:
    """Tell where a slider is stuck (n,), by its speed (n,), the error of that [m/s], and the scale of speeds [1]."""
    limit = min(_STUCK * scale, _STUCK_PART * float(np.quantile(speed, 0.95)))
    limit = max(limit, _STUCK_ERRORS * error)  # a run that never slides is stuck throughout
    return long_enough(speed < limit, _STUCK_SAMPLES)


def is_at_rest(along: Array, speed: Array, error: float) -> Mask:
    """Tell where a velocity is no more than noise, (n,).

    Noise of a girder at rest adds up to a tenth of a millimetre in a second, and its contacts would seem worn out. What
    leads into a slip or out of one, in its direction, is slip down to one standard deviation.
    """
    moving = speed >= _STUCK_ERRORS * error
    way = np.where(speed > error, np.sign(along), 0.0)
    piece = np.cumsum(np.diff(way, prepend=way[:1]) != 0.0)
    slides = np.bincount(piece, weights=moving) > 0.0
    return ~moving & ~(slides[piece] & (way != 0.0))


def is_slow(speed: Array, velocity: Array, dt: float, lowpass: LowPass | None, scale: float = 1.0) -> Mask:
    """Tell where the slider is slow or has just turned, (n,)."""
    slow = speed < min(_FAST * scale, _FAST_PART * float(np.quantile(speed, 0.95)))
    turns = np.zeros(len(speed), dtype=bool)
    turns[1:] = np.signbit(velocity[1:]) != np.signbit(velocity[:-1])
    reach = int(np.ceil(0.5 / (lowpass.frequency * dt))) if lowpass else 2
    return slow | spread(turns, reach, reach)


def is_lifted(load: Array, dt: float, pads: int) -> Mask:
    """Tell where a pad of so many is lifting or still rings from it (naming: pitch is then 700 times its floor)."""
    if pads < 3 or load.shape[1] < pads or not np.isfinite(load).all():
        return np.zeros(len(load), dtype=bool)
    lifted = np.any(load < _LIFTED * np.median(load, axis=0), axis=1)
    return spread(np.asarray(lifted), 1, int(np.ceil(_RINGING / dt)))


def is_inside(count: int) -> Mask:
    """Tell which of so many samples are not at the ends."""
    inside = np.ones(count, dtype=bool)
    inside[:_ENDS] = False
    inside[-_ENDS:] = False
    return inside
