"""The buffers push above the sliding plane.

    pitch of the loads -= F_b z_b / b_x,        b: half the pad spacing

Where the shear key meets the girder decides the moment of the buffers' force. At the sliding plane the buffers load
and unload the pads most; at the height of the centre of gravity not at all, and then the loops are rectangles that are
offset instead of trapezoids. No drawing of the rig tells z_b, and it changes the loads more than any refinement of
friction. The value adds to the specimen's.

Valid: from below the soffit to the centre of gravity.
Source: equilibrium of moments; 0.1 m assumed.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.rig import Specimen


def rig(specimen: Specimen, height: float) -> Specimen:
    """Give the specimen with its keys higher."""
    return replace(specimen, buffer_height=specimen.buffer_height + height)


def balance(states: BalanceStates, height: float) -> dict[str, NDArray[np.float64]]:
    """Give the moment of the buffers' force over half the pad spacing (n,) [N]."""
    half_x, half_y = states.specimen.half_spacing
    return {
        "pitch": -states.buffer_force[:, 0] * height / half_x,
        "roll": -states.buffer_force[:, 1] * height / half_y,
    }


EFFECT = Effect(
    port="rig",
    component="buffer",
    equation="pitch -= F_b z_b/b_x",
    parameters=(
        Parameter("height", "m", 0.1, -0.3, 1.0, 0.0, "assumed", "z_b: above the rated place", "mm"),
    ),
    moves=RESPONSE,
    signature="pitch of the loads in step with the buffers' force; nothing in heave, nothing in the girder balance",
    confused_with={
        "mass_eccentricity": "that is there at rest",
        "table_pitch": "that goes with the table's acceleration, not with slip",
    },
)  # fmt: skip
