"""Real area of contact that grows with pressure and saturates.

    A_r = A [1 - exp(-k P)]

PTFE is soft: its real area of contact soon fills the apparent area, so friction grows less than load. For k P << 1 the
real area is proportional to load (Coulomb's law); for k P >> 1 friction is limited by shear strength.

Together with `shear_rate` this gives eqs. (7) and (8),

    F = A {s' [1 - exp(-n V)] [1 - exp(-k P)] + alpha P},        mu = F / (P A).

Eq. (7) as printed has exp(-k V) in the second bracket. That is a misprint: eqs. (3), (6) and (8) all need exp(-k P),
the unit of k (1/MPa) fits P only, and with V the friction at rest and at high speed would not depend on pressure.

Valid: 5 to 25 MPa, the range of the tests; bridges use 10 to 30 MPa.
Source: paper, eq. (3); k = 0.102 from the identification below eq. (8), its unit 1/MPa is implied by P in MPa.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.effects._saturation import risen
from slipwise.params import Parameter


def area(apparent_area: float, pressure: float, saturation: float) -> float:
    """Replace the real area of contact [m^2]."""
    return apparent_area * risen(saturation * pressure)


EFFECT = Effect(
    contract=1,
    port="area",
    parameters=(
        Parameter(
            "saturation", "1/Pa", 0.102e-6, 0.01e-6, 1.0e-6, None, "paper, below eq. (8): k = 0.102 (1/MPa)",
            "k: how fast the real area fills the apparent one", "1/MPa",
        ),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="A_r = A [1 - exp(-k P)]",
        moves=RESPONSE,
        signature="friction grows less than load: odd in velocity, a function of pressure only",
        confused_with={"pressure_law": "sines of equal speed at several pressures"},
    ),
    rare=Rare(
        replaces="real area proportional to load, eq. (2)",
        base="law",
        stands_for=("rig.plastic_pressure",),
    ),
)  # fmt: skip
