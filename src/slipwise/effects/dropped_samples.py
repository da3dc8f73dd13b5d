"""Samples that were lost and replaced by the one before.

    y_i = y_(i-1) where a sample is missing

A logger that cannot keep up repeats the last value, for one sample or for a burst. Which ones is made from the golden
ratio, so that the same share always drops the same samples.

Valid: a few per cent.
Source: definition; share assumed.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record

GOLDEN = 0.6180339887498949


def _hold(values: NDArray[np.float64], share: float, burst: float) -> NDArray[np.float64]:
    block = np.arange(len(values)) // max(int(round(burst)), 1)
    lost = (block * GOLDEN) % 1.0 >= 1.0 - share
    lost[0] = False
    return values[np.maximum.accumulate(np.where(lost, 0, np.arange(len(values))))]


def gauge(record: Record, target: str, share: float, burst: float) -> Record:
    """Repeat the value before where a sample is lost."""
    return changed(record, target, lambda name, x: _hold(x, share, burst))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("share", "1", 0.02, 0.0, 0.5, 0.0, "assumed", "of samples lost", "%"),
        Parameter("burst", "1", 1.0, 1.0, 100.0, None, "assumed", "samples lost at a time"),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y_i = y_(i-1) for a share of the samples",
        moves=("*",),
        signature="runs of equal values; spikes in the rate",
        confused_with={"channel_clipping": "a rail repeats one level, lost samples repeat any"},
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="repeats or misses {size} of its samples",
            settled_by="the logger's own counter of samples",
            samples=("held", "lost", "gap", "wild"),
        ),
        in_samples="only its slip: an actuator may rest, and samples then repeat by themselves",
    ),
)  # fmt: skip
