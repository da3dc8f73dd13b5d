"""A channel that comes late.

    y(t) = x(t - tau)

Channels pass through amplifiers, filters and multiplexers of their own. Five milliseconds between force and slip make
19 % of error in a fit of force over speed, yet change the energy of a loop by half a per cent only. The shift is done
by phase: linear interpolation would smooth the noise and so "improve" any fit.

Valid: delays of some samples; the first tau of the record is no measurement.
Source: definition; 1 to 10 ms assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.signals.shift import shift


def gauge(record: Record, target: str, delay: float) -> Record:
    """Make the channel late."""
    return changed(record, target, lambda name, x: shift(x, record.dt, delay))


def undo(record: Record, target: str, delay: float) -> Record:
    """Bring it back in time."""
    return gauge(record, target, -delay)


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("delay", "s", 2e-3, -0.05, 0.05, 0.0, "1 to 10 ms, assumed", "tau: late by", "ms"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y(t) = x(t - tau)",
        moves=("*",),
        signature="residual goes with the channel's rate of change: biggest at reversals, a constant time",
        confused_with={
            "channel_filter": "below 1 ms they are one; beyond, a filter also lowers the peaks",
            "presliding": "a constant distance, and the girder balance stays clean",
        },
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="comes {size} late",
            settled_by="one tap with a hammer on the girder at rest shows every channel's delay and filter",
            unit="s",
            least={"*": 0.4e-3},
            step=5e-4,
            samples=("late",),
        ),
        shifts=True,
        lag="delay",
    ),
)  # fmt: skip
