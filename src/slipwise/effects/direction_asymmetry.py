"""Friction that is higher one way than the other.

    mu *= 1 + d v_x / |v|

Polishing leaves a nap, wear leaves burrs that point in the direction of sliding, and a pad that leans presses its
leading edge. d is half the relative difference between the two directions.

Valid: |d| up to a few per cent for new pads.
Source: assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter


def shear(shear: float, velocity_x: float, speed: float, difference: float) -> float:
    """Scale the shear strength [Pa] by the direction of the slip."""
    if speed == 0.0:
        return shear
    return shear * (1.0 + difference * velocity_x / speed)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("difference", "1", 0.03, -0.3, 0.3, 0.0, "assumed", "d: half the difference of the directions", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + d v_x/|v|",
        moves=RESPONSE,
        signature="even in velocity, proportional to mu N: loops sit off centre, higher with more friction",
        confused_with={
            "channel_offset": "only a changing load tells: an offset does not follow mu N",
            "slide_tilt": "a tilt goes with N, this with mu(V, P) N: it vanishes where friction is low",
            "load_crosstalk": "as slide_tilt; the girder balance moves only with cross-talk",
        },
        needs=("both directions",),
    ),
    rare=Rare(stands_for=("rig.zero_force",)),
)  # fmt: skip
