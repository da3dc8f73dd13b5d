"""Two buffers that are not alike.

    k_1 = k (1 + d),        k_2 = k (1 - d)

Rubber of two moulds differs by some per cent. The sum stays; but the buffers stand at both sides of the girder, so that
unlike forces turn it, in step with the slip.

Valid: |d| up to 20 %.
Source: two springs side by side; sizes assumed.
"""

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter


def spring(force: float, side: float, difference: float) -> float:
    """Scale this buffer's force [N]."""
    return force * (1.0 + side * difference)


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("difference", "1", 0.05, -0.5, 0.5, 0.0, "10 % between two, assumed", "d: buffer 1 over mean", "%"),
    ),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="k_1 = k (1 + d),  k_2 = k (1 - d)",
        moves=RESPONSE,
        signature="yaw in step with slip x; pads at +y and -y slide by different amounts",
        confused_with={
            "mass_eccentricity": "its yaw goes with acceleration and shows in the loads at rest",
            "pad_spread": "its yaw goes with friction: it changes sign with v, not with x",
        },
    ),
)  # fmt: skip
