"""Friction that differs along x and y: the lay of the polish.

    F = mu N (v_x, r v_y) / |v|

A plate polished along x lets the pad slide more easily along the scratches than across them. Force and motion are then
no longer parallel. Coupling matters even for r = 1: motion across takes its share of the circle, so that friction
along x shrinks by |v_x|/|v|. Below 1 mm/s of slip the further force fades with speed.

Valid: r 1.0 to 1.2.
Source: 1.0 to 1.2 with the lay of the polish, assumed; the bound is an ellipse.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter

SLOW = 1e-3


def pad(bound: float, velocity_y: float, speed: float, ratio: float) -> tuple[float, float]:
    """Add what friction across has more than friction along (force_x, force_y) [N]."""
    return 0.0, (ratio - 1.0) * bound * velocity_y / max(speed, SLOW)


EFFECT = Effect(
    contract=1,
    port="pad",
    parameters=(
        Parameter("ratio", "1", 1.1, 0.5, 2.0, 1.0, "1.0 to 1.2, assumed", "r: friction across over along"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="F = mu N (v_x, r v_y)/|v|",
        moves=RESPONSE,
        signature="only in force across, in proportion to v_y/|v|; nothing in shaking along x alone",
        confused_with={"channel_gain": "a gain of the cells across also shows while the pads stick"},
        needs=("across",),
    ),
)  # fmt: skip
