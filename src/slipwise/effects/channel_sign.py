"""A gauge that is wired the wrong way round.

    y = -x

Two wires are swapped, or an axis points the other way than the drawing. The sum of the pads' forces then fails at once.
The sign is a number so that it can be fitted: anything below zero turns the channel.

Valid: always.
Source: definition.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, sign: float) -> Record:
    """Turn the channel."""
    return changed(record, target, lambda name, x: -x if sign < 0.0 else x)


def undo(record: Record, target: str, sign: float) -> Record:
    """Turn it back."""
    return gauge(record, target, sign)


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("sign", "1", -1.0, -1.0, 1.0, 1.0, "definition", "below zero: turned"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = -x",
        moves=("*",),
        signature="odd; balances fail by twice the channel",
        confused_with={"channel_gain": "a gain of -200 % is no gain"},
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="has the wrong sign",
            settled_by="one push by hand in a known direction",
            samples=("turned",),
        ),
        in_samples="only its slip: where force and slip disagree, the force is taken for the one that is reversed",
    ),
)  # fmt: skip
