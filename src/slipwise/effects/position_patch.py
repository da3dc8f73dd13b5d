"""A patch on the plate: friction differs at one place.

    mu *= 1 + c exp(-|(x - x_p) / l|^q),        c of the pads at each corner, or of each pad

A scratch, a spot of grease, a stain of glue: the residual locks to the slip x at which the pad meets it, whichever way
and however fast the pad comes. Mostly one pad has it. q is the patch's edge: 2 a stain that fades, 8 a plate let in.

Valid: patches wider than a few mm; a patch narrower than the pad acts through the share of the pad that it covers.
Source: lubricated pads 0.1 to 0.4 of the friction, dirty ones 1.1 to 1.5; shape assumed.
"""

from math import exp

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Limit
from slipwise.params import Parameter


def shear(
    shear: float, slip_x: float, side_x: float, side_y: float,
    pad_a: float, pad_b: float, pad_c: float, pad_d: float, rise: float, place: float, width: float, edge: float,
) -> float:  # fmt: skip
    """Scale the shear strength [Pa] where this pad stands on its patch."""
    ahead, behind = (pad_a, pad_b) if side_y > 0.0 else (pad_c, pad_d)
    off = abs(slip_x - place) / width
    return shear * (1.0 + ((ahead if side_x > 0.0 else behind) + rise) * exp(-(off**edge)))


def _height(pad: str, typical: float) -> Parameter:
    return Parameter(f"pad_{pad}", "1", typical, -0.9, 2.0, 0.0, "assumed", f"c: rise at pad {pad.upper()}", "%")


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        _height("a", 0.2),
        _height("b", 0.0),
        _height("c", 0.0),
        _height("d", 0.0),
        Parameter(
            "rise", "1", 0.0, -0.9, 2.0, 0.0, "assumed", "c: at a pad, beside four at the corners", "%", by_pad="each",
        ),
        Parameter("place", "m", 0.01, -0.1, 0.1, None, "assumed", "x_p: slip at which the pad meets it", "mm"),
        Parameter("width", "m", 5e-3, 1e-3, 0.05, None, "assumed", "l: half width of the patch", "mm"),
        Parameter("edge", "1", 2.0, 1.0, 12.0, None, "assumed: 2 is Gaussian", "q: sharpness of its edge"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + c exp(-|(x - x_p)/l|^q)",
        moves=RESPONSE,
        signature="odd, at one place of the stroke, mostly in one pad",
        confused_with={
            "heating": "its gate is at the middle and grows with time; a patch is there from the first cycle",
            "key_clearance": "that shows in the girder balance, not in a pad",
        },
        limits=(Limit("width", "high"),),
    ),
)  # fmt: skip
