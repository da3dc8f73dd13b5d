"""sine: a steady sine, with a vertical part or one across at their own frequencies."""

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.synthetic.envelope import envelope, faded_sine
from slipwise.motion.synthetic.spec import STEP, Spec, sample_times
from slipwise.motion.table_motion import Steady, TableMotion

OPTIONS = ("cycles", "vertical", "across")
SYNTAX = "sine:FREQUENCY,PEAK[,cycles=N][,vertical=FREQUENCY,PEAK][,across=FREQUENCY,PEAK]"
MEANING = (
    "a sine of acceleration in x; it ramps in over the first four of its N cycles (20 by default) and out over the "
    "last four; vertical and across are sines in z and y under the same ramps"
)
EXAMPLE = "sine:2Hz,0.3g,cycles=30,vertical=5Hz,0.2g"

_RAMP_CYCLES = 4
_PAIR = ("a frequency", "an acceleration")


def build(spec: Spec) -> TableMotion:
    """Make the motion.

    Raises:
        InputError: a value is missing or not possible.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    if len(spec.values) != 2:
        raise InputError(f"{spec.text}: sine takes {' and '.join(_PAIR)} first, for example {EXAMPLE}")
    pairs = {0: spec.values}
    pairs |= {
        column: spec.take(name, _PAIR) for name, column in (("across", 1), ("vertical", 2)) if name in spec.options
    }
    sines = {
        column: (spec.frequency(pair[0], "the frequency"), spec.acceleration(pair[1], "the peak"))
        for column, pair in pairs.items()
    }
    period = 1.0 / sines[0][0]
    why = f"{_RAMP_CYCLES} to ramp in, {_RAMP_CYCLES} to ramp out, 1 at full size"
    cycles = spec.whole("cycles", default=20, least=2 * _RAMP_CYCLES + 1, most=1_000_000, why=why)
    duration = spec.lasting(cycles * period)
    ramp = _RAMP_CYCLES * period
    time = sample_times(duration)
    shape = envelope(time, 0.0, ramp, duration - 2 * ramp, ramp)
    acceleration = np.zeros((len(time), 3))
    for column, (frequency, peak) in sines.items():
        acceleration[:, column] = faded_sine(time, shape, frequency, peak, start=0.0)
    return TableMotion(
        dt=STEP,
        acceleration=acceleration,
        title=spec.text,
        components=("sine", "sine" if 1 in sines else "", "sine" if 2 in sines else ""),
        treatment=(f"synthetic {spec.text}: the envelope is on the displacement, so it begins and ends at rest",),
        steady=Steady(ramp, duration - ramp, period),
    )
