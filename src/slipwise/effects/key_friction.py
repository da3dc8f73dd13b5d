"""Rubbing in the shear key: a vertical force while the buffers push.

    V = -mu_k |F_b| (z + tanh(w / w_0)),    dz/dt = e w,    |z|, |z + tanh| <= 1,    w: rate of heave over the table

The key that passes the buffers' force to the girder is steel on steel. Pressed by |F_b| it resists any vertical motion
of the girder, by up to 10 kN at 20 mm on Bridge 1: two fifths of a pad's load. What the key gives way before it rubs is
either a smooth step over the speed w_0 (e = 0), or elastic: 1/e is the way, some micrometres, and w_0 is then large.

Valid: mu_k 0.1 to 0.3; w_0 below the heave speed, and large enough for the step: mu_k |F_b| dt / (m w_0) < 2; the same
for a spring of mu_k |F_b| e: 1/e of 4 um and 20 kN of buffer's force make 1 GN/m.
Source: Endo, Okada, Unjoh (2008): "shear keys at rubber buffers might affect vertical force variation"; Prandtl's
elastic-plastic element; sizes assumed.
"""

from collections.abc import Iterator, Sequence
from math import hypot, tanh

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._disturbances import Number, channel, dahl_force, recorded, total_loads
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.effects._prandtl import prandtl
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record

#: Travel of the pads' load over which the force turns that an audit tries, in mean loads [1].
_TURNS = (0.02, 0.1)


def lift(
    force_x: float, force_y: float, velocity_z: float, dt: float, memory: np.ndarray,
    friction: float, slow: float, elastic: float,
) -> float:  # fmt: skip
    """Return the vertical force of the keys on the girder [N]."""
    memory[0] = min(max(memory[0] + elastic * velocity_z * dt, -1.0), 1.0)
    share = min(max(memory[0] + tanh(velocity_z / slow), -1.0), 1.0)
    return -friction * hypot(force_x, force_y) * share


def balance(states: BalanceStates, friction: float, slow: float, elastic: float) -> dict[str, NDArray[np.float64]]:
    """Return what the pads carry more when the girder rises against the keys (n,) [N]; unlike keys tip it."""
    share = np.tanh(states.heave_rate / slow)
    if elastic > 0.0:
        share = np.clip(share + prandtl(elastic * states.heave_rate, float(states.time[1] - states.time[0])), -1.0, 1.0)
    held = friction * states.buffer_size * share[:, None]
    rig = states.specimen
    levers = (np.reshape(rig.buffer_places, (-1, 2)) - rig.middle) / rig.half_spacing
    return {"heave": held.sum(axis=1), "pitch": held @ levers[:, 0], "roll": held @ levers[:, 1]}


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield a vertical force in step with the buffers' that turns with the direction of heave."""
    loads = total_loads(records)
    if not loads or not recorded(records, "slip_x"):
        return
    slips = [np.abs(x) for x in channel(records, "slip_x")]
    for length in _TURNS:
        # the girder's height over the pads is -sum N / (4 k): its direction is that of -d(sum N)/dt
        turns = [dahl_force(-n / n.mean(), length) for n in loads]
        rubbing = [x * t for x, t in zip(slips, turns, strict=True)]
        yield [{"heave": rubbing}, {"pitch": rubbing}]


EFFECT = Effect(
    contract=1,
    port="buffer",
    parameters=(
        Parameter("friction", "1", 0.15, 0.0, 0.5, 0.0, "0.1 to 0.3 steel on steel, assumed", "mu_k: of the key"),
        Parameter("slow", "m/s", 1e-3, 0.2e-3, 1.0, None, "assumed", "w_0: speed of full friction", "mm/s"),
        Parameter("elastic", "1/m", 0.0, 0.0, 2e6, None, "assumed: stiff", "e: 1 over the way it gives"),
    ),
    memory=("given_way",),
    diagnosis=ForDiagnosis(
        component="buffer",
        equation="V = -mu_k |F_b| [z + tanh(w/w_0)],  dz/dt = e w",
        moves=RESPONSE,
        signature="sum N differs from m (g + a_z), locked in phase to |F_b| and to the direction of heave",
        confused_with={
            "channel_delay": "a delay of N goes with d(a_z)/dt, also where no buffer pushes",
            "girder_bending": "that rings on after a_z; key friction ends with it",
            "channel_gain": "a gain is in step with a_z",
        },
        needs=("heave",),
    ),
)  # fmt: skip
