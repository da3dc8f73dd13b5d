"""A load cell whose horizontal bridge feels the vertical load.

    F_x,read = F_x + c N_x,        along y alike where that channel is the target

A three-component cell that stands askew, or whose bridge is not balanced, adds a share of the load, here some 0.25 kN
for each per cent: a tenth of friction. Even in velocity, it lifts the whole loop. With target "all" every cell has the
same share in x.

Valid: 0.5 to 2 %.
Source: definition; sizes assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._gauges import cells
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, share: float) -> Record:
    """Add the load's share to the horizontal reading."""
    axis = "y" if target.endswith("_Fy") else "x"
    pads = [pad for pad in cells(record, target) if record.has_all(f"pad_{pad}_N", f"pad_{pad}_F{axis}")]
    return record.replaced(
        **{f"pad_{pad}_F{axis}": record[f"pad_{pad}_F{axis}"] + share * record[f"pad_{pad}_N"] for pad in pads}
    )


def undo(record: Record, target: str, share: float) -> Record:
    """Take the load's share away again; exact, for the load is not changed."""
    return gauge(record, target, -share)


EFFECT = Effect(
    port="gauge",
    component="instrument",
    equation="F_read = F + c N",
    parameters=(Parameter("share", "1", 0.01, -0.1, 0.1, 0.0, "0.5 to 2 %, assumed", "c: of N in F", "%"),),
    moves=("pad_*_F?",),
    signature="even in velocity, in step with N, at rest too; moves the girder balance",
    confused_with={
        "slide_tilt": "identical in one pad; a tilt leaves the girder balance clean",
        "channel_offset": "an offset does not follow N",
        "direction_asymmetry": "that follows mu N and is nothing at rest",
    },
    target="channel",
)  # fmt: skip
