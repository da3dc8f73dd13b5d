"""A washboard: friction rises and falls with the place on the plate.

    mu *= 1 + c sin(2 pi x / l)

Valid: ripples wider than a few mm.
Source: assumed; it is in no catalogue on purpose.
"""

from math import pi, sin

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear: float, slip_x: float, ripple: float, wave: float) -> float:
    """Scale the shear strength [Pa] by where the pad stands."""
    return shear * (1.0 + ripple * sin(2.0 * pi * slip_x / wave))


EFFECT = Effect(
    port="shear",
    parameters=(
        Parameter("ripple", "1", 0.12, 0.0, 0.9, 0.0, "assumed", "c: share by which friction rises"),
        Parameter("wave", "m", 5.0e-3, 1.0e-3, 0.1, None, "assumed", "l: distance of two ripples", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + c sin(2 pi x/l)",
        moves=RESPONSE,
        signature="odd, a wave over the place",
        confused_with={"position_patch": "a patch is at one place"},
    ),
)
