"""Table motions of the bench: two-frequency sines and earthquakes of filtered noise, at rest before and after."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, sosfiltfilt

Array = NDArray[np.float64]
STEP = 5.0e-4
GRAVITY = 9.80665


@dataclass(frozen=True)
class Motion:
    """Accelerations of the table [m/s^2], each (n,), every `step` [s]."""

    ax: Array
    ay: Array
    az: Array
    step: float = STEP

    @property
    def duration(self) -> float:
        """Length of the motion [s]."""
        return (self.ax.size - 1) * self.step

    def scaled(self, horizontal: float, vertical: float = 1.0) -> "Motion":
        """Give the same motion with other amplitudes."""
        return replace(self, ax=self.ax * horizontal, ay=self.ay * horizontal, az=self.az * vertical)

    def followed_by_rest(self, seconds: float) -> "Motion":
        """Give the same motion with a still table after it."""
        still = np.zeros(int(round(seconds / self.step)))
        ax, ay, az = (np.concatenate([part, still]) for part in (self.ax, self.ay, self.az))
        return replace(self, ax=ax, ay=ay, az=az)

    def without_vertical(self) -> "Motion":
        """Give the same motion with the vertical part switched off."""
        return replace(self, az=np.zeros_like(self.az))


def steady_sine(frequency: float, amplitude: float, cycles: int, ramp: int = 4) -> Motion:
    """Give a sine in x alone, ramped in over `ramp` cycles and steady until it stops: for reference numbers."""
    time = np.arange(0.0, cycles / frequency, STEP)
    shape = np.minimum(1.0, time * frequency / ramp)
    zero = np.zeros_like(time)
    return Motion(amplitude * shape * np.sin(2.0 * np.pi * frequency * time), zero, zero)


def at_rest(duration: float) -> Motion:
    """Give a table that does not move."""
    zero = np.zeros(int(round(duration / STEP)) + 1)
    return Motion(zero, zero, zero)


def _ramps(time: Array, start: float, end: float, ramp: float) -> Array:
    inside = np.clip((time - start) / ramp, 0.0, 1.0) * np.clip((end - time) / ramp, 0.0, 1.0)
    return np.sin(0.5 * np.pi * inside) ** 2


#: Frequency of the girder on its buffers [Hz].
NATURAL = {"bridge1": 2.96, "bridge2": 2.39}


def draw_sine(natural: float, rng: np.random.Generator, across: bool = False) -> Motion:
    """Give a horizontal and a vertical sine of unlike frequency, away from the resonance at `natural` [Hz]."""
    low = rng.uniform(0.52, 0.68) * natural
    high = rng.uniform(1.4, 1.75) * natural
    frequency = low if rng.random() < 0.55 else high
    upward = rng.uniform(4.2, 7.5)
    length = rng.uniform(5.2, 6.4)
    quiet = rng.uniform(0.8, 1.1)
    time = np.arange(0.0, length + quiet + 1.4, STEP)
    shape = _ramps(time, quiet, quiet + length, rng.uniform(0.6, 1.2))
    ax = 0.30 * GRAVITY * shape * np.sin(2.0 * np.pi * frequency * (time - quiet))
    az = (
        rng.uniform(0.15, 0.3) * GRAVITY * shape * np.sin(2.0 * np.pi * upward * (time - quiet) + rng.uniform(0.0, 6.0))
    )
    ay = np.zeros_like(ax)
    if across:
        share = rng.uniform(0.35, 0.6)
        ay = share * 0.30 * GRAVITY * shape * np.sin(2.0 * np.pi * frequency * rng.uniform(0.7, 0.9) * (time - quiet))
    return Motion(ax, ay, az)


def _quake_component(rng: np.random.Generator, time: Array, envelope: Array, frequency: float, width: float) -> Array:
    """Give noise through a ground-like band round `frequency`, under an envelope, of peak 1."""
    noise = rng.normal(size=time.size)
    band = butter(2, [frequency / width, frequency * width], btype="band", fs=1.0 / STEP, output="sos")
    wide = butter(2, [0.8, 28.0], btype="band", fs=1.0 / STEP, output="sos")
    main, rest = sosfiltfilt(band, noise), sosfiltfilt(wide, noise)
    mixed = main / main.std() + 0.3 * rest / rest.std()
    shaped = sosfiltfilt(butter(2, [0.5, 35.0], btype="band", fs=1.0 / STEP, output="sos"), mixed * envelope)
    # the filter's tails reach into the rest: cut them softly
    return shaped * np.clip(20.0 * envelope, 0.0, 1.0) / np.abs(shaped).max()


def draw_quake(rng: np.random.Generator, across: bool = False) -> Motion:
    """Give an earthquake at a pier's top in model time: 3 to 5 Hz, strong for 2 to 3 s, peak 0.7 g, vertical 0.3 g."""
    quiet, strong = rng.uniform(0.8, 1.1), rng.uniform(2.0, 3.2)
    rise, tail = rng.uniform(0.4, 0.8), rng.uniform(0.7, 1.2)
    time = np.arange(0.0, 7.5, STEP)
    since = time - quiet
    envelope = np.clip(since / rise, 0.0, 1.0) ** 2
    envelope = envelope * np.where(since > rise + strong, np.exp(-(since - rise - strong) / tail), 1.0)
    envelope = envelope * _ramps(time, quiet, 7.5 - 1.2, 0.3)
    ax = 0.7 * GRAVITY * _quake_component(rng, time, envelope, rng.uniform(3.0, 5.0), rng.uniform(1.5, 1.9))
    az = rng.uniform(0.22, 0.38) * GRAVITY * _quake_component(rng, time, envelope, rng.uniform(6.0, 9.0), 1.8)
    ay = np.zeros_like(ax)
    if across:
        ay = rng.uniform(0.3, 0.45) * GRAVITY * _quake_component(rng, time, envelope, rng.uniform(3.0, 5.0), 1.7)
    return Motion(ax, ay, az)
