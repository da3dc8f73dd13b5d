"""Supports that do not lie in one plane.

    N_i += k_v e side_x side_y,        or of one pad alone N_i += k_v e

A rigid girder on four pads is one time statically indeterminate: if pads A and D stand higher by e than B and C, they
carry more, and no equilibrium tells; on three pads it never is. side is the place, from -1 to 1 along each side of the
girder. Only this warp matters; a girder can follow any plane. With stiff pads a tenth of
a millimetre moves most of the weight to one diagonal. Unequal shares break the cancellation between pads whose load
rises and falls. Of n pads there are n - 3 warps, and a pad that alone stands higher by e shows in each as it stands:
from five pads on they tell which one it is.

Valid: while every pad carries; e below N/k_v.
Source: stiffness times height; sizes assumed.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import part_of
from slipwise.effects._disturbances import Number
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.load_basis import basis_of, by_warp, warps


def rig(specimen: Specimen, target: str, warp: float) -> Specimen:
    """Return the specimen with the pads on one diagonal higher, on the other lower; or with one pad higher."""
    return specimen.changed(seating=np.array(specimen.seating) + warp * _pattern(specimen, target))


def _pattern(specimen: Specimen, target: str) -> NDArray[np.float64]:
    """Return side_x side_y of each pad, or 1 of the one; three pads stand in one plane, whatever their heights."""
    if len(specimen.pads) < 4:
        return np.zeros(len(specimen.pads))
    if target:
        return np.array([float(pad == part_of(target)[1]) for pad in specimen.pads])
    return basis_of(specimen).sides.prod(axis=1)


def balance(states: BalanceStates, target: str, warp: float) -> dict[str, NDArray[np.float64]]:
    """Return what the higher pads carry more (n,) [N]; nothing on three pads."""
    rig = states.specimen
    shares = by_warp(rig, np.array(rig.springs) * _pattern(rig, target))
    return {name: np.full(len(states.time), share * warp) for name, share in shares.items()}


def disturb(records: Sequence[Record], specimen: Specimen) -> Iterator[list[Number]]:
    """Yield loads that some pads carry more all the time."""
    yield [{name: [np.ones(len(record)) for record in records]} for name in warps(specimen)]


EFFECT = Effect(
    contract=1,
    port="rig",
    parameters=(
        Parameter("warp", "m", 2e-5, -2e-4, 2e-4, 0.0, "assumed: 0.02 mm", "e: pads A, D, or one, over the rest", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad load",
        equation="N_i += k_v e side_x side_y",
        moves=RESPONSE,
        signature="constant warp of the loads, there at rest; nothing in heave, pitch, roll",
        confused_with={
            "channel_offset": "an offset of one cell moves heave too; zeros with the girder lifted tell",
            "mass_eccentricity": "that moves pitch and roll, never warp",
        },
    ),
    rare=Rare(exact=True, single=True),
)  # fmt: skip
