"""Friction that is higher on the way out than on the way back.

    mu *= 1 + c tanh(x / l) v_x / |v|

Valid: l of some millimetres.
Source: assumed; it is in no catalogue on purpose.
"""

from math import tanh

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear: float, slip_x: float, velocity_x: float, speed: float, rise: float, reach: float) -> float:
    """Scale the shear strength [Pa] by whether the pad moves away from the middle."""
    if speed == 0.0:
        return shear
    return shear * (1.0 + rise * tanh(slip_x / reach) * velocity_x / speed)


EFFECT = Effect(
    port="shear",
    parameters=(
        Parameter("rise", "1", 0.09, 0.0, 0.9, 0.0, "assumed", "c: half the difference of out and back"),
        Parameter("reach", "m", 3.0e-3, 5.0e-4, 0.05, None, "assumed", "l: slip at which it is full", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + c tanh(x/l) v_x/|v|",
        moves=RESPONSE,
        signature="a force towards the middle that grows with friction",
        confused_with={"slide_curvature": "a curved face pulls by its load, not by its friction"},
    ),
)
