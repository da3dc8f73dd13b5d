"""A sliding face that is not level.

    F_x += N beta

On a slope the pad's normal load leans, and its horizontal part is there whichever way the girder goes. beta > 0 means
that the face rises towards +x, so that the girder pushes the pads towards +x. The table's level counts as well.

Valid: small angles; 0.0005 to 0.005 rad (1/300 is 3.3 mm in 1 m).
Source: equilibrium on an incline; 1/300 is a usual tolerance of erection, assumed.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from slipwise.effects._disturbances import Number, paired
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen


def pad(load: float, tilt: float) -> tuple[float, float]:
    """Return the load's share along the slope (force_x, force_y) [N]."""
    return load * tilt, 0.0


def disturb(records: Sequence[Record], specimen: Specimen) -> Iterator[list[Number]]:
    """Yield the load and the size of friction at each end, of which unlike tilts make a difference of the pads."""
    for axis in "xy":
        if pairs := paired(records, specimen, axis):
            yield [
                number
                for name, (forces, loads) in pairs.items()
                for number in ({name: loads}, {name: [np.abs(f) for f in forces]})
            ]


EFFECT = Effect(
    contract=1,
    port="pad",
    parameters=(
        Parameter("tilt", "rad", 1.0 / 300.0, -0.02, 0.02, 0.0, "1/300, assumed", "beta: rise towards +x", "mrad"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="F_x += N beta",
        moves=RESPONSE,
        signature="even in velocity, proportional to N: loops off centre, the girder drifts downhill",
        confused_with={
            "load_crosstalk": "identical in one pad; the girder balance moves with cross-talk only; level the table",
            "channel_offset": "an offset does not follow N",
            "direction_asymmetry": "that follows mu N, and is small where friction is low",
        },
        needs=("both directions", "changing load"),
    ),
    rare=Rare(steady="an offset of the friction gauge", exact=True),
)  # fmt: skip
