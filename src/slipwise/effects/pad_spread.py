"""Pads that are not alike: each has its own level of friction.

    mu_i *= 1 + p side_x + r side_y + w side_x side_y + l_i

Pads cut from one sheet differ by a few per cent, and so do their plates. Their mean belongs to the law; what is left of
four are three contrasts: front against back, one side against the other, one diagonal against the other. side is the
place, from -1 to 1 along each side of the girder. An unlike pair at +-y turns the girder. Where other pads than four at
the corners carry, each has its own level l_i, over the first one, whose friction the law gives.

Valid: a few per cent each; the sum of the three below 100 %.
Source: 3 % of spread between pads of one batch, assumed.
"""

from collections.abc import Iterator, Sequence

from slipwise.effects._disturbances import Number, paired
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen


def shear(
    shear: float, side_x: float, side_y: float, along: float, across: float, diagonal: float, level: float
) -> float:  # fmt: skip
    """Scale the shear strength [Pa] of this pad."""
    return shear * (1.0 + along * side_x + across * side_y + diagonal * side_x * side_y + level)


def disturb(records: Sequence[Record], specimen: Specimen) -> Iterator[list[Number]]:
    """Yield the mean friction of the two pads at each end, of which one has more than the other."""
    for axis in "xy":
        if pairs := paired(records, specimen, axis):
            yield [{name: forces} for name, (forces, _) in pairs.items()]


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("along", "1", 0.03, -0.3, 0.3, 0.0, "assumed", "p: pads A, C over B, D", "%"),
        Parameter("across", "1", 0.0, -0.3, 0.3, 0.0, "assumed", "r: pads A, B over C, D", "%"),
        Parameter("diagonal", "1", 0.0, -0.3, 0.3, 0.0, "assumed", "w: pads A, D over B, C", "%"),
        Parameter(
            "level", "1", 0.0, -0.5, 1.0, 0.0, "assumed", "l_i: of a pad over the first one", "%", by_pad="others",
        ),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu_i *= 1 + p side_x + r side_y + w side_x side_y + l_i",
        moves=RESPONSE,
        signature="odd and flat in everything; differs from pad to pad and sums to zero",
        confused_with={
            "channel_gain": "the girder balance: a gain changes sum F, a spread of friction leaves it clean",
            "uneven_seating": "that shows in the loads at rest",
        },
        needs=("several pads",),
    ),
)  # fmt: skip
