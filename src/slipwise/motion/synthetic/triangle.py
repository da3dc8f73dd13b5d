"""triangle: the table goes to and fro at constant speed; only its turns accelerate it."""

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.motion.synthetic.envelope import envelope, faded_sine
from slipwise.motion.synthetic.spec import HIGHEST_FREQUENCY, STEP, Spec, sample_times
from slipwise.motion.table_motion import TableMotion

OPTIONS = ("cycles", "turn", "vertical")
SYNTAX = "triangle:FREQUENCY,SPEED[,cycles=N][,turn=TIME][,vertical=FREQUENCY,PEAK]"
MEANING = (
    "the table's displacement in x is a triangle of N cycles (10 by default): constant speed, reversed within the "
    "time turn (a tenth of the period by default) by a smooth pulse of acceleration, whose peak is 4 SPEED/turn; "
    "vertical is a sine in z that ramps in and out over the first and the last cycle"
)
EXAMPLE = "triangle:0.5Hz,20cm/s,cycles=6,turn=200ms,vertical=5Hz,0.2g"


def build(spec: Spec) -> TableMotion:
    """Make the motion.

    Raises:
        InputError: a value is missing or not possible.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    if len(spec.values) != 2:
        raise InputError(f"{spec.text}: triangle takes a frequency and a speed first, for example {EXAMPLE}")
    frequency = spec.frequency(spec.values[0], "the frequency")
    speed = spec.quantity(spec.values[1], "the speed", "m/s")
    cycles = spec.whole("cycles", default=10, least=2, most=1_000_000)
    period = 1.0 / frequency
    turn = 0.1 * period
    if "turn" in spec.options:
        turn = spec.quantity(spec.take("turn", ("a time",))[0], "the time of a turn", "s")
    least = 2.0 / HIGHEST_FREQUENCY
    if not least <= turn <= 0.25 * period:
        raise InputError(
            f"{spec.text}: a turn of {turn:g} s is not possible; at this frequency between {least:g} and "
            f"{0.25 * period:g} s are (a longer one leaves no constant speed, a shorter one is a blow)"
        )
    duration = spec.lasting(cycles * period + turn)
    spec.acceleration(f"{4 * speed / turn} m/s^2", "the peak of a turn")
    time = sample_times(duration)
    acceleration = np.zeros((len(time), 3))
    # Every change of speed is centred on the corner of the ideal triangle, so the displacement returns to zero.
    corners = 0.5 * turn + period * np.concatenate([[0.0], 0.25 + 0.5 * np.arange(2 * cycles), [cycles]])
    changes = speed * np.concatenate([[1.0], np.where(np.arange(2 * cycles) % 2 == 0, -2.0, 2.0), [-1.0]])
    for corner, change in zip(corners, changes, strict=True):
        acceleration[:, 0] += _pulse(time, corner, turn, change)
    if "vertical" in spec.options:
        pair = spec.take("vertical", ("a frequency", "an acceleration"))
        shape = envelope(time, 0.0, period, duration - 2 * period, period)
        vertical = spec.frequency(pair[0], "the vertical frequency"), spec.acceleration(pair[1], "the vertical peak")
        acceleration[:, 2] = faded_sine(time, shape, *vertical, start=0.0)
    return TableMotion(
        dt=STEP,
        acceleration=acceleration,
        title=spec.text,
        components=("triangle", "", "sine" if "vertical" in spec.options else ""),
        treatment=(f"synthetic {spec.text}: turns of {turn:g} s, begins and ends at rest",),
    )


def _pulse(time: Array, centre: float, width: float, change: float) -> Array:
    """Return an acceleration that changes the speed by `change` [m/s] within `width` [s], smooth at both ends."""
    place = np.clip((time - centre) / width, -0.5, 0.5)
    return change / width * (1.0 + np.cos(2 * np.pi * place))
