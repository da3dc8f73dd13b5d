"""Pads as springs: the stiffness and the damping with which they carry their load.

    N = max(0, k_v d + c_v dd/dt)

A disc of PTFE with its cell and its seat gives way by some tenths of a millimetre. The girder then has a heave and a
pitch frequency, and vertical motion near it is amplified in N. The rated values stand in the specimen; this effect puts
others in their place.

Valid: heave 15 to 57 Hz, damping 2 to 10 % of critical. Stiffer pads need a smaller step.
Source: PTFE of 4 to 5 mm and 0.5 to 0.9 GPa gives 145 to 330 kN/mm; 5 % of critical in heave assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter
from slipwise.rig import Specimen


def rig(specimen: Specimen, stiffness: float, damping: float) -> Specimen:
    """Return the specimen with other springs."""
    return specimen.changed(pad_stiffness=stiffness, pad_damping=damping)


EFFECT = Effect(
    contract=1,
    port="rig",
    parameters=(
        Parameter(
            "stiffness", "N/m", 200e6, 10e6, 2e9, None, "assumed: 145 to 330 kN/mm for PTFE of 4 to 5 mm",
            "k_v: of each pad with its cell", "kN/mm",
        ),
        Parameter(
            "damping", "N*s/m", 70.7e3, 0.0, 1e6, None, "assumed: 5 % of critical", "c_v: of each pad", "kN*s/m",
        ),
    ),
    diagnosis=ForDiagnosis(
        component="pad load",
        equation="N = max(0, k_v d + c_v dd/dt)",
        moves=RESPONSE,
        signature="N rings after reversals and amplifies a_z near the heave frequency",
        confused_with={"girder_bending": "that rings in heave only and at another frequency than the pads' pitch"},
    ),
    rare=Rare(replaces="the specimen's rated springs", base="springs"),
)  # fmt: skip
