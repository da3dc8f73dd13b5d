"""Supports that do not lie in one plane.

    N_i += k_v e side_x side_y

A rigid girder on four pads is one time statically indeterminate: if pads A and D stand higher by e than B and C, they
carry more, and no equilibrium tells; on three pads it never is. side is the place, from -1 to 1 along each side of the
girder. Only this warp matters; a girder can follow any plane. With stiff pads a tenth of
a millimetre moves most of the weight to one diagonal. Unequal shares break the cancellation between pads whose load
rises and falls.

Valid: while every pad carries; e below N/k_v.
Source: stiffness times height; sizes assumed.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._disturbances import Number
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.load_basis import basis_of


def rig(specimen: Specimen, warp: float) -> Specimen:
    """Give the specimen with the pads on one diagonal higher, on the other lower."""
    return specimen.changed(seating=np.array(specimen.seating) + warp * _diagonal(specimen))


def _diagonal(specimen: Specimen) -> NDArray[np.float64]:
    """Give side_x side_y of each pad; three pads stand in one plane, whatever their heights."""
    return basis_of(specimen).sides.prod(axis=1) * (len(specimen.pads) > 3)


def balance(states: BalanceStates, warp: float) -> dict[str, NDArray[np.float64]]:
    """Give what one diagonal carries more (n,) [N]; nothing on three pads."""
    rig = states.specimen
    if len(rig.pads) < 4:
        return {}
    share = float(basis_of(rig).warp[0] @ (np.array(rig.springs) * _diagonal(rig)))
    return {"warp": np.full(len(states.time), share * warp)}


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
