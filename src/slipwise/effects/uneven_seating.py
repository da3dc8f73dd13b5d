"""Four supports that do not lie in one plane.

    N_i += k_v e side_x side_y

A rigid girder on four pads is one time statically indeterminate: if pads A and D stand higher by e than B and C, they
carry more, and no equilibrium tells. Only this warp matters; a girder can follow any plane. With stiff pads a tenth of
a millimetre moves most of the weight to one diagonal. Unequal shares break the cancellation between pads whose load
rises and falls.

Valid: while every pad carries; e below N/k_v.
Source: stiffness times height; sizes assumed.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._disturbances import Number
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen


def rig(specimen: Specimen, warp: float) -> Specimen:
    """Give the specimen with pads A and D higher, B and C lower."""
    sides = np.sign(np.array(specimen.pad_places)).prod(axis=1)
    return replace(specimen, seating=tuple(float(s + warp * d) for s, d in zip(specimen.seating, sides, strict=True)))


def balance(states: BalanceStates, warp: float) -> dict[str, NDArray[np.float64]]:
    """Give what the diagonal A, D carries more (n,) [N]."""
    return {"warp": np.full(len(states.time), 4.0 * states.specimen.pad_stiffness * warp)}


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Give a load that one diagonal carries more all the time."""
    yield [{"warp": [np.ones(len(record)) for record in records]}]


EFFECT = Effect(
    port="rig",
    component="pad load",
    equation="N_i += k_v e side_x side_y",
    parameters=(
        Parameter("warp", "m", 2e-5, -2e-4, 2e-4, 0.0, "assumed: 0.02 mm", "e: pads A, D over the mean plane", "mm"),
    ),
    moves=RESPONSE,
    signature="constant warp of the loads, there at rest; nothing in heave, pitch, roll",
    confused_with={
        "channel_offset": "an offset of one cell moves heave too; zeros with the girder lifted tell",
        "mass_eccentricity": "that moves pitch and roll, never warp",
    },
    exact=True,
)  # fmt: skip
