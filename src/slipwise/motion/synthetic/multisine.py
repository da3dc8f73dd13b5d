"""multisine: several sines at once in one direction, with a vertical part or one across of several sines too."""

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.synthetic.envelope import envelope, faded_sine
from slipwise.motion.synthetic.spec import STEP, Spec, sample_times
from slipwise.motion.table_motion import TableMotion

OPTIONS = ("duration", "vertical", "across")
SYNTAX = "multisine:FREQUENCY,PEAK,FREQUENCY,PEAK,...[,duration=TIME][,vertical=...][,across=...]"
MEANING = (
    "a sum of sines of acceleration in x, all with phase zero at the start, each a pair of frequency and peak; it "
    "lasts duration (20 s by default) and ramps in and out over four cycles of its lowest frequency; vertical and "
    "across take such pairs too"
)
EXAMPLE = "multisine:1.1Hz,0.15g,2.3Hz,0.1g,duration=20s,vertical=6Hz,0.1g"

_RAMP_CYCLES = 4


def build(spec: Spec) -> TableMotion:
    """Make the motion.

    Raises:
        InputError: a value is missing or not possible.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    sines = {0: _pairs(spec, spec.values, "multisine")}
    for name, column in (("across", 1), ("vertical", 2)):
        if name in spec.options:
            sines[column] = _pairs(spec, spec.options[name], name)
    duration = 20.0
    if "duration" in spec.options:
        duration = spec.quantity(spec.take("duration", ("a time",))[0], "the duration", "s")
    spec.lasting(duration)
    ramp = _RAMP_CYCLES / min(frequency for frequency, _ in sines[0])
    if duration < 2.25 * ramp:
        raise InputError(
            f"{spec.text}: the ramps take {2 * ramp:g} s (four cycles of the lowest frequency, in and out), which "
            f"leaves too little of {duration:g} s; give duration={2.25 * ramp:.3g}s or more"
        )
    time = sample_times(duration)
    shape = envelope(time, 0.0, ramp, duration - 2 * ramp, ramp)
    acceleration = np.zeros((len(time), 3))
    for column, pairs in sines.items():
        for frequency, peak in pairs:
            acceleration[:, column] += faded_sine(time, shape, frequency, peak, start=0.0)
    return TableMotion(
        dt=STEP,
        acceleration=acceleration,
        title=spec.text,
        components=("multisine", "multisine" if 1 in sines else "", "multisine" if 2 in sines else ""),
        treatment=(f"synthetic {spec.text}: the envelope is on the displacement, so it begins and ends at rest",),
    )


def _pairs(spec: Spec, values: tuple[str, ...], name: str) -> list[tuple[float, float]]:
    """Return (frequency [Hz], peak [m/s^2]) of each sine."""
    if not values or len(values) % 2:
        raise InputError(
            f"{spec.text}: {name} takes pairs of a frequency and an acceleration; it was given "
            f"{', '.join(values) or 'nothing'}, for example {EXAMPLE}"
        )
    return [
        (spec.frequency(frequency, "the frequency"), spec.acceleration(peak, "the peak"))
        for frequency, peak in zip(values[::2], values[1::2], strict=True)
    ]
