"""The noise of every gauge: how large it is, on what that rests, and how much of it is slow.

It is what divides every residual, see `relations.noise`, and what `compare` prints for every channel. Rests before all
runs show it best: a gauge is as noisy in every run, and many runs show too short a rest, so their samples are put
together. Noise that is not white puts more than its share into low frequencies, `colour` times as much, and a velocity
is made of those.

The gauges of a slider may never rest. Where an actuator draws it at one speed, force and load scatter about a smooth
line: that is the noise of the gauges together with that of the contact, which no law of friction explains (asperities,
debris, a controller that hunts). It is slower than white noise, so the top of a spectrum misses it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import detrend

from slipwise.arrays import Array, Mask
from slipwise.noise.independent_samples import sum_sure_correlations
from slipwise.record import Record
from slipwise.signals.noise import difference_level, noise, ordinary, quantum, white_level

#: Samples at rest that are enough to know a gauge's noise, or to judge roll, and the least of one run that count.
ENOUGH, _LEAST = 60, 24
#: Samples at rest that show how noise is coloured.
_ENOUGH_FOR_COLOUR = 200
#: Samples whose mean shows that a channel has begun to move, and how many times their scatter it must have moved.
_ONSET, _ONSET_SURE = 16, 4.0
#: No gauge is truer than this share of what it measures: the best cells and displacement gauges have 0.02 to 0.1 % of
#: their span of non-linearity. It is the floor of records without noise, such as those of another simulation [1].
_TRUEST = 1e-3
#: What moves by less than this part of itself is a constant; taking a logger's lag out rounds [1].
_CONSTANT = 1e-9
#: Blocks of 20 ms that show what a table's gauge does at rest, and the share of its motion that this is at most [1].
_BEGINS, _AT_REST = 5, 0.03
#: Most and fewest samples of a stretch, the fewest stretches that tell something, and the share that is calmest [1].
_LONGEST, _SHORTEST, _ENOUGH_STEADY, _CALMEST = 128, 16, 3, 0.25
#: Share of the stroke over which every law is a smooth curve: a longer stretch takes the law's own shape for noise [1].
_OF_STROKE = 0.1
#: A stretch is steady where the speed changes by less than this share of itself, and slip is that many times its noise.
_CHANGE, _MOVED = 0.1, 20.0


@dataclass(frozen=True)
class Gauge:
    """Noise of one channel.

    Attributes:
        level: standard deviation of one sample, in the channel's unit.
        basis: what has shown it, in words.
        colour: spectral density at low frequency over that of white noise of the same level [1]; 1 where unknown.
        rested: whether a rest has shown it.
        known: whether anything has; a channel that is the same in all samples is no measurement.
    """

    level: float
    basis: str
    colour: float = 1.0
    rested: bool = False
    known: bool = True

    @property
    def slow_level(self) -> float:
        """Level of the white noise that is as strong at low frequency."""
        return float(np.sqrt(self.colour)) * self.level

    def level_below(self, band: float, dt: float) -> float:
        """Return the standard deviation of the noise below a frequency, in the channel's unit.

        sigma = slow_level sqrt(2 band dt): the density at low frequency goes on up to there.

        Args:
            band: the frequency [Hz], up to half the sampling rate.
            dt: step of the samples [s].
        """
        return self.slow_level * float(np.sqrt(2.0 * band * dt))


def measure_gauge_noise(
    records: Sequence[Record], invalid: Sequence[Mapping[str, Mask]] | None = None
) -> dict[str, Gauge]:
    """Return the noise of every channel of a campaign's runs.

    Args:
        records: of the runs.
        invalid: of each run, channel -> samples (n,) at which it is no measurement.
    """
    quiet = [find_rest_before_motion(r) for r in records]
    channels = dict.fromkeys(c for r in records for c in r.channels)
    bad = invalid or [{} for _ in records]
    found = {
        c: _gauge([(r[c], _less(q, b.get(c))) for r, q, b in zip(records, quiet, bad, strict=True) if c in r])
        for c in channels
    }
    return {c: _with_contact(g, records, c) if all(q is None for q in quiet) else g for c, g in found.items()}


def _less(quiet: Mask | None, bad: Mask | None) -> Mask | None:
    return quiet if quiet is None or bad is None else quiet & ~bad


def _with_contact(gauge: Gauge, records: Sequence[Record], channel: str) -> Gauge:
    """Return the noise of a slider's gauge as steady sliding shows it, that of the contact included."""
    if not channel.startswith("pad_"):
        return gauge
    steady = measure_steady_level(records, channel)
    return replace(gauge, level=steady, basis="steady sliding") if steady > gauge.level else gauge


def measure_slip_noise(gauges: Mapping[str, Gauge], axis: str) -> tuple[float, float] | None:
    """Return the noise of slip gauge [m] and relative acceleration [m/s^2] where the rests have shown all three gauges.

    What a gauge hums at rest it may hum less when it moves, but noise that is slow must be known: the likelihood of a
    run takes it for motion, and a velocity then errs four times as much.
    """
    names = (f"slip_{axis}", f"girder_a{axis}", f"table_a{axis}")
    if not all(n in gauges and gauges[n].rested and gauges[n].level > 0.0 for n in names):
        return None
    slip, girder, table = (gauges[n].slow_level for n in names)
    return slip, float(np.hypot(girder, table))


