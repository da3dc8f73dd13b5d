"""A rim that ends the slip: a displacement restrainer.

    F += k (r - r_limit) r_hat,      r = sqrt(x^2 + y^2) > r_limit

Sliding bearings have a raised rim, or a ring around the slider, against which it comes when the slip exceeds what was
designed. From there on the pad is a stiff spring that only pushes back.

Valid: an elastic rim without loss; k of one pad such that the step resolves the girder on all of them: 2 pi / 10 of its
period or less.
Source: Fenz, Constantinou (2008), Earthquake Engng Struct. Dyn. 37, 185-205, for restrainers as gap springs; sizes
assumed.
"""

from math import sqrt

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Limit, Rare
from slipwise.params import Parameter


def pad(slip_x: float, slip_y: float, stiffness: float, limit: float) -> tuple[float, float]:
    """Return the push of the rim (force_x, force_y) [N]."""
    away = sqrt(slip_x * slip_x + slip_y * slip_y)
    if away <= limit:
        return 0.0, 0.0
    push = stiffness * (away - limit) / away
    return push * slip_x, push * slip_y


EFFECT = Effect(
    contract=1,
    port="pad",
    parameters=(
        Parameter("stiffness", "N/m", 10e6, 0.0, 100e6, 0.0, "assumed: 10 kN/mm a pad", "k: of the rim", "kN/mm"),
        Parameter("limit", "m", 0.02, 0.001, 1.0, None, "assumed: 20 mm", "r_limit: slip at the rim", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="F += k (r - r_limit)",
        moves=RESPONSE,
        signature="force shoots up beyond one slip, the same on the way out and back; the girder is thrown back",
        confused_with={
            "buffer_hardening": "that shows in the girder balance, this in the pads",
            "slide_curvature": "that leans the whole loop, and in proportion to the load",
        },
        needs=("both directions",),
        limits=(Limit("limit", "low", "slide_curvature"),),  # without a gap it is a spring through the middle
    ),
    rare=Rare(exact=True),
)  # fmt: skip
