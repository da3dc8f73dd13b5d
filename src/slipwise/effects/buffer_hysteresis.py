"""Rubber that loops: a force that depends on the way it came, not on the rate.

    F_b += H z,        dz/ds = (1 - z)^i / u along the motion,        |z| <= 1

Filled rubber rubs inside: chains slide past carbon black. The loop is equally wide at any frequency. H is its half
height, u the deflection in which it turns round after a reversal; the first slope H/u adds to the spring's. The form is
Dahl's, the Bouc-Wen model with gamma = 0 and n = 1, and is updated exactly (see `presliding`); i = 0 is
elastic-plastic. In a pause the chains creep back within a minute or so, and the loop's force with them; the girder may
be set anew, so that the next run begins without any way behind it.

Valid: strains for which the backbone is still a straight line; u 1 to 5 mm.
Source: Bouc (1967), Wen (1976), Dahl (1968); sizes assumed.
"""

from collections.abc import Iterator, Sequence
from math import exp

import numpy as np

from slipwise.effects._disturbances import Number, axes, channel, dahl_force
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.record import Record

CREEP = 60.0
ANYWHERE = 1e9
#: Lengths over which a force turns that an audit tries [m].
_TURNS = (2e-4, 1e-3, 3e-3)


def spring(
    force: float, deflection: float, memory: np.ndarray, strength: float, length: float, exponent: float
) -> float:
    """Add the loop's force [N]; its memory follows the deflection."""
    way = deflection - memory[1] if memory[1] < ANYWHERE else 0.0
    sign = 1.0 if way > 0.0 else -1.0
    left, moved = max(1.0 - sign * memory[0], 0.0), abs(way) / length
    if exponent > 0.999:
        left *= exp(-moved)
    elif left > 0.0:
        left = max(left ** (1.0 - exponent) - (1.0 - exponent) * moved, 0.0) ** (1.0 / (1.0 - exponent))
    memory[0], memory[1] = sign * (1.0 - left), deflection
    return force + strength * memory[0]


def rest(memory: np.ndarray, seconds: float) -> None:
    """Let the chains creep back through a pause, after which the girder may stand anywhere."""
    memory[0] *= exp(-seconds / CREEP)
    memory[1] = ANYWHERE


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield a force that turns over a length."""
    for axis in axes(records):
        for length in _TURNS:
            yield [{f"girder_{axis}": [dahl_force(x, length) for x in channel(records, f"slip_{axis}")]}]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("strength", "N", 1e3, 0.0, 20e3, 0.0, "assumed: 2 % of the force at 28 mm", "H: per buffer", "kN"),
        Parameter("length", "m", 3e-3, 0.1e-3, 20e-3, None, "1 to 5 mm, assumed", "u: turns round in", "mm"),
        Parameter("exponent", "1", 1.0, 0.0, 1.0, None, "Dahl (1968): 1", "i: 1 Dahl, 0 elastic-plastic"),
    ),
    memory=("loop", "last"),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="F_b += H z,  dz/ds = (1 - z)^i/u",
        moves=RESPONSE,
        signature="a loop of constant width in the girder balance over x, at any frequency; pads clean",
        confused_with={
            "buffer_damping": "two frequencies of equal stroke: damping widens the loop with rate",
            "key_friction": "that shows in heave",
        },
    ),
)  # fmt: skip
