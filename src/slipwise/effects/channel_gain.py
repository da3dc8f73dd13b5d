"""A gauge that reads too much or too little.

    y = (1 + g) x

Wrong calibration factor, wrong bridge voltage, a shunt: everything is off by the same share. In a load cell this looks
exactly like more friction; only the balances of the girder can tell, for there all cells and the mass must agree.

Valid: 1 to 5 % for a calibrated gauge.
Source: definition; sizes assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, gain: float) -> Record:
    """Scale the channel."""
    return changed(record, target, lambda name, x: x * (1.0 + gain))


def undo(record: Record, target: str, gain: float) -> Record:
    """Scale it back."""
    return changed(record, target, lambda name, y: y / (1.0 + gain))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("gain", "1", 0.03, -0.5, 1.0, 0.0, "1 to 5 %, assumed", "g: error of the gain", "%"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = (1 + g) x",
        moves=("*",),
        signature="odd and flat in everything; breaks the balances in proportion to the channel",
        confused_with={
            "pad_spread": "the girder balance stays clean with a spread of friction",
            "buffer_damping": "for girder_ax: damping follows velocity, a gain follows acceleration",
        },
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="reads {size} too much",
            settled_by="a calibration of that gauge; for cells a known weight, for accelerometers a turn by 90 degrees",
            least={"*": 0.008},
            step=0.01,
            scales=True,
            samples=("dead", "scaled"),
        ),
        balance_only=("*",),
    ),
)  # fmt: skip
