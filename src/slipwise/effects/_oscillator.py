"""A mass on a spring and a damper, pushed by a sampled signal."""

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.signal import cont2discrete, lfilter

Array = NDArray[np.float64]


def oscillator(push: Array, dt: float, frequency: float, damping: float, derivative: int) -> Array:
    """Solve q'' + 2 z w q' + w^2 q = push from rest; exact for a push that is straight between samples.

    Args:
        push: (n,) per unit mass.
        dt: sampling step [s].
        frequency: w / (2 pi) [Hz].
        damping: z, of critical [1].
        derivative: 0 gives q, 1 gives q', 2 gives q''.

    Returns:
        (n,).
    """
    w = 2.0 * np.pi * frequency
    system = ([1.0] + [0.0] * derivative, [1.0, 2.0 * damping * w, w * w])
    numerator, denominator, _ = cast(Any, cont2discrete(system, dt, method="foh"))
    return cast(Array, lfilter(numerator.ravel(), denominator, push))
