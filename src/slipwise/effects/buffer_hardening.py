"""Rubber that stiffens at large strain.

    F_b *= 1 + g (|x| / 30 mm)^p

Beyond 150 to 200 % of shear the chains are stretched and rubber stiffens. g is the share of force that is added at
30 mm; what length it is counted from does not matter as long as p is known, so it is fixed.

Valid: the first upturn of the curve; not near rupture.
Source: 5 to 50 % above 150 to 200 % of shear, assumed.
"""

from collections.abc import Iterator, Sequence

from slipwise.effects._disturbances import Number, axes, channel
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.record import Record

COUNTED_AT = 0.03


def spring(force: float, deflection: float, gain: float, power: float) -> float:
    """Stiffen the force [N]."""
    return force * (1.0 + gain * (abs(deflection) / COUNTED_AT) ** power)


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield a force that is cubic, or of fifth power, in the slip."""
    for axis in axes(records):
        yield [{f"girder_{axis}": [x**p for x in channel(records, f"slip_{axis}")]} for p in (3, 5)]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("gain", "1", 0.1, -0.3, 2.0, 0.0, "0.05 to 0.5, assumed", "g: force added at 30 mm", "%"),
        Parameter("power", "1", 2.0, 0.5, 8.0, None, "assumed: 2", "p: 2 is a cubic spring"),
    ),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="F_b *= 1 + g (|x|/30 mm)^p",
        moves=RESPONSE,
        signature="even in v and odd in x in the girder balance, only at the ends of the stroke",
        confused_with={
            "key_clearance": "a clearance is flat at the middle, hardening bends at the ends",
            "buffer_softening": "softening remembers the largest stroke; a second run tells",
        },
    ),
)  # fmt: skip
