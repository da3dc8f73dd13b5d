"""quake: filtered noise under an envelope, the same for the same seed; the table ends at rest where it began.

Power of the acceleration over frequency: Kanai-Tajimi with Clough and Penzien's low cut, and a high cut:
S(f) = (1 + 4 z^2 r^2)/((1 - r^2)^2 + 4 z^2 r^2) * q^4/((1 - q^2)^2 + 4 w^2 q^2) / (1 + (r/6)^8), r = f/f0, q = 5 f/f0.
Source: Kanai 1957, Tajimi 1960 with z = 0.6 of firm ground; Clough and Penzien 1993, chapter 28, with w = 0.6. The two
cuts and the shares of rise and decay are assumed. The defaults of peak, f and strong are in the range that plausibly
gave the paper's energies at the pier top, in the model's time.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.motion.synthetic.envelope import Envelope, envelope, enveloped
from slipwise.motion.synthetic.spec import STEP, Spec, sample_times
from slipwise.motion.table_motion import TableMotion
from slipwise.units import quantity

OPTIONS = ("seed", "peak", "f", "strong", "vertical", "across")
SYNTAX = "quake:[seed=N][,peak=ACC][,f=FREQUENCY][,strong=TIME][,vertical=ACC[,FREQUENCY]][,across=ACC[,FREQUENCY]]"
MEANING = (
    "an artificial earthquake: noise about the predominant frequency f (4Hz by default) whose strong part lasts "
    "strong (4s), scaled to peak (0.7g) in x; vertical and across give the peaks in z and y (none by default) and "
    "their predominant frequencies (twice f, and f); another seed (1) gives another earthquake of the same kind"
)
EXAMPLE = "quake:seed=1,peak=0.7g,f=4Hz,strong=4s,vertical=0.3g"

_GROUND_DAMPING, _LOW_CUT_DAMPING = 0.6, 0.6
_LOW_CUT, _HIGH_CUT = 1.0 / 5.0, 6.0
#: As shares of the strong part, during which the envelope stands above half of its height; rest before and after.
_RISE, _HOLD, _DECAY, _REST = 0.3, 0.5, 0.7, 0.1


def build(spec: Spec) -> TableMotion:
    """Make the motion.

    Raises:
        InputError: a value is not possible.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    if spec.values:
        raise InputError(f"{spec.text}: quake takes options only, got {', '.join(spec.values)}; for example {EXAMPLE}")
    seed = spec.whole("seed", default=1, least=0, most=10**9)
    peak = quantity("0.7 g", "m/s^2", "peak")
    if "peak" in spec.options:
        peak = spec.acceleration(spec.take("peak", ("an acceleration",))[0], "the peak")
    predominant = 4.0
    if "f" in spec.options:
        predominant = spec.frequency(spec.take("f", ("a frequency",))[0], "f")
    strong = 4.0
    if "strong" in spec.options:
        strong = spec.quantity(spec.take("strong", ("a time",))[0], "the strong part", "s")
    if strong * predominant < 4:
        raise InputError(
            f"{spec.text}: the strong part has {strong * predominant:.2g} cycles of f; at least 4 are needed"
        )
    wanted: dict[int, tuple[float, float]] = {0: (peak, predominant)}
    for name, column, share in (("across", 1, 1.0), ("vertical", 2, 2.0)):
        if name in spec.options:
            size, *own = spec.take(name, ("an acceleration", "a frequency"), optional=1)
            frequency = spec.frequency(own[0], f"f of {name}") if own else share * predominant
            wanted[column] = (spec.acceleration(size, f"the peak {name}"), frequency)
    duration = spec.lasting((_RISE + _HOLD + _DECAY + 2 * _REST) * strong)
    time = sample_times(duration)
    shape = envelope(time, *(share * strong for share in (_REST, _RISE, _HOLD, _DECAY)))
    acceleration = np.zeros((len(time), 3))
    for column, (wanted_peak, frequency) in wanted.items():
        # One generator for each direction: a vertical part must not change the horizontal one.
        noise = filtered_noise(np.random.default_rng([seed, column]), shape, frequency)
        acceleration[:, column] = wanted_peak / np.abs(noise).max() * noise
    return TableMotion(
        dt=STEP,
        acceleration=acceleration,
        title=spec.text,
        components=("quake", "quake" if 1 in wanted else "", "quake" if 2 in wanted else ""),
        treatment=(f"synthetic {spec.text}: filtered noise, seed {seed}, begins and ends at rest",),
    )


def filtered_noise(generator: np.random.Generator, shape: Envelope, predominant: float) -> Array:
    """Return noise under an envelope, of no particular size.

    Args:
        generator: source of the random numbers.
        shape: the envelope, at the steps of a synthetic motion.
        predominant: predominant frequency [Hz].

    Returns:
        (n,) an acceleration whose velocity and displacement begin and end at zero.
    """
    samples = len(shape.value)
    frequency = np.fft.rfftfreq(samples, STEP).astype(np.float64)
    white = generator.standard_normal((2, len(frequency)))
    omega = 2 * np.pi * np.where(frequency > 0, frequency, 1.0)
    spectrum = (white[0] + 1j * white[1]) * np.sqrt(_power(frequency, predominant))
    velocity, displacement = spectrum / (1j * omega), -spectrum / omega**2
    return enveloped(shape, *(np.fft.irfft(part, samples) for part in (displacement, velocity, spectrum)))


def _power(frequency: Array, predominant: float) -> Array:
    """Return S(f) of the file's head."""
    ratio = frequency / predominant
    low = ratio / _LOW_CUT
    ground = (1 + (2 * _GROUND_DAMPING * ratio) ** 2) / ((1 - ratio**2) ** 2 + (2 * _GROUND_DAMPING * ratio) ** 2)
    return ground * low**4 / ((1 - low**2) ** 2 + (2 * _LOW_CUT_DAMPING * low) ** 2) / (1 + (ratio / _HIGH_CUT) ** 8)
