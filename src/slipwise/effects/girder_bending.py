"""The girder bends: its first vertical mode rings on the pads (the paper's Factor C).

    q'' + 2 z w q' + w^2 q = -a_z,        sum N = m (g + a_z) + m_e q''

A beam is not rigid. Its middle swings up and down against its ends, and the inertia of that swing comes down on the
pads. A simple beam has 8/pi^2 = 0.81 of its mass in the first mode; a frame with a weight on it far less.

A gauge in the middle of a simple beam reads a_z + c q'' with c = 4/pi and hides the resonance, for it rings as well:

    (1 - c) q'' + 2 z w q' + w^2 q = -(a_z + c q'')

Valid: while the next mode is much higher. Model frequency 6 to 13 Hz if the prototype's 2 to 4 Hz were scaled; a stiff
steel rig is above 20 Hz.
Source: paper, "Factor C"; modal analysis of a beam; frequency and share assumed. The balance's filter is exact for an
acceleration that is straight between samples.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.effects._disturbances import Number, swing_of
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.signals.ends import in_frequency
from slipwise.signals.oscillator import oscillator

#: Swing of the middle of a simple beam for a unit of its first mode [1], and how far ends are carried on [s].
_MIDDLE, _BEYOND = 4.0 / np.pi, 2.0
#: Frequencies [Hz] and damping [1] of a mode that an audit tries, and what shakes it, by preference.
_FREQUENCIES, _DAMPINGS = tuple(np.geomspace(4.0, 36.0, 36)), (0.01, 0.03)
_VERTICAL = ("table_az", "girder_az", "girder_az_1")
#: A share of the mass that a fit has led to nothing [1].
_WEIGHTLESS = 1e-9


def rig(specimen: Specimen, share: float, frequency: float, damping: float) -> Specimen:
    """Return the specimen with a part of its mass in the mode; none of so small a part that no body can be made of."""
    mass = share * specimen.mass if share > _WEIGHTLESS else 0.0
    return replace(specimen, bending_mass=mass, bending_frequency=frequency, bending_damping=damping)


def balance(states: BalanceStates, share: float, frequency: float, damping: float, midspan: float) -> dict[str, Array]:
    """Return the inertia of the mode, m_e q'' (n,) [N], less what a gauge at midspan reads too much."""
    dt, mass = float(states.time[1] - states.time[0]), states.specimen.mass
    if midspan < 0.5 or share == 0.0:
        return {"heave": share * mass * oscillator(-states.girder_acceleration[:, 2], dt, frequency, damping, 2)}
    w = 2.0 * np.pi * frequency

    def swing(f: Array) -> NDArray[np.complex128]:
        turn = 2.0 * np.pi * f
        return turn**2 / (w**2 + (_MIDDLE - 1.0) * turn**2 + 2j * damping * w * turn)

    read = in_frequency(states.girder_acceleration[:, 2], dt, swing, round(_BEYOND / dt))
    return {"heave": (share - _MIDDLE) * mass * read}


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield the acceleration of a mode that vertical shaking excites."""
    shakes = [next((r[n] for n in _VERTICAL if n in r), None) for r in records]
    for frequency in _FREQUENCIES:
        for damping in _DAMPINGS:
            bent = [
                swing_of(a, r.dt, frequency, damping) for a, r in zip(shakes, records, strict=True) if a is not None
            ]
            if len(bent) == len(records):
                yield [{"heave": bent}, {"upright": bent}]


EFFECT = Effect(
    contract=1,
    port="girder",
    parameters=(
        Parameter("share", "1", 0.3, 0.0, 0.9, 0.0, "0.81 for a simple beam; 0.3 assumed", "m_e/m: mass of the mode"),
        Parameter("frequency", "Hz", 15.0, 3.0, 60.0, None, "6 to 20 Hz, assumed", "of the mode on fixed ends"),
        Parameter("damping", "1", 0.02, 0.002, 0.2, None, "assumed", "z: of critical", "%"),
        Parameter("midspan", "1", 0.0, 0.0, 1.0, None, "0 over the pads, 1 in the middle", "gauge of a_z", whole=True),
    ),
    diagnosis=ForDiagnosis(
        component="girder",
        equation="q'' + 2 z w q' + w^2 q = -a_z,  sum N += m_e q''",
        moves=RESPONSE,
        signature="sum N rings at one frequency after a_z has ended",
        confused_with={
            "key_friction": "that is locked to the buffers' force and does not ring",
            "pad_compliance": "the pads' own frequency shows in pitch as well",
        },
        needs=("heave",),
    ),
)  # fmt: skip
