"""A run on a uniform time axis, with the lag of a causal logger taken out of every channel."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Mask
from slipwise.campaign.campaign import Logger, Run
from slipwise.record import Record
from slipwise.signals.filters import LowPass, align, lowpass
from slipwise.signals.noise import white_level
from slipwise.signals.resample import resampled, uniform_time

#: Table and girder count as at rest below this many standard deviations of their smoothed noise.
_STILL = 5.0
#: Their noise is taken from the calmest tenth of blocks of this length [s]; noise that is not white may show there
#: up to this many times what the top of the spectrum says [1].
_BLOCK, _CALM, _COLOURED = 0.2, 0.1, 5.0
#: Smoothing for that, and the shortest stretch that counts.
_SMOOTH = LowPass(20.0, 4, "aligned")
_SHORTEST = 0.15


@dataclass(frozen=True)
class AlignedRun:
    """One run, ready for arithmetic between channels.

    Attributes:
        record: channels on a uniform axis, not smoothed.
        measured: (n,) False in gaps of the samples.
        quiet: (n,) nothing moves: neither table nor girder.
        lowpass: channel -> the filter that it looks as if it had gone through; None: not known, or none.
    """

    record: Record
    measured: Mask
    quiet: Mask
    lowpass: Mapping[str, LowPass | None]


def aligned_run(run: Run, logger: Logger) -> AlignedRun:
    """Put a run's channels on one uniform axis and take the lag of causal filters out."""
    axis = uniform_time(run.record.time)
    dt = float(np.median(np.diff(axis.time)))
    channels = {}
    filters: dict[str, LowPass | None] = {}
    for name, values in run.record.channels.items():
        placed = resampled(run.record.time, values, axis.time) if axis.moved else values
        channels[name], filters[name] = align(placed, dt, logger.of(name))
    record = Record(axis.time, channels, run.record.provenance)
    return AlignedRun(record, axis.measured, quiet_samples(record), filters)


def quiet_samples(record: Record) -> Mask:
    """Tell where nothing moves (n,): accelerations, or where there are none the slip, show no more than noise.

    A constant offset is no motion; stretches below 0.15 s do not count.
    """
    dt = record.dt
    still = np.ones(len(record), dtype=bool)
    smooth = _SMOOTH if 2.5 * _SMOOTH.frequency * dt < 1.0 else LowPass(0.2 / dt, 4, "aligned")
    part = float(np.sqrt(2.0 * smooth.frequency * dt))
    watched = [n for n in ("table_ax", "table_ay", "table_az", "girder_ax", "girder_ay") if n in record]
    for name in watched or [n for n in ("slip_x", "slip_y") if n in record]:
        smoothed = lowpass(record[name], dt, smooth)
        width = max(int(_BLOCK / dt), 4)
        blocks = smoothed[: len(smoothed) // width * width].reshape(-1, width)
        if len(blocks) == 0:
            return np.zeros(len(record), dtype=bool)
        scatter = blocks.std(axis=1)
        white = max(part * white_level(record[name]), 1e-9)
        level = float(np.clip(np.quantile(scatter, _CALM), white, _COLOURED * white))
        rest = float(np.median(blocks[scatter <= np.quantile(scatter, _CALM)]))
        still &= np.abs(smoothed - rest) < _STILL * level
    return long_enough(still, max(int(_SHORTEST / dt), 8))


def long_enough(mask: Mask, count: int) -> Mask:
    """Keep only stretches of at least this many samples."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    kept = np.zeros(len(mask), dtype=bool)
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        kept[start:end] = end - start >= count
    return kept


def spread(mask: Mask, before: int, after: int) -> Mask:
    """Make every true sample true for its neighbours too."""
    kernel = np.ones(before + after + 1)
    return np.convolve(mask.astype(float), kernel)[before : before + len(mask)] > 0.5
