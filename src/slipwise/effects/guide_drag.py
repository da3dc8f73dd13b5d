"""Drag on the girder: guides, cables, air.

    m a_x + sum F + F_b + c v_0 (v / v_0)^p = 0,        v_0 = 0.2 m/s, odd in v

Whatever the girder drags along that is neither pad nor buffer: side guides, hoses, cables (p = 1), the air under a wide
plate (p = 2).

Valid: 0 to 0.5 kN s/m; small against friction.
Source: Rayleigh's drag of a blunt body for p = 2; sizes assumed.
"""

from math import hypot

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter

REFERENCE = 0.2


def drag(velocity_x: float, velocity_y: float, damping: float, exponent: float) -> tuple[float, float]:
    """Return the force against the girder's motion (force_x, force_y) [N]."""
    size = damping * (hypot(velocity_x, velocity_y) / REFERENCE) ** (exponent - 1.0)
    return size * velocity_x, size * velocity_y


def balance(states: BalanceStates, damping: float, exponent: float) -> dict[str, NDArray[np.float64]]:
    """Return the drag (n,) [N]."""
    speed = np.hypot(*states.velocity.T)
    return {"girder": damping * (speed / REFERENCE) ** (exponent - 1.0) * states.velocity[:, 0]}


EFFECT = Effect(
    contract=1,
    port="girder",
    parameters=(
        Parameter("damping", "N*s/m", 500.0, 0.0, 50e3, 0.0, "0 to 0.5 kN s/m, assumed", "c: at v_0", "kN*s/m"),
        Parameter("exponent", "1", 1.0, 1.0, 2.0, None, "guides 1, air 2", "p: 1 for a dashpot"),
    ),
    diagnosis=ForDiagnosis(
        component="girder",
        equation="m a_x + sum F + F_b + c v = 0 (p = 1)",
        moves=RESPONSE,
        signature="odd and linear in v, or quadratic, in the girder balance; pads and buffers clean",
        confused_with={
            "buffer_damping": "only yaw and pitch tell: the drag acts at the centre of gravity, damping at the keys",
            "channel_gain": "a gain of girder_ax follows acceleration",
        },
    ),
    rare=Rare(same_unless={"buffer_damping": ("yaw", "pitch")}),
)  # fmt: skip
