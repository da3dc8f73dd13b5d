"""A channel behind a low-pass filter of its own.

    y = H x,        H = 1 / (1 + s T + s^2 T^2 / 2) for order 2

A Butterworth filter with lag T for slow signals; for order 2 its corner is f_c = 1 / (sqrt(2) pi T), 45 Hz for 5 ms.
One filter on every channel does no harm; a different one on each is the real trap: reversals lag and lose their edge.

Valid: signals well below the corner for the lag to be T. There is no inverse: what a filter took is gone.
Source: Butterworth (1930); f_c 20 to 50 Hz assumed.
"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.signals.ends import in_frequency
from slipwise.signals.filters import LowPass, lowpass, response

#: The inverse does not raise amplitudes more than this [1].
_RAISE = 5.0


def gauge(record: Record, target: str, lag: float, order: float) -> Record:
    """Filter the channel."""
    if lag == 0.0:
        return record
    by = LowPass(corner(lag, order), order=round(order), phase="causal")
    return changed(record, target, lambda name, x: lowpass(x, record.dt, by))


def corner(lag: float, order: float) -> float:
    """Return the frequency f_c [Hz]: that of 1 Hz by its lag over T."""
    return LowPass(1.0, round(order), "causal").lag / lag if lag > 0.0 else inf


def sharpen(record: Record, target: str, lag: float, order: float) -> Record:
    """Take the filter out by its inverse, which is limited where the filter leaves little."""
    if lag <= 0.0:
        return record
    by = LowPass(corner(lag, order), round(order), "causal")

    def inverse(frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
        through = response(by, frequency)
        size = np.abs(through)
        return np.asarray(np.conj(through) / np.maximum(size**2, size / _RAISE), dtype=np.complex128)

    beyond = int(30.0 * lag / record.dt) + 64
    return changed(record, target, lambda name, x: in_frequency(x, record.dt, inverse, beyond))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("lag", "s", 3e-3, 0.0, 0.05, 0.0, "f_c 20 to 50 Hz, assumed", "T: of slow signals", "ms"),
        Parameter("order", "1", 2.0, 1.0, 8.0, None, "assumed", "of the filter", whole=True),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = x / (1 + s T + s^2 T^2/2)",
        moves=("*",),
        signature="as a delay, with rounded reversals and lowered peaks",
        confused_with={
            "channel_delay": "below 1 ms they are one; a tap with a hammer tells",
            "presliding": "a constant distance, and the girder balance stays clean",
        },
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="went through a slower filter than the others: a lag of {size}",
            settled_by="one tap with a hammer on the girder at rest shows every channel's delay and filter",
            unit="s",
            least={"*": 0.6e-3},
            step=1e-3,
            forms={", order 1": {"order": 1.0}, ", order 2": {"order": 2.0}},
        ),
        lag="lag",
        plainer="channel_delay",
    ),
)  # fmt: skip
