"""Rubbing in the shear key: a vertical force while the buffers push.

    V = -mu_k |F_b| tanh(w / w_0),        w: vertical speed of the girder over the table

The key that passes the buffers' force to the girder is steel on steel. Pressed by |F_b| it resists any vertical motion
of the girder, by up to 10 kN at 20 mm on Bridge 1: two fifths of a pad's load. The smooth step over w_0 stands for the
little the key gives way.

Valid: mu_k 0.1 to 0.3; w_0 below the heave speed, and large enough for the step: mu_k |F_b| dt / (m w_0) < 2.
Source: Endo, Okada, Unjoh (2008): "shear keys at rubber buffers might affect vertical force variation"; sizes assumed.
"""

from math import hypot, tanh

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter


def lift(force_x: float, force_y: float, velocity_z: float, friction: float, slow: float) -> float:
    """Give the vertical force of the keys on the girder [N]."""
    return -friction * hypot(force_x, force_y) * tanh(velocity_z / slow)


def balance(states: BalanceStates, friction: float, slow: float) -> dict[str, NDArray[np.float64]]:
    """Give what the pads carry more when the girder rises against the keys (n,) [N]."""
    push = np.hypot(states.buffer_size[:, 0], states.buffer_size[:, 1])
    return {"heave": friction * push * np.tanh(states.heave_rate / slow)}


EFFECT = Effect(
    port="buffer",
    component="buffer",
    equation="V = -mu_k |F_b| tanh(w/w_0)",
    parameters=(
        Parameter("friction", "1", 0.15, 0.0, 0.5, 0.0, "0.1 to 0.3 steel on steel, assumed", "mu_k: of the key"),
        Parameter("slow", "m/s", 1e-3, 0.2e-3, 10e-3, None, "assumed", "w_0: speed of full friction", "mm/s"),
    ),
    moves=RESPONSE,
    signature="sum N differs from m (g + a_z), locked in phase to |F_b| and to the direction of heave",
    confused_with={
        "channel_delay": "a delay of N goes with d(a_z)/dt, also where no buffer pushes",
        "girder_bending": "that rings on after a_z; key friction ends with it",
        "channel_gain": "a gain is in step with a_z",
    },
)  # fmt: skip
