"""A table that is shaken along x also moves up and across.

    a_z += c a_x,        a_y += d a_x

The actuators are not decoupled perfectly, and the overturning moment of the specimen helps. Then the load's inertia
part goes with the horizontal motion, and a run "with the vertical motion off" is not free of it.

Valid: 1 to 10 %, at frequencies below the table's own.
Source: 1 to 10 %, assumed.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter


def table(acceleration: NDArray[np.float64], up: float, across: float) -> NDArray[np.float64]:
    """Add the parts of a_x to the other axes of the table's motion (n, 4)."""
    out = acceleration.copy()
    out[:, 2] += up * acceleration[:, 0]
    out[:, 1] += across * acceleration[:, 0]
    return out


EFFECT = Effect(
    contract=1,
    port="table",
    parameters=(
        Parameter("up", "1", 0.05, -0.5, 0.5, 0.0, "1 to 10 %, assumed", "c: vertical share", "%"),
        Parameter("across", "1", 0.0, -0.5, 0.5, 0.0, "1 to 10 %, assumed", "d: share across", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="table",
        equation="a_z += c a_x,  a_y += d a_x",
        moves=("table_*", *RESPONSE),
        signature="sum N at the horizontal frequency; disappears with the measured vertical motion",
        confused_with={"table_pitch": "that loads the pads in pitch, this in heave"},
        needs=("command",),
    ),
)  # fmt: skip
