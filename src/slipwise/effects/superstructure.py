"""The frame above the base is not as stiff, or not as damped, as it is said to be.

    k_i = s k_i,rated,        c_i = max(0, c_i,rated + 2 z k_i,rated / w_1)

s changes all storeys alike, and with it the frame's natural frequencies by its root; z is what the lowest mode is
damped more than rated, by dampers in proportion to stiffness. Joints that slip, cracked concrete and cladding make
frames softer and more damped than drawings say.

Valid: frames whose storeys err alike; their masses are as rated.
Source: Chopra, Dynamics of Structures, chapter 11: 2 to 5 % of critical in steel and concrete frames; sizes assumed.
"""

from dataclasses import replace

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.rig import Specimen, fixed_base_frequencies


def rig(specimen: Specimen, stiffness: float, damping: float) -> Specimen:
    """Return the specimen with other columns."""
    if not specimen.storeys:
        return specimen
    more = [damping / (np.pi * float(fixed_base_frequencies(specimen.storeys, axis)[0])) for axis in "xy"]
    storeys = tuple(
        replace(
            storey,
            stiffness_x=stiffness * storey.stiffness_x,
            stiffness_y=stiffness * storey.stiffness_y,
            damping_x=max(0.0, storey.damping_x + more[0] * storey.stiffness_x),
            damping_y=max(0.0, storey.damping_y + more[1] * storey.stiffness_y),
        )
        for storey in specimen.storeys
    )
    return replace(specimen, storeys=storeys)


EFFECT = Effect(
    contract=1,
    port="girder",
    parameters=(
        Parameter("stiffness", "1", 0.8, 0.2, 4.0, 1.0, "assumed", "s: of all storeys over rated"),
        Parameter("damping", "1", 0.01, -0.2, 0.3, 0.0, "assumed", "z: of the lowest mode, over rated", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="girder",
        equation="k_i *= s,  c_i += 2 z k_i / w_1",
        moves=(*RESPONSE, "storey_*"),
        signature="the floors ring at another frequency, or longer, than the frame's",
        confused_with={
            "girder_bending": "that rings in the heave of the loads; a frame sways in the floors' accelerations",
            "channel_gain": "of a floor's accelerometer: it scales what that floor pushes at all frequencies alike",
        },
        needs=("storeys",),
    ),
)  # fmt: skip
