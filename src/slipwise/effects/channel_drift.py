"""A gauge whose zero wanders.

    y = x + d S [1 - exp(-w t)] / w,        d S t for w = 0,        t from the start of the run

A cell that warms up, an integrator, a charge amplifier. S is the span of a usual gauge (see `channel_offset`); w lets
the wandering settle.

Valid: slow; every run starts from a new zero.
Source: definition; size assumed.
"""

import numpy as np

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed, span
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, drift: float, settling: float) -> Record:
    """Let the channel's zero wander."""
    since = record.time - record.time[0]
    way = drift * (-np.expm1(-settling * since) / settling if settling > 1e-6 else since)
    return changed(record, target, lambda name, x: x + way * span(name))


def undo(record: Record, target: str, drift: float, settling: float) -> Record:
    """Take the wandering back."""
    return gauge(record, target, -drift, settling)


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("drift", "1/s", 2e-4, -0.02, 0.02, 0.0, "assumed: 1.2 % a minute", "d: spans a second", "%/min"),
        Parameter("settling", "1/s", 0.0, 0.0, 5.0, None, "assumed: straight", "w: 0 straight, else it settles"),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = x + d S t (w = 0)",
        moves=("*",),
        signature="even, grows with time also while nothing moves",
        confused_with={
            "heating": "heating is odd in velocity and stops when the slip does",
            "run_in": "run-in follows slid distance",
        },
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="drifts by {size}",
            settled_by="a record of some minutes in which nothing moves",
            unit="channel/s",
            least={"m/s^2": 0.01, "m": 2e-5, "N": 20.0, "rad": 3e-5},
            forms={"": {"settling": 0.0}, ", settling": {"settling": 0.33}},
        ),
        sits="alone",
    ),
)  # fmt: skip
