"""A load cell whose one bridge feels the load of the other.

    F_read = F + c (N - z N_0),        or N_read = N + c F_x where that channel is the target

A cell that stands askew, or whose bridge is not balanced, adds a share of the vertical load to the horizontal reading:
some 0.25 kN for each per cent here, a tenth of friction. Even in velocity, it lifts the whole loop. z = 1 if the
horizontal reading was set to zero under the load N_0 at the record's start. With target "all" every cell has the same
share of N in F_x.

Valid: 0.5 to 2 %.
Source: definition; sizes assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges, Rare
from slipwise.effects._gauges import aimed
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, share: float, zeroed: float) -> Record:
    """Add the other load's share to the reading."""
    out = {}
    for name in aimed(record, "pad_*_Fx" if target == "all" else target):
        pad = name[:5]
        if name == f"{pad}_N":
            out[name] = record[name] + share * record[f"{pad}_Fx"]
        else:
            load = record[f"{pad}_N"]
            out[name] = record[name] + share * (load - zeroed * load[:10].mean())
    return record.replaced(**out)


def undo(record: Record, target: str, share: float, zeroed: float) -> Record:
    """Take the share away again; exact, for the other load is not changed."""
    return gauge(record, target, -share, zeroed)


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("share", "1", 0.01, -0.3, 0.3, 0.0, "0.5 to 2 %, assumed", "c: of N in F", "%"),
        Parameter("zeroed", "1", 0.0, 0.0, 1.0, None, "assumed", "z: 1 if zeroed under load"),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="F_read = F + c (N - z N_0)",
        moves=("pad_*_F?", "pad_*_N"),
        signature="even in velocity, in step with N, at rest too; moves the girder balance",
        confused_with={
            "slide_tilt": "identical in one pad; a tilt leaves the girder balance clean",
            "channel_offset": "an offset does not follow N",
            "direction_asymmetry": "that follows mu N and is nothing at rest",
        },
        needs=("both directions", "changing load"),
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="feels {size} of the other direction's force",
            settled_by="zero readings with the girder lifted, or a weight put on each cell alone",
            least={"pad_*_N": 0.012, "*": 0.0015},
            forms={"": {"zeroed": 0.0}, ", zeroed": {"zeroed": 1.0}},
        ),
        reads={"_Fx": "_N", "_Fy": "_N", "_N": "_Fx"},
        balance_only=("pad_*_N",),
    ),
    rare=Rare(steady="an offset of the friction gauge"),
)  # fmt: skip
