"""A mass on a spring and a damper, pushed by a sampled signal."""

from functools import lru_cache
from typing import Any, cast

import numpy as np

from slipwise.arrays import Array


def oscillator(push: Array, dt: float, frequency: float, damping: float, derivative: int) -> Array:
    """Solve q'' + 2 z w q' + w^2 q = push from rest, for a push that is smooth between its samples.

    Args:
        push: (n,) per unit mass.
        dt: sampling step [s].
        frequency: w / (2 pi) [Hz].
        damping: z, of critical [1].
        derivative: 0 gives q, 1 gives q', 2 gives q''.

    Returns:
        (n,).
    """
    from scipy.signal import lfilter  # here, for it takes long to load and few models have an oscillator

    w = 2.0 * np.pi * frequency
    curved = push.copy()
    # Straight lines between samples cut the crests of a sine by (pi f dt)^2 / 3: 0.3 % at 15 Hz and 2 ms.
    curved[1:-1] -= (push[2:] - 2.0 * push[1:-1] + push[:-2]) / 12.0

    def solved(order: int) -> Array:
        return cast(Array, lfilter(*_discrete(order, dt, w, damping), curved))

    if derivative < 2:
        return solved(derivative)
    return push - 2.0 * damping * w * solved(1) - w * w * solved(0)


@lru_cache(maxsize=64)
def _discrete(order: int, dt: float, w: float, damping: float) -> tuple[Array, Array]:
    """Return numerator and denominator of q's derivative of this order, for a push that is straight between samples."""
    from scipy.signal import cont2discrete

    system = ([1.0] + [0.0] * order, [1.0, 2.0 * damping * w, w * w])
    numerator, denominator, _ = cast(Any, cont2discrete(system, dt, method="foh"))
    return numerator.ravel(), denominator
