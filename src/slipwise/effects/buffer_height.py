"""The buffers push above the sliding plane.

    pitch of the loads -= F_b z_b / b_x,        b: half the pad spacing

Where the shear key meets the girder decides the moment of the buffers' force. At the sliding plane the buffers load
and unload the pads most; at the height of the centre of gravity not at all, and then the loops are rectangles that are
offset instead of trapezoids. No drawing of the rig tells z_b, and it changes the loads more than any refinement of
friction. The value adds to the specimen's, from which the balance of pitch reads it.

Valid: from below the soffit to the centre of gravity.
Source: equilibrium of moments; 0.1 m assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter
from slipwise.rig import Specimen


def rig(specimen: Specimen, height: float) -> Specimen:
    """Return the specimen with its keys higher."""
    return specimen.changed(buffer_height=[z + height for z in specimen.buffer_heights])


EFFECT = Effect(
    contract=1,
    port="rig",
    parameters=(
        Parameter("height", "m", 0.1, -0.3, 1.0, 0.0, "assumed", "z_b: above the rated place", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="pitch -= F_b z_b/b_x",
        moves=RESPONSE,
        signature="pitch of the loads in step with the buffers' force; nothing in heave, nothing in the girder balance",
        confused_with={
            "mass_eccentricity": "that is there at rest",
            "table_pitch": "that goes with the table's acceleration, not with slip",
        },
    ),
    rare=Rare(exact=True),
)  # fmt: skip
