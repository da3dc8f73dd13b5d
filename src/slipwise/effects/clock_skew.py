"""Two loggers whose clocks do not run alike.

    y(t) = x(t (1 - e))

A quartz is off by 10 to 200 millionths. Channels of the second logger drift against those of the first: aligned at the
start, 6 ms late after 30 s at 200 ppm. It is a delay that grows with time.

Valid: |e| t below a tenth of a second. The signal is read between its samples from a spline through eight times as many
points, made from its spectrum; what is above 0.9 of half the sampling rate is not to be trusted.
Source: definition; 10 to 200 ppm assumed.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges
from slipwise.effects._gauges import changed
from slipwise.params import Parameter
from slipwise.record import Record
from slipwise.signals.ends import in_frequency

FINER = 8
#: Samples by which the ends are carried on.
BEYOND = 64


def _read(values: NDArray[np.float64], time: NDArray[np.float64], dt: float, skew: float) -> NDArray[np.float64]:
    if skew == 0.0:
        return values
    fine = in_frequency(values, dt, np.ones_like, BEYOND, FINER)
    since = time - time[0]
    at = np.clip(since * (1.0 - skew), 0.0, since[-1]) * (FINER / dt)
    return np.asarray(map_coordinates(fine, at[None], order=3, mode="nearest"))


def gauge(record: Record, target: str, skew: float) -> Record:
    """Read the channel by a clock of its own."""
    return changed(record, target, lambda name, x: _read(x, record.time, record.dt, skew))


def undo(record: Record, target: str, skew: float) -> Record:
    """Read it back by the first clock."""
    return gauge(record, target, -skew / (1.0 - skew))


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("skew", "1", 1e-4, -2e-3, 2e-3, 0.0, "10 to 200 ppm, assumed", "e: of the clock", "ppm"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y(t) = x(t (1 - e))",
        moves=("*",),
        signature="a delay that is nothing at the start and grows through the run",
        confused_with={"channel_delay": "its delay is there from the start"},
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="runs by a clock of its own, {size} slow",
            settled_by="one tap at the start and one at the end of a long record",
            shown=(1e6, "ppm"),
            least={"*": 6e-5},
            step=1e-4,
        ),
        sits="card",
        shifts=True,
    ),
)  # fmt: skip
