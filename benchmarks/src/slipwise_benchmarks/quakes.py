"""Table motions that look like records: filtered noise of Clough & Penzien, a near-fault pulse, a long one, a sweep.

All are in the model's time, in which a bridge's pier moves about 3.3 times as fast, and at rest at both ends.
Source: Kanai (1957) and Tajimi (1960) for the ground's filter, Clough & Penzien (1975) for the second one, Saragoni &
Hart (1974) for the envelope, Mavroeidis & Papageorgiou (2003) for the pulse. Ranges assumed.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, sosfiltfilt

from slipwise_benchmarks.motions import GRAVITY, STEP, Motion

Array = NDArray[np.float64]
QUIET = 0.9
#: Time at the end in which the motion has stopped [s].
STILL = 0.5


def clough_penzien(frequency: Array, ground: float, damping: float) -> NDArray[np.complex128]:
    """Give the response of the ground (n,) to noise in the rock.

    Kanai-Tajimi's filter of natural frequency `ground` [Hz] and `damping` [1], with a second one at a tenth of it that
    takes away what would let the table drift.
    """
    ratio, low = frequency / ground, frequency / (0.1 * ground)
    through = (1.0 + 2j * damping * ratio) / (1.0 - ratio**2 + 2j * damping * ratio)
    return through * -(low**2) / (1.0 - low**2 + 1.2j * low)


def component(
    rng: np.random.Generator, time: Array, start: float, strong: float, ground: float, damping: float
) -> Array:
    """Give one component (n,) of peak 1 whose low frequencies arrive late, as surface waves do.

    Args:
        rng: generator.
        time: (n,) [s].
        start: first arrival [s].
        strong: time in which the envelope (t/strong)^a exp(a (1 - t/strong)) rises to its top [s].
        ground: natural frequency of the ground [Hz].
        damping: of the ground [1].
    """
    since = np.maximum(time - start, 0.0) / strong
    shape = (since * np.exp(1.0 - since)) ** rng.uniform(1.2, 3.0)
    frequency = np.asarray(np.fft.rfftfreq(time.size, STEP), dtype=np.float64)
    late = rng.uniform(0.05, 0.25) * strong  # by which the lowest frequencies come later
    scale = ground / 3.0
    phase = 2.0 * np.pi * late * scale * (1.0 - np.exp(-frequency / scale))
    spectrum = np.fft.rfft(rng.normal(size=time.size) * shape)
    moved = np.fft.irfft(spectrum * clough_penzien(frequency, ground, damping) * np.exp(-1j * phase), time.size)
    return _at_rest(moved, time)


def _at_rest(acceleration: Array, time: Array) -> Array:
    """Let a motion (n,) begin and end softly and contain nothing that no table can do; of peak 1."""
    inside = np.clip((time - 0.8 * QUIET) / 0.2, 0.0, 1.0) * np.clip((time[-1] - STILL - time) / 0.4, 0.0, 1.0)
    band = sosfiltfilt(butter(2, [0.4, 35.0], btype="band", fs=1.0 / STEP, output="sos"), acceleration)
    shaped = band * np.sin(0.5 * np.pi * inside) ** 2
    return shaped / np.abs(shaped).max()


def draw_record(rng: np.random.Generator, length: float, across: bool = False) -> Motion:
    """Give a record of `length` seconds with a vertical part that comes first and is of higher frequency."""
    time = np.arange(0.0, length, STEP)
    strong = rng.uniform(0.16, 0.26) * (length - QUIET - STILL)
    ground, damping = rng.uniform(3.0, 7.0), rng.uniform(0.25, 0.6)
    ax = 0.6 * GRAVITY * component(rng, time, QUIET, strong, ground, damping)
    ay = np.zeros_like(ax)
    if across:
        ay = rng.uniform(0.3, 0.5) * 0.6 * GRAVITY * component(rng, time, QUIET, strong, ground, damping)
    up = component(rng, time, QUIET, 0.7 * strong, rng.uniform(1.5, 2.2) * ground, damping)
    return Motion(ax, ay, rng.uniform(0.18, 0.36) * GRAVITY * up)


def draw_pulse(rng: np.random.Generator, length: float, across: bool = False) -> Motion:
    """Give a near-fault record: a pulse of ground velocity, of 0.45 to 0.9 s, with a weaker record on top."""
    record = draw_record(rng, length, across)
    time = STEP * np.arange(record.ax.size, dtype=np.float64)
    period, cycles = rng.uniform(0.45, 0.9), rng.uniform(1.2, 2.2)
    middle = QUIET + 0.5 * cycles * period + rng.uniform(0.2, 0.4)
    since = 2.0 * np.pi * (time - middle) / period
    inside = np.abs(since) < np.pi * cycles
    velocity = np.where(inside, (1.0 + np.cos(since / cycles)) * np.cos(since + rng.uniform(0.0, 6.28)), 0.0)
    pulse = _at_rest(np.gradient(velocity, STEP), time)
    share = rng.uniform(0.35, 0.6)
    ax = 0.6 * GRAVITY * (pulse + share * record.ax / np.abs(record.ax).max())
    return Motion(ax, record.ay, record.az)


def draw_sweep(rng: np.random.Generator, length: float, across: bool = False) -> Motion:
    """Give a sine whose frequency climbs or falls through 1 to 7 Hz, with a vertical sine of a frequency of its own."""
    time = np.arange(0.0, length, STEP)
    moving = length - QUIET - STILL
    share = np.clip((time - QUIET) / moving, 0.0, 1.0)
    low, high = rng.uniform(0.9, 1.5), rng.uniform(5.0, 7.0)
    if rng.random() < 0.5:
        low, high = high, low
    growth = np.log(high / low)
    turns = low * moving * np.expm1(growth * share) / growth
    ramp = np.sin(0.5 * np.pi * np.clip(np.minimum(share, 1.0 - share) / 0.12, 0.0, 1.0)) ** 2
    ax = 0.35 * GRAVITY * ramp * np.sin(2.0 * np.pi * turns)
    az = rng.uniform(0.12, 0.25) * GRAVITY * ramp * np.sin(2.0 * np.pi * rng.uniform(4.5, 7.5) * (time - QUIET))
    ay = rng.uniform(0.3, 0.5) * 0.35 * GRAVITY * ramp * np.sin(1.7 * np.pi * turns) if across else np.zeros_like(ax)
    return Motion(ax, ay, az)
