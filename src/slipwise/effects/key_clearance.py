"""Play in the shear key: the buffer is touched only after the girder has crossed a gap.

    F_b = k dz(x, c),        dz = x - c for x > c,  x + c for x < -c,  0 between
    F_b += d sqrt(|dz|) v while the key goes in, r of that while it comes out, but never a pull

A pin that is thinner than its hole, by machining or by wear. Around the middle the buffer is silent; at the edge of the
gap the key strikes, harder the faster it comes. A key that springs back freely (r = 0) loses all of the blow's work.

Valid: c 0.2 to 3 mm. 0.5 mm changes the slip by 17 %, 2 mm by 59 % (Bridge 1 near resonance).
Source: dead zone of a pin in a hole; impact damping after Hunt & Crossley (1975) with a Hertz exponent; sizes assumed.
"""

from collections.abc import Iterator, Sequence
from math import sqrt

import numpy as np

from slipwise.effects._disturbances import Number, axes, channel
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter
from slipwise.record import Record

#: Clearances that an audit tries [m].
_CLEARANCES = (1e-4, 2e-4, 4e-4, 7e-4, 1.2e-3, 2e-3, 3e-3)


def deflection(deflection: float, clearance: float) -> float:
    """Return what is left of the deflection [m] beyond the gap."""
    if deflection > clearance:
        return deflection - clearance
    if deflection < -clearance:
        return deflection + clearance
    return 0.0


def spring(force: float, deflection: float, rate: float, impact: float, release: float) -> float:
    """Add the blow [N] of the closing key."""
    blow = impact * sqrt(abs(deflection)) * rate
    if deflection * rate < 0.0:
        blow *= release
    if deflection > 0.0:
        return force + max(blow, -max(force, 0.0))
    if deflection < 0.0:
        return force + min(blow, -min(force, 0.0))
    return force


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield what buffers lack that take up clearance first."""
    for axis in axes(records):
        for gap in _CLEARANCES:
            yield [{f"girder_{axis}": [-np.clip(x, -gap, gap) for x in channel(records, f"slip_{axis}")]}]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("clearance", "m", 0.5e-3, 0.0, 10e-3, 0.0, "0.2 to 3 mm, assumed", "c: to either side", "mm"),
        Parameter(
            "impact", "N*s/m^1.5", 0.0, 0.0, 5e6, 0.0, "assumed: none", "d: damping of the blow, per buffer"
        ),
        Parameter("release", "1", 1.0, 0.0, 1.0, None, "Hunt & Crossley (1975): 1", "r: damping as the key comes out"),
    ),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="F_b = k dz(x, c)",
        moves=RESPONSE,
        signature="the girder balance is flat near x = 0; acceleration spikes where |x| = c; pads clean",
        confused_with={
            "breakaway": "spikes of breakaway sit at zero speed, those of the key at a place",
            "buffer_hardening": "hardening bends at the ends of the stroke",
        },
    ),
)  # fmt: skip
