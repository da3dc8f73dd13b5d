"""Logger and sensors: low-pass filter, small time offsets, samples, noise, steps of the converter, faults."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfilt, sosfiltfilt

from slipwise_benchmarks.faults import Fault, apply_after_logger, apply_before_logger, late_by
from slipwise_benchmarks.noise import coloured, hum, quantised
from slipwise_benchmarks.settings import PADS

Array = NDArray[np.float64]
RATE = 500.0


def recorded_channels(pads: Sequence[str], rich: bool, storeys: int = 0) -> tuple[str, ...]:
    """Give the channels that a laboratory records of a rig with these pads; rich: with motion across."""
    floors = (f"storey_{number}_a{axis}" for number in range(1, storeys + 1) for axis in ("xy" if rich else "x"))
    if not rich:
        cells = (f"pad_{pad}_{part}" for pad in pads for part in ("N", "Fx"))
        return ("table_ax", "table_az", "girder_ax", "girder_az", *floors, "slip_x", *cells)
    return (
        *floors,
        *("table_ax", "table_ay", "table_az", "girder_ax", "girder_ay", "girder_az", "girder_az_1", "girder_az_2"),
        *("slip_x", "slip_y", "yaw"),
        *(f"pad_{pad}_{part}" for pad in pads for part in ("N", "Fx", "Fy")),
    )


USUAL = recorded_channels(PADS, rich=False)
RICH = recorded_channels(PADS, rich=True)
#: Standard deviation of sensor noise at 500 Hz, SI: as quiet stretches of rig records show.
NOISE = {"table": 0.02, "girder": 0.03, "slip": 2.0e-5, "load": 40.0, "force": 15.0, "yaw": 1.0e-5}


def sensor(name: str) -> str:
    """Give the kind of sensor that a channel comes from: a key of `NOISE`."""
    if name.startswith("pad_"):
        return "load" if name.endswith("_N") else "force"
    kind = name.split("_")[0]
    return "girder" if kind == "storey" else kind  # accelerometers of one make


@cache
def _sections(order: int, lowpass: float, rate: float) -> Array:
    return np.asarray(butter(order, lowpass, fs=rate, output="sos"))


@dataclass(frozen=True)
class Logger:
    """What the laboratory's chain does to every channel.

    Attributes:
        lowpass: cut-off [Hz] of a Butterworth filter.
        order: of that filter; with phase "zero" it runs forwards and backwards.
        phase: "zero" or "causal".
        stated: whether campaign.toml says so.
        noise: kind of sensor -> standard deviation [SI].
        correlation: of a sample's noise with the one before [1].
        pink: share of the noise's variance that goes as 1/f [1].
        hum: amplitude of the mains as a share of the noise [1].
        mains: frequency of the hum [Hz].
        late: channel -> small offset in time [s].
        rate: of the samples [Hz].
        bits: of the converter; 0: its steps are too fine to see.
        ranges: channel -> what the converter reaches to either side [SI].
    """

    lowpass: float = 100.0
    order: int = 4
    phase: str = "zero"
    stated: bool = True
    noise: dict[str, float] = field(default_factory=lambda: dict(NOISE))
    correlation: float = 0.0
    pink: float = 0.0
    hum: float = 0.0
    mains: float = 50.0
    late: dict[str, float] = field(default_factory=dict)
    rate: float = RATE
    bits: int = 0
    ranges: dict[str, float] = field(default_factory=dict)

    def filtered(self, signal: Array, rate: float) -> Array:
        """Pass a signal (n,) sampled at `rate` [Hz] through the low-pass filter."""
        sos = _sections(self.order, self.lowpass, rate)
        if self.phase == "zero":
            return np.asarray(sosfiltfilt(sos, signal))
        return signal[0] + np.asarray(sosfilt(sos, signal - signal[0]))


def draw_logger(rng: np.random.Generator, names: Sequence[str]) -> Logger:
    """Draw a chain: most say their filter, some do not; some have coloured noise, hum, or cards up to 0.2 ms apart.

    Args:
        rng: generator.
        names: of the channels.
    """
    noise = {kind: sd * float(np.exp(rng.normal(0.0, 0.25))) for kind, sd in NOISE.items()}
    late: dict[str, float] = {}
    if rng.random() < 0.3:
        by_card = {kind: float(rng.uniform(-9.5e-5, 9.5e-5)) for kind in NOISE}
        late = {name: by_card[sensor(name)] for name in names}
    return Logger(
        lowpass=float(rng.choice([80.0, 100.0, 120.0, 150.0])),
        order=int(rng.choice([4, 4, 2])),
        phase="zero" if rng.random() < 0.8 else "causal",
        stated=bool(rng.random() < 0.75),
        noise=noise,
        correlation=float(rng.uniform(0.2, 0.6)) if rng.random() < 0.2 else 0.0,
        hum=float(rng.uniform(0.2, 0.6)) if rng.random() < 0.1 else 0.0,
        late=late,
    )


def _noise(logger: Logger, kind: str, count: int, rng: np.random.Generator) -> Array:
    noise = coloured(count, logger.correlation, logger.pink, rng)
    if logger.hum:
        noise += logger.hum * hum(count, logger.mains / logger.rate, rng)
    return logger.noise[kind] * noise


def measure(
    true: dict[str, Array],
    names: Sequence[str],
    logger: Logger,
    faults: Sequence[Fault],
    rng: np.random.Generator | None,
    number: int = 0,
) -> dict[str, Array]:
    """Give what a laboratory would have recorded of a run.

    Args:
        true: channels of `simulate`.
        names: channels to record.
        logger: the chain.
        faults: of gauges, in order.
        rng: for noise. None: no noise, and a converter without steps.
        number: of the run in its campaign.

    Returns:
        "time" [s] and the channels at the logger's rate, SI.
    """
    time = true["time"]
    rate = 1.0 / (time[1] - time[0])
    stride = int(round(rate / logger.rate))
    faults = [fault for fault in faults if not fault.runs or number in fault.runs]
    channels = {name: true[name] for name in names}
    for fault in faults:
        apply_before_logger(fault, channels, time, true)
    samples = time[::stride]
    recorded: dict[str, Array] = {}
    for name in names:
        smooth = logger.filtered(channels[name], rate)
        late = late_by(faults, name, samples) + logger.late.get(name, 0.0)
        if np.any(late):
            when = np.clip(samples - late, 0.0, time[-1])
            recorded[name] = np.asarray(CubicSpline(time, smooth)(when))
        else:
            recorded[name] = smooth[::stride].copy()
        if rng is not None:
            recorded[name] += _noise(logger, sensor(name), samples.size, rng)
            if logger.bits:
                recorded[name] = quantised(recorded[name], logger.ranges[name], logger.bits)
    for fault in faults:
        apply_after_logger(fault, recorded, number)
    return {"time": samples, **recorded}
