"""The table moves more or less than the motion it was given.

    a_x = (1 + e) a_x,given,    all axes alike

Servo-hydraulic tables follow a command within -10 to +5 %. Drive the model with the measured motion of the table, and
this effect is gone; driven with the command, 5 % of gain alone is 13 % of error in the slip.

Valid: for a gain that does not depend on frequency.
Source: -10 to +5 %, assumed.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter


def table(acceleration: NDArray[np.float64], gain: float) -> NDArray[np.float64]:
    """Scale the table's motion (n, 4) [m/s^2, m/s^2, m/s^2, rad/s^2]."""
    return acceleration * (1.0 + gain)


EFFECT = Effect(
    contract=1,
    port="table",
    parameters=(
        Parameter("gain", "1", -0.05, -0.5, 0.5, 0.0, "-10 to +5 %, assumed", "e: of the table over the motion", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="table",
        equation="a = (1 + e) a_given",
        moves=("table_*", *RESPONSE),
        signature="everything at system level, nothing in pads or balances; disappears with the measured motion",
        confused_with={"channel_gain": "a gain of the table's gauge also breaks slip = girder - table"},
        needs=("command",),
    ),
)  # fmt: skip
