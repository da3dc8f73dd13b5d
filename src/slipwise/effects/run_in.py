"""Run-in: friction changes with the distance slid, until a transfer film has settled.

    mu *= 1 + r f(s / s_c),        f(y) = exp(-y), or (1 + p y)^(-1/p)

Fresh PTFE leaves a film of itself on the steel; after that PTFE slides on PTFE. Before, friction is higher (r > 0; a
contaminated or greased face may start lower, r < 0). s is the distance the pad has slid since it was new; it is not
undone by a pause. `tail` p makes the approach slower than exponential, p = 1 hyperbolic.

The authors of the paper met this themselves: their steady law "cannot explain the decrease of the friction coefficient
just after sliding starts" and their next model added it.

Valid: r 0.1 to 1, s_c 0.05 to 2 m. Cleaning the plate starts it anew.
Source: JSCE Proc. Earthquake Eng. 28 (2005) paper 123, abstract; Bondonet & Filiatrault (1997); form assumed.
"""

from math import exp, log1p

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter


def shear(shear: float, memory: np.ndarray, rise: float, distance: float, tail: float) -> float:
    """Scale the shear strength [Pa] by what the slid distance leaves."""
    slid = memory[0] / distance
    left = exp(-log1p(tail * slid) / tail) if tail > 1e-6 else exp(-slid)
    return shear * (1.0 + rise * left)


def advance(speed: float, dt: float, memory: np.ndarray) -> None:
    """Add to the slid distance [m]."""
    memory[0] += speed * dt


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("rise", "1", 0.3, -0.8, 2.0, 0.0, "0.1 to 1.0, assumed", "r: of a new pad over a settled one"),
        Parameter("distance", "m", 0.1, 0.01, 10.0, None, "0.05 to 2 m, assumed", "s_c: in which it settles"),
        Parameter("tail", "1", 0.0, 0.0, 2.0, None, "assumed: exponential", "p: 0 exponential, 1 hyperbolic"),
    ),
    memory=("slid",),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + r exp(-s/s_c)",
        moves=RESPONSE,
        signature="odd; fades with slid distance, biggest in the first cycle; a repeated run shows none of it",
        confused_with={
            "heating": "repeat at once: run-in stays gone; after a pause heat is gone instead",
            "buffer_softening": "that shows in the girder balance, this in the pads",
            "channel_drift": "a drift goes on while nothing slides",
        },
    ),
)  # fmt: skip
