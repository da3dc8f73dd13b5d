"""Shear strength of PTFE that grows with slip speed and with real pressure.

    s = s' [1 - exp(-n V)] + alpha P_r

PTFE is viscous: the faster it is sheared the stronger it is, up to s'. The second term is the part of the strength
that real pressure adds; as A_r P_r = N it is a friction coefficient alpha that no speed or pressure changes, and the
whole of friction at zero speed: mu(0) = alpha.

Valid: up to about 0.5 m/s; speed so constant that the contact's temperature does not change.
Source: paper, eqs. (4) and (5); s' = 1.379, n = 0.197, alpha = 0.046 below eq. (8). Units are not printed: MPa by the
size of mu; s/cm because energies are in kN cm and because n in the literature is 20 to 100 s/m (0.197 s/mm would be
197 s/m).
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.effects._saturation import risen
from slipwise.params import Parameter


def shear(speed: float, true_pressure: float, strength: float, rate: float, slow: float) -> float:
    """Replace the shear strength [Pa]."""
    return strength * risen(rate * speed) + slow * true_pressure


def flat(coefficient: float) -> dict[str, float]:
    """Return the parameters at which speed adds nothing to a coefficient of friction."""
    return {"strength": 0.0, "slow": coefficient}


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter(
            "strength", "Pa", 1.379e6, 0.1e6, 10.0e6, None, "paper, below eq. (8): s' = 1.379 (MPa)",
            "s': shear strength that speed can add", "MPa",
        ),
        Parameter(
            "rate", "s/m", 19.7, 1.0, 1000.0, None, "paper, below eq. (8): n = 0.197 (s/cm)",
            "n: how soon speed adds it", "s/cm",
        ),
        Parameter(
            "slow", "1", 0.046, 0.0, 0.5, None, "paper, below eq. (8): alpha = 0.046",
            "alpha: friction coefficient at zero speed",
        ),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="s = s' [1 - exp(-n V)] + alpha P_r",
        moves=RESPONSE,
        signature="friction grows with speed up to about 0.1 m/s: odd in velocity, a function of speed only",
        confused_with={"rate_and_state": "constant speeds: a straight line over log V is rate_and_state"},
    ),
    rare=Rare(
        replaces="constant shear strength (Coulomb)",
        base="law",
        stands_for=("rig.shear_strength",),
    ),
)  # fmt: skip
