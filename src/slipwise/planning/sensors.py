"""What a laboratory's chain does to a planned record: noise, rate and filter, of a campaign or as usual."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.campaign.campaign import Logger
from slipwise.channels import part_of
from slipwise.errors import SettingError
from slipwise.record import Record
from slipwise.signals.filters import LowPass, lowpass

#: Standard deviation of one sample by kind of gauge, as quiet stretches of rig records show at 500 Hz [SI].
USUAL_NOISE: dict[str, float] = {
    "table": 0.02, "girder": 0.03, "storey": 0.03, "slip": 2e-5, "yaw": 1e-5, "load": 40.0, "friction": 15.0,
}  # fmt: skip
#: Rate [Hz] and corner of the filter [Hz] of a chain of which nothing is said.
USUAL_RATE, USUAL_CORNER = 500.0, 100.0


@dataclass(frozen=True)
class Sensors:
    """A chain of gauges and logger.

    Attributes:
        step: between samples [s].
        logger: its filters.
        noise: channel -> standard deviation of one sample [SI]; the usual one of its kind where none is given.
    """

    step: float
    logger: Logger
    noise: Mapping[str, float]

    def noise_of(self, channel: str) -> float:
        """Return the standard deviation of one sample of a channel [SI]."""
        if channel in self.noise:
            return self.noise[channel]
        part, _ = part_of(channel)
        if part == "pad":
            return USUAL_NOISE["load" if channel.endswith("_N") else "friction"]
        return USUAL_NOISE.get(channel.partition("_")[0], 0.0)

    def read(self, record: Record, channels: Iterable[str], rng: np.random.Generator) -> Record:
        """Return what is recorded of a replay: filtered, sampled, with noise; channels that it has not are left out.

        Args:
            record: of a replay, its step a whole part of that of the samples.
            channels: of the gauges.
            rng: generator.
        """
        every = round(self.step / record.dt)
        out: dict[str, Array] = {}
        for name in (c for c in channels if c in record):
            by = self.logger.of(name)
            values = (record[name] if by is None else lowpass(record[name], record.dt, by))[::every]
            out[name] = values + self.noise_of(name) * rng.standard_normal(len(values))
        return Record(record.time[::every], out)


def make_sensors(campaign: Campaign | None = None, rate: float | None = None, corner: float | None = None) -> Sensors:
    """Return the chain of a campaign, or that of a laboratory of which no records are there yet.

    Args:
        campaign: that was measured; none for a planned rig.
        rate: of the samples in its place [Hz].
        corner: of the low-pass filter in its place [Hz].

    Raises:
        SettingError: a rate or a corner that cannot be.
    """
    step = 1.0 / USUAL_RATE if campaign is None else campaign.runs[0].record.dt
    if rate is not None:
        if not 0.0 < rate < np.inf:
            raise SettingError(f"a rate of {rate:g} Hz cannot be; give one above zero")
        step = 1.0 / rate
    logger = Logger(every=LowPass(USUAL_CORNER), known=True) if campaign is None else campaign.logger
    if corner is not None:
        logger = Logger(every=LowPass(corner), known=True)
    lowest = 0.5 / step
    if logger.every is not None and not 0.0 < logger.every.frequency < lowest:
        raise SettingError(
            f"a filter of {logger.every.frequency:g} Hz cannot be at {1.0 / step:g} samples a second; give one above "
            f"zero and below {lowest:g} Hz"
        )
    noise = {} if campaign is None else {name: g.level for name, g in campaign.gauges.items() if g.known}
    return Sensors(step, logger, noise)
