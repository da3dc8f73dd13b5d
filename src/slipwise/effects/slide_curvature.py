"""A sliding face that is curved: a pendulum.

    1/R = 1/R_rated + curvature

A plate that sags like a bowl (R > 0) drives the girder back to the middle, in proportion to the load; one that is
crowned (R < 0) drives it away. The girder rises by R - sqrt(R^2 - x^2 - y^2), the normal turns, and the force along the
table is F = N (x/sqrt(R^2 - x^2) + mu) / (1 - mu x/sqrt(R^2 - x^2)): N x/R + mu N where slip is small. Spherical
bearings do this on purpose: their radius stands in the specimen, and this is what it differs by.

Valid: R down to 0.5 m; a double pendulum of equal friction is a single one with R = R_1 + R_2 less the slider's height.
Source: Zayas, Low, Mahin (1990), Earthquake Spectra 6(2), 317-333; equilibrium on a sphere for what is not small; size
assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter


def face(face: float, curvature: float) -> float:
    """Return the curvature of the sliding face [1/m]."""
    return face + curvature


EFFECT = Effect(
    contract=1,
    port="pad",
    parameters=(
        Parameter("curvature", "1/m", 0.05, -2.0, 2.0, 0.0, "R > 10 m for a flat plate, assumed", "1/R"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="1/R = 1/R_rated + curvature",
        moves=RESPONSE,
        signature="even in velocity, proportional to N x: loops of the pads lean",
        confused_with={
            "buffer_hardening": "that shows in the girder balance, this in the pads",
            "contact_area": "a load that rocks with the slip leans the loops too, but the other way on the way back",
            "restrainer": "a rim is met beyond a gap only: a larger stroke bends the loop, a sphere goes on straight",
        },
        needs=("both directions",),
    ),
    rare=Rare(exact=True),
)  # fmt: skip
