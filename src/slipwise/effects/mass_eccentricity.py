"""A centre of gravity that is off the middle of the pads.

    N_i += m (g + a_z) [x_c side_x / (4 b_x) + y_c side_y / (4 b_y)],        b: half the pad spacing

The nearer pads carry more, at rest and under vertical motion. In horizontal motion the girder turns about the vertical
axis, for inertia acts off the middle of friction and buffers.

Valid: a few centimetres on a spacing of metres.
Source: equilibrium of moments; 0.01 to 0.1 m assumed.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._disturbances import Number, total_loads
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen


def rig(specimen: Specimen, along: float, across: float) -> Specimen:
    """Return the specimen with its centre of gravity moved."""
    return replace(specimen, centre_x=specimen.centre_x + along, centre_y=specimen.centre_y + across)


def balance(states: BalanceStates, along: float, across: float) -> dict[str, NDArray[np.float64]]:
    """Return what the nearer pads carry more (n,) [N]."""
    weight = states.specimen.carried_mass * (states.specimen.gravity + states.girder_acceleration[:, 2])
    half_x, half_y = states.specimen.half_spacing
    return {"pitch": weight * along / half_x, "roll": weight * across / half_y}


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield the share of all that the pads carry by which one end, or one side, carries more."""
    if carried := total_loads(records):
        yield [{"pitch": carried}]
        yield [{"roll": carried}]
        yield [{"pitch": carried}, {"roll": carried}]


EFFECT = Effect(
    contract=1,
    port="rig",
    parameters=(
        Parameter("along", "m", 0.02, -0.3, 0.3, 0.0, "0.01 to 0.1 m, assumed", "x_c: towards +x", "mm"),
        Parameter("across", "m", 0.0, -0.3, 0.3, 0.0, "0.01 to 0.1 m, assumed", "y_c: towards +y", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad load",
        equation="N_i += m (g + a_z) [x_c side_x/(4 b_x) + y_c side_y/(4 b_y)]",
        moves=RESPONSE,
        signature="pitch and roll of the loads at rest and in step with a_z; yaw in horizontal motion",
        confused_with={
            "uneven_seating": "that moves warp only",
            "buffer_mismatch": "its yaw goes with slip x, this one's with friction and acceleration",
            "channel_gain": "a gain of one cell moves heave and warp too",
        },
    ),
    rare=Rare(exact=True, turns=True),
)  # fmt: skip
