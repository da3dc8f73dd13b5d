"""The table rocks while it shakes.

    theta'' + 2 z w theta' + w^2 theta = w^2 (c a_x + c_g a_g)

The overturning moments of the table (c, with its acceleration a_x) and of the girder on it (c_g, with a_g) bend the
vertical actuators, and the table pitches through its own oil-column resonance w. Gravity then pulls along the face
(g theta, 0.017 m/s2 for 0.1 degree), and the pads feel the turning. c > 0: nose down at +x when pushed towards +x.

What the gauges make of it is theirs: an accelerometer fixed to the girder feels nothing of gravity along the face
(g_s = 0), one that gives the motion alone all of it (g_s = 1).

Valid: 0.01 to 0.1 degree; small angles.
Source: table-specimen interaction, 0.01 to 0.1 degree at 5 m/s2 assumed; resonance 10 to 30 Hz and its damping assumed.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.effects._disturbances import Number, channel, recorded
from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.effects._states import BalanceStates
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.signals.oscillator import oscillator


def _turning(angle: Array, dt: float, frequency: float, damping: float, derivative: int) -> Array:
    """Return the table's pitch (n,), or its derivative, from the angle at which it would come to rest (n,) [rad]."""
    return oscillator((2.0 * np.pi * frequency) ** 2 * angle, dt, frequency, damping, derivative)


def table(
    acceleration: Array, girder: Array, dt: float, compliance: float, specimen: float, frequency: float, damping: float
) -> Array:
    """Add the pitch acceleration to the table's motion (n, 4)."""
    out = acceleration.copy()
    out[:, 3] += _turning(compliance * acceleration[:, 0] + specimen * girder, dt, frequency, damping, 2)
    return out


def balance(
    states: BalanceStates, compliance: float, specimen: float, frequency: float, damping: float, gravity: float
) -> dict[str, Array]:
    """Return gravity along the face and the moments of gravity and the girder's inertia (n,) [N], and what is no slip.

    The centre of gravity, h above the slide, goes to and fro with the table's turning by h theta'' [m/s^2].
    """
    dt, rig = float(states.time[1] - states.time[0]), states.specimen
    pushed = compliance * states.table_acceleration[:, 0] + specimen * states.girder_acceleration[:, 0]
    angle, turning = (_turning(pushed, dt, frequency, damping, order) for order in (0, 2))
    pull = gravity * states.load.sum(axis=1) * angle
    moment = rig.centre_height * pull - rig.inertia[1] * turning
    return {"girder": -pull, "pitch": moment / rig.half_spacing[0], "motion": rig.centre_height * turning}


def disturb(records: Sequence[Record]) -> Iterator[list[Number]]:
    """Yield forces along and around the girder that follow the table."""
    if recorded(records, "table_ax", "slip_x", "girder_ax"):
        pushes = channel(records, "table_ax")
        yield [{"girder_x": pushes}, {"pitch": pushes}]


EFFECT = Effect(
    contract=1,
    port="table",
    parameters=(
        Parameter(
            "compliance", "rad*s^2/m", 2e-4, -2e-3, 2e-3, 0.0, "0.06 degree at 5 m/s2, assumed", "c: nose down per a_x"
        ),
        Parameter("specimen", "rad*s^2/m", 0.0, -2e-3, 2e-3, 0.0, "assumed", "c_g: nose down per a_g"),
        Parameter("frequency", "Hz", 20.0, 5.0, 50.0, None, "oil column 10 to 30 Hz, assumed", "of the table's pitch"),
        Parameter("damping", "1", 0.3, 0.05, 0.8, None, "oil column and its servo, assumed", "z of that resonance"),
        Parameter("gravity", "1", 1.0, 0.0, 1.0, None, "motion alone; 0: fixed to the girder", "g_s: in girder_ax"),
    ),
    diagnosis=ForDiagnosis(
        component="table",
        equation="theta ~ c a_x + c_g a_g:  a_x += g theta,  pitch of the loads -= I theta''/b_x",
        moves=("table_*", *RESPONSE),
        signature="pitch of the loads and an even force, both in step with the table's or the girder's acceleration",
        confused_with={"buffer_height": "that goes with slip", "cell_inertia": "that moves heave with a_z as well"},
    ),
)  # fmt: skip
