"""Backlash: play between the gauge and the contact of a slider.

    x_c = x - (g/2) min(1, |F|/F_p) sign F,        F_p = p N

Joints, keys and pins have clearance. After each reversal the gauge moves by g before the contact does; on the way only
what the joint itself rubs is carried, F_p, here a small share of the normal load so that the force stays a function of
the play.

Valid: play small against the stroke; no impact at its ends.
Source: Coble et al. (2022) for a banded rotary friction damper with backlash; sizes assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Limit
from slipwise.params import Parameter


def stretch(force: float, load: float, play: float, push: float) -> float:
    """Go through the play [m]."""
    most = push * load
    share = force / most if most > 0.0 else 0.0
    return 0.5 * play * min(max(share, -1.0), 1.0)


EFFECT = Effect(
    contract=1,
    port="train",
    parameters=(
        Parameter("play", "m", 1e-3, 0.0, 20e-3, 0.0, "assumed: 0.1 to 5 mm", "g: of the joints", "mm"),
        Parameter("push", "1", 0.02, 0.002, 0.2, None, "assumed", "p: load's share that goes through the play", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="x_c = x - (g/2) sign F",
        moves=RESPONSE,
        signature="after each reversal the gauge moves a fixed distance at hardly any force, then force rises at once",
        confused_with={
            "machine_compliance": "a spring carries from the first micrometre on",
            "presliding": "force begins to grow at the reversal, not behind the play",
        },
        needs=("prescribed slip",),
        # friction never closes the play, or the slip never crosses it
        limits=(Limit("push", "high", "machine_compliance"), Limit("play", "high", "slide_curvature")),
    ),
)  # fmt: skip
