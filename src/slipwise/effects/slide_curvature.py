"""A sliding face that is curved: a pendulum.

    (F_x, F_y) += N (x, y) / R

A plate that sags like a bowl (R > 0) drives the girder back to the middle, in proportion to the load; one that is
crowned (R < 0) drives it away. Spherical bearings do this on purpose.

Valid: slip much smaller than R; here |R| > 10 m, so that the lift x^2/(2R) is below 0.1 mm.
Source: pendulum equation; Zayas, Low, Mahin (1990) for bearings that are meant so; size assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.params import Parameter


def pad(load: float, slip_x: float, slip_y: float, curvature: float) -> tuple[float, float]:
    """Give the load's share along the curved face (force_x, force_y) [N]."""
    return load * curvature * slip_x, load * curvature * slip_y


EFFECT = Effect(
    port="pad",
    component="pad friction",
    equation="F += N x/R",
    parameters=(
        Parameter("curvature", "1/m", 0.05, -1.0, 1.0, 0.0, "R > 10 m for a flat plate, assumed", "1/R"),
    ),
    moves=RESPONSE,
    signature="even in velocity, proportional to N x: loops of the pads lean",
    confused_with={
        "buffer_hardening": "that shows in the girder balance, this in the pads",
        "contact_area": "the rocking load leans the loops too, but not the load's product with x when friction is even",
    },
    exact=True,
    needs=("both directions", "changing load"),
)  # fmt: skip
