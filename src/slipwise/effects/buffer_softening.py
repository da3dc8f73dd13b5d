"""Virgin rubber is stiffer: the Mullins effect.

    F_b *= 1 + m exp[-(x_max / x_0)^q],        x_max = largest |x| so far

The first stretch breaks bonds between chains and filler, and what is broken stays so for days. Every first excursion to
a new largest stroke is stiffer than any later one. How soon that ends is the rubber's own: q = 1 fades slowly, q = 2
ends as the error function of Ogden and Roxburgh does, q = 4 almost at once.

Valid: m 0.1 to 0.3. Rubber recovers in part over days, which is left out.
Source: Mullins (1969); Ogden and Roxburgh (1999) for an end; sizes and the decay over x_0 assumed.
"""

from collections.abc import Iterator, Sequence
from math import exp

import numpy as np

from slipwise.effects._disturbances import Number, axes, channel
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.record import Record

#: Lengths that an audit tries [m].
_LENGTHS = (3e-3, 1e-2, 3e-2)


def spring(force: float, deflection: float, memory: np.ndarray, rise: float, length: float, shape: float) -> float:
    """Stiffen the force [N] by what the largest excursion leaves."""
    memory[0] = max(memory[0], abs(deflection))
    return force * (1.0 + rise * exp(-((memory[0] / length) ** shape)))


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield what fresh buffers carry more, until they were stretched so far."""
    for axis in axes(records):
        for length in _LENGTHS:
            largest, softer = 0.0, []
            for x in channel(records, f"slip_{axis}"):
                reached = np.maximum.accumulate(np.maximum(np.abs(x), largest))
                largest = float(reached[-1])
                softer.append(x * np.exp(-reached / length))
            yield [{f"girder_{axis}": softer}]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("rise", "1", 0.2, -0.5, 1.0, 0.0, "0.1 to 0.3, assumed", "m: of virgin rubber over worked", "%"),
        Parameter("length", "m", 0.015, 1e-3, 0.1, None, "assumed", "x_0: stroke that works it", "mm"),
        Parameter("shape", "1", 1.0, 0.5, 4.0, None, "assumed: 1 to 2", "q: how it ends over the stroke"),
    ),
    memory=("largest",),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="F_b *= 1 + m exp[-(x_max/x_0)^q]",
        moves=RESPONSE,
        signature="the first cycles of the first run are stiffer in the girder balance; memory of the largest slip",
        confused_with={
            "run_in": "that shows in the pads, this in the girder balance",
            "buffer_hardening": "a second run at the same stroke: hardening is back, softening is not",
        },
    ),
)  # fmt: skip
