"""A drag of the pads that grows with the cube of speed.

    mu *= 1 + c (|v| / V)^3

Valid: speeds below 1 m/s.
Source: assumed; it is in no catalogue on purpose.
"""

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear: float, speed: float, drag: float, fast: float) -> float:
    """Scale the shear strength [Pa] by the cube of speed."""
    return shear * (1.0 + drag * (speed / fast) ** 3)


EFFECT = Effect(
    port="shear",
    parameters=(
        Parameter("drag", "1", 0.2, 0.0, 2.0, 0.0, "assumed", "c: rise at the speed V"),
        Parameter("fast", "m/s", 0.3, 0.05, 2.0, None, "assumed", "V: speed of that rise"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + c (|v|/V)^3",
        moves=RESPONSE,
        signature="odd, at high speed only",
        confused_with={"guide_drag": "a guide acts on the girder, not on its pads"},
    ),
)
