"""A channel that runs into its rail.

    y = min(max(x, -r S), q S)

The amplifier or the logger cannot show more. Peaks become plateaus, all at one level; the two rails differ
where the zero is not in the middle. S is the span of a usual gauge
(see `channel_offset`).

Valid: always. There is no inverse: what was cut off is gone.
Source: definition; the rail's place assumed.
"""

import numpy as np

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed, span
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, upper: float, lower: float) -> Record:
    """Cut the channel off."""
    return changed(record, target, lambda name, x: np.clip(x, -lower * span(name), upper * span(name)))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("upper", "1", 0.25, 0.005, 1000.0, 1000.0, "assumed", "q: in spans of the gauge", "%"),
        Parameter("lower", "1", 0.25, 0.005, 1000.0, 1000.0, "assumed", "r: in spans of the gauge", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = min(max(x, -r S), q S)",
        moves=("*",),
        signature="plateaus of equal height at the peaks",
        confused_with={"channel_gain": "a gain lowers every value, a rail only the peaks"},
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="is cut off at {size}",
            settled_by="the gauge's range, and a run of smaller amplitude",
            samples=("upper rail", "lower rail"),
        ),
        in_samples="only its slip: an actuator may rest at its ends, which looks like a rail",
    ),
)  # fmt: skip
