"""The load that a girder pitching on its pads transfers: the answer of an oscillator that is shaken at its base.

    P(s) = (2 z w s + w^2) / (s^2 + 2 z w s + w^2)

Source: docs/theory.md, section 1.2; Harris' Shock and Vibration Handbook, base-excited oscillator.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.signals.ends import in_frequency


def pass_through_pitch(values: Array, dt: float, frequency: float, damping: float) -> Array:
    """Pass a pitch load (n,) through the girder's pitch on its pads.

    Args:
        values: (n,) as a girder that does not move would transfer it.
        dt: sampling step [s].
        frequency: of the pitch [Hz].
        damping: its fraction of critical [1].
    """

    def gain(f: Array) -> NDArray[np.complex128]:
        ratio = f / frequency
        spring = 1.0 + 2j * damping * ratio
        return spring / (spring - ratio**2)

    return in_frequency(values, dt, gain, int(3.0 / (dt * frequency * max(damping, 0.01))) + 8)
