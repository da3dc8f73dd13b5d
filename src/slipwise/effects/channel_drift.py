"""A gauge whose zero wanders.

    y = x + d S t,        t from the start of the run

A cell that warms up, an integrator, a charge amplifier. S is the span of a usual gauge (see `channel_offset`).

Valid: slow and straight over one run; every run starts from a new zero.
Source: definition; size assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._gauges import changed, span
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, drift: float) -> Record:
    """Let the channel's zero wander."""
    return changed(record, target, lambda name, x: x + drift * span(name) * (record.time - record.time[0]))


def undo(record: Record, target: str, drift: float) -> Record:
    """Take the wandering back."""
    return gauge(record, target, -drift)


EFFECT = Effect(
    port="gauge",
    component="instrument",
    equation="y = x + d S t",
    parameters=(
        Parameter("drift", "1/s", 2e-4, -0.02, 0.02, 0.0, "assumed: 1.2 % a minute", "d: spans a second", "%/min"),
    ),
    moves=("*",),
    signature="even, grows with time also while nothing moves",
    confused_with={
        "heating": "heating is odd in velocity and stops when the slip does",
        "run_in": "run-in follows slid distance",
    },
    target="channel",
)  # fmt: skip
