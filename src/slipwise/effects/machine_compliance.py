"""Machine compliance: the machine that drives a slider gives way between its gauge and the contact.

    x_c = x - c F

A displacement that is measured at the actuator, or at a load point, holds the stretch of everything behind it: frame,
load cell, shaft, the specimen itself. The contact then begins to slide only after the machine is wound up, slides
faster than the gauge while friction falls, and slower while it rises. The force runs along a straight line of slope
1/c against the gauge after each reversal, whatever the normal load is.

It takes the place of the elastic reversal of a base model: what is measured is the sum of both.

Valid: quasi-static; a machine whose own resonance lies above what was recorded.
Source: Rice & Ruina (1983), spring and slider; stiffnesses assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Limit
from slipwise.params import Parameter


def stretch(force: float, compliance: float) -> float:
    """Stretch as a spring [m]."""
    return compliance * force


EFFECT = Effect(
    contract=1,
    port="train",
    parameters=(
        Parameter("compliance", "m/N", 20e-9, 0.0, 5e-6, 0.0, "assumed: 50 kN/mm", "c: of the machine", "um/kN"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="x_c = x - c F",
        moves=RESPONSE,
        signature="after each reversal force rises along one straight line against the gauge, at any load; steps relax",
        confused_with={
            "presliding": "two loads: the machine's slope is the same at both, a contact's length is",
            "backlash": "under play nothing is carried at first",
        },
        needs=("prescribed slip",),
        limits=(Limit("compliance", "high", "slide_curvature"),),  # a contact that sticks for good
    ),
)  # fmt: skip
