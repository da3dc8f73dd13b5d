"""Rubber that damps: a force that goes with the rate of deflection.

    F_b += z,        t_r dz/dt + z = c v_0 (v / v_0)^p,        v_0 = 0.1 m/s, odd in v

Natural rubber loses 2 to 5 % of critical, high-damping rubber 10 to 16 %. Near resonance this bounds what friction
cannot: on Bridge 1, 4 % cuts the energy that friction has to take by a third. p = 1 is a dashpot (Kelvin-Voigt); filled
rubber creeps with a smaller exponent. `relaxation` t_r puts a spring c/t_r in series with the dashpot: with the
buffer's own spring that is Zener's solid, stiffer and less damped at frequencies above 1/(2 pi t_r).

Valid: rates of 0.01 to 1 m/s; c is per buffer.
Source: Kelvin & Voigt; Maxwell, Zener (1948), for the relaxation; ratios assumed; 7.45 kN s/m each
is 4 % of critical on Bridge 1.
"""

from collections.abc import Iterator, Sequence
from math import copysign, exp

import numpy as np

from slipwise.effects._disturbances import Number, axes, channel
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.signals.derivative import derivative

REFERENCE = 0.1


def spring(
    force: float, rate: float, dt: float, memory: np.ndarray, damping: float, exponent: float, relaxation: float
) -> float:
    """Add the dashpot's force [N]; exact while the rate is constant."""
    dashpot = damping * copysign(REFERENCE * (abs(rate) / REFERENCE) ** exponent, rate)
    memory[0] = dashpot + (memory[0] - dashpot) * exp(-dt / relaxation) if relaxation > 0.0 else dashpot
    return force + memory[0]


def rest(memory: np.ndarray, seconds: float, relaxation: float) -> None:
    """Let the force of the spring in series relax through a pause."""
    memory[0] *= exp(-seconds / relaxation) if relaxation > 0.0 else 0.0


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield a force that is linear and square in the slip rate."""
    for axis in axes(records):
        rates = [derivative(x, r.dt) for x, r in zip(channel(records, f"slip_{axis}"), records, strict=True)]
        yield [{f"girder_{axis}": rates}, {f"girder_{axis}": [v * np.abs(v) for v in rates]}]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("damping", "N*s/m", 7.45e3, 0.0, 100e3, 0.0, "4 % of critical, assumed", "c: per buffer", "kN*s/m"),
        Parameter("exponent", "1", 1.0, 0.2, 2.0, None, "Kelvin-Voigt", "p: 1 for a dashpot"),
        Parameter("relaxation", "s", 0.0, 0.0, 0.2, None, "Kelvin-Voigt: 0", "t_r: of a spring in series", "ms"),
    ),
    memory=("dashpot",),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="F_b += z,  t_r dz/dt + z = c v (p = 1)",
        moves=RESPONSE,
        signature="odd and linear in v in the girder balance; pads clean",
        confused_with={
            "guide_drag": "only yaw and pitch tell: the drag acts at the girder, damping at the keys",
            "buffer_hysteresis": "frequencies: damping grows with rate, hysteresis does not",
            "channel_gain": "a gain of girder_ax follows acceleration: sine and quake differ in speed per slip",
        },
    ),
    rare=Rare(same_unless={"guide_drag": ("yaw", "pitch")}),
)  # fmt: skip
