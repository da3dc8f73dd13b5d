"""A gauge whose zero is off.

    y = x + o S

The zero was taken under load, or not at all. S is the span of a usual gauge of that kind (50 kN along, 10 kN across a
pad, 100 mm, 1 m/s, 2 g, 20 mrad), so that o reads as instrument makers write it: in per cent of full scale.

Valid: below a few per cent of the span.
Source: definition; spans of usual gauges and size assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges, Rare
from slipwise.effects._gauges import changed, span
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, offset: float) -> Record:
    """Shift the channel's zero."""
    return changed(record, target, lambda name, x: x + offset * span(name))


def undo(record: Record, target: str, offset: float) -> Record:
    """Shift it back."""
    return changed(record, target, lambda name, y: y - offset * span(name))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("offset", "1", 0.002, -0.2, 0.2, 0.0, "assumed", "o: in spans of the gauge", "%"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = x + o S",
        moves=("*",),
        signature="even and constant, at rest too; zero readings before and after show it",
        confused_with={
            "slide_tilt": "a tilt follows N",
            "direction_asymmetry": "that follows mu N and is nothing at rest",
            "uneven_seating": "for a cell's N: an offset of one cell moves heave as well",
        },
        needs=("both directions",),
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="has its zero off by {size}",
            settled_by="zero readings before and after, with the girder lifted for load cells",
            unit="channel",
            least={"m/s^2": 0.03, "m": 1e-4, "N": 40.0, "rad": 1e-4},
            samples=("shifted",),
        ),
        sits="alone",
    ),
    rare=Rare(stands_for=("rig.zero_force",)),
)  # fmt: skip