def _gauge(parts: list[tuple[Array, Mask | None]]) -> Gauge:
    """Return the noise of a channel from its samples (n,) in all runs and which of them were at rest.

    Where rest is too short in all runs together, the motion itself must do: the top of the spectrum or the differences
    of neighbours, whichever is less, for signal only adds to either. Friction that turns round between two samples is
    as strong at every frequency, but touches few differences; noise that is not white reaches neither.
    """
    truest = _TRUEST * float(np.sqrt(np.mean([np.var(values) for values, _ in parts])))
    resolution = float(np.median([quantum(values) for values, _ in parts])) / np.sqrt(12.0)
    if all(np.ptp(values) <= _CONSTANT * np.max(np.abs(values)) for values, _ in parts):
        return Gauge(truest, "it is a constant of the campaign, not a measurement", known=False)
    rests = [_before_onset(v[q]) for v, q in parts if q is not None and np.count_nonzero(q) >= _LEAST]
    still = [_detrended(r) for r in rests if len(r) >= _LEAST]
    freedom = sum(len(s) - 2 for s in still)
    if freedom < ENOUGH:
        top, neighbours = (float(np.median([of(v) for v, _ in parts])) for of in (white_level, difference_level))
        basis = "top of the spectrum" if top <= neighbours else "differences of neighbours"
        return Gauge(*_at_least(min(top, neighbours), basis, resolution, truest))
    level = float(np.sqrt(sum(float(s @ s) for s in still) / freedom))
    colour = sum_sure_correlations(still) if sum(len(s) for s in still) >= _ENOUGH_FOR_COLOUR else 1.0
    return Gauge(*_at_least(level, "rest before the motion", resolution, truest), colour, rested=True)


def _at_least(level: float, basis: str, resolution: float, truest: float) -> tuple[float, str]:
    """Return a level with its basis; a coarse gauge may not even flicker at rest, and none is truer than `_TRUEST`."""
    if level >= max(resolution, truest):
        return level, basis
    return (resolution, "its resolution") if resolution >= truest else (truest, f"{_TRUEST:.1%} of what it measures")


def _detrended(rest: Array) -> Array:
    """Return what a rest (n,) leaves about its line, without samples that are none of its noise, (m,)."""
    usual = ordinary(detrend(rest))
    return detrend(rest[usual] if np.count_nonzero(usual) >= _LEAST else rest)


def _before_onset(rest: Array) -> Array:
    """Cut a rest where a channel begins to move: a cell feels the girder before the table is seen to move."""
    smooth = np.convolve(rest, np.ones(_ONSET) / _ONSET, mode="valid")
    away = np.abs(smooth - np.median(smooth))
    moved = away > _ONSET_SURE * 1.4826 * np.median(away)
    return rest[: int(np.argmax(moved))] if moved.any() else rest


def find_rest_before_motion(record: Record) -> Mask | None:
    """Tell which samples at the start of a run are at rest (n,): the table has not moved yet; None without table_ax.

    What a gauge shows at the very start is its noise, hum and drift included, where that is little beside the motion.
    """
    if "table_ax" not in record:
        return None
    table = record["table_ax"]
    block = max(8, round(0.02 / record.dt))
    smooth = np.convolve(np.abs(table - np.median(table[:block])), np.ones(block) / block)[: len(table)]
    begins = float(np.median(smooth[block : _BEGINS * block])) if len(table) > _BEGINS * block else 0.0
    level = max(noise(table).level, min(begins, _AT_REST * float(np.std(table))))
    moving = smooth > 3.0 * level
    first = int(np.argmax(moving)) - block if moving.any() else len(table)
    return np.arange(len(table)) < first


def measure_steady_level(records: Sequence[Record], channel: str) -> float:
    """Return the scatter of one sample of a channel while a slider is drawn steadily; 0 where none ever is.

    Args:
        records: of the runs, with slip_x.
        channel: of friction or load.
    """
    levels = [
        _scatter(record[channel][part])
        for record in records
        if "slip_x" in record and channel in record
        for part in _steady(record["slip_x"])
    ]
    return float(np.quantile(levels, _CALMEST)) if len(levels) >= _ENOUGH_STEADY else 0.0


def _steady(slip: Array) -> Iterator[slice]:
    fastest = float(np.quantile(np.abs(np.diff(slip)), 0.98))
    length = int(min(_LONGEST, _OF_STROKE * np.ptp(slip) / max(fastest, 1e-300)))
    if length < _SHORTEST:  # logged too coarsely: nothing is smooth over the samples that noise needs
        return
    for start in range(0, len(slip) - length + 1, length):
        part = slice(start, start + length)
        (_, rate, bend), left = _about_a_curve(slip[part])
        if abs(4.0 * bend) < _CHANGE * abs(rate) and abs(rate) > _MOVED * float(np.std(left)) / np.sqrt(length):
            yield part


def _scatter(values: Array) -> float:
    curve, left = _about_a_curve(values)
    return float(np.sqrt(left @ left / (len(values) - len(curve))))


def _about_a_curve(values: Array) -> tuple[Array, Array]:
    """Return the parabola through values (n,), its coefficients over -1 to 1, and what is left of them (n,)."""
    place = np.linspace(-1.0, 1.0, len(values))
    curve = np.asarray(np.polynomial.polynomial.polyfit(place, values, 2), dtype=np.float64)
    return curve, values - np.polynomial.polynomial.polyval(place, curve)
