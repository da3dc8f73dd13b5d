"""Drag on the girder: guides, cables, air.

    m a_x + sum F + F_b + c v = 0

Whatever the girder drags along that is neither pad nor buffer: side guides, hoses, cables, the air under a wide plate.

Valid: 0 to 0.5 kN s/m; linear in v, small against friction.
Source: assumed.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter


def drag(velocity_x: float, velocity_y: float, damping: float) -> tuple[float, float]:
    """Give the force against the girder's motion (force_x, force_y) [N]."""
    return damping * velocity_x, damping * velocity_y


def balance(states: BalanceStates, damping: float) -> dict[str, NDArray[np.float64]]:
    """Give the drag (n,) [N]."""
    return {"girder": damping * states.velocity[:, 0]}


EFFECT = Effect(
    port="girder",
    component="girder",
    equation="m a_x + sum F + F_b + c v = 0",
    parameters=(
        Parameter("damping", "N*s/m", 500.0, 0.0, 50e3, 0.0, "0 to 0.5 kN s/m, assumed", "c: of the girder", "kN*s/m"),
    ),
    moves=RESPONSE,
    signature="odd and linear in v in the girder balance; pads and buffers clean",
    confused_with={
        "buffer_damping": "only yaw and pitch tell: the drag acts at the centre of gravity, damping at the keys",
        "channel_gain": "a gain of girder_ax follows acceleration",
    },
)  # fmt: skip
