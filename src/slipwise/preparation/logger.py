"""Estimate the logger's low-pass filter from the friction forces themselves.

At each reversal friction turns over at once, so its spectrum falls as a power of frequency without an end; where it
bends down from that power and reaches the noise is the logger's doing. Fitted to the mean spectrum of cells and runs:

    S(f) = A f^-q |H(f; fc, order)|^2 + noise          (Whittle likelihood)

No law of friction enters, so that an effect which the model lacks hardly bends it: of 60 campaigns of another
simulator, most with a hidden effect, 58 show a bend, of these 54 within 7 % and 57 with their order and phase. Fits of
the law under many filters read 48 Hz where 80 Hz hid behind a presliding bristle, and took half a minute.

Source: Whittle (1953), Arkiv Matematik 2:423-434.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize
from scipy.signal import welch

from slipwise.arrays import Array
from slipwise.campaign import Campaign, Logger
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.errors import InputError
from slipwise.estimation.base_fit import fit_roughly
from slipwise.estimation.intervals import compute_halfwidth
from slipwise.jobs.parallel import on_every_core
from slipwise.record import Record
from slipwise.short_repr import short_repr
from slipwise.signals.filters import LowPass

#: Below this friction's own shape shows [Hz].
_FROM = 22.0
#: Shapes that are tried: order of one pass, and phase. Eight causal poles look like four there and back, and compete
#: only with these: friction with a bristle falls a little steeper than a power, and would ask for the eight.
_SHAPES = ((4, "zero"), (2, "zero"), (4, "causal"), (2, "causal"))
#: Which of the two it is shows where pads reverse: a filter there and back rings before a reversal too.
_THERE_AND_BACK, _CAUSAL = (4, "zero"), (8, "causal")
#: Length of the stretches whose spectra are averaged [s].
_STRETCH = 0.5
#: The bend must show above the noise by this factor in power, and lie below this part of half the sampling rate [1].
_ABOVE, _BELOW = 6.0, 0.92
#: A line search may ask for more than a float holds: beyond this logarithm of a density nothing is different [1].
_LOUDEST = 600.0
#: An interval wider than this tells no frequency [1].
_WIDEST = 0.25


@short_repr
@dataclass(frozen=True)
class LoggerEstimate:
    """What the data say of the logger's filter.

    Attributes:
        lowpass: the filter, None when the data do not tell it within the interval that matters.
        low: lower end of the 95 % interval of its frequency [Hz].
        high: upper end.
        why: how it was found, or why it was not.
        likeliest: what a fit takes the logger for, sure or not; None where nothing is known of it.
        causal: a filter that falls as the likeliest one does and rings after a reversal only; None for other shapes.
    """

    lowpass: LowPass | None
    low: float
    high: float
    why: str
    likeliest: Logger | None = None
    causal: LowPass | None = None


@dataclass(frozen=True)
class _Shape:
    """One fitted shape: numbers are log level at 50 Hz, slope, log corner, log noise, tilt of the noise."""

    order: int
    phase: str
    cost: float
    numbers: Array
    error: float

    @property
    def corner(self) -> float:
        return float(np.exp(self.numbers[2]))


def determine_logger(
    campaign: Campaign, invalid: InvalidSamples
) -> tuple[Campaign, LoggerEstimate | None, Mapping[str, float]]:
    """Return a campaign with the logger's filter as its fitted runs show it, what they say, and where fits begin.

    Where friction's spectrum does not tell it, the filter is of the usual kind, at the frequency that a rough fit finds
    beside the law; later fits begin where that one ended.

    Args:
        campaign: with its logger; where campaign.toml describes that nothing is to be found out.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
    """
    if campaign.logger.known:
        return campaign, None, {}
    fitted = tuple(run for run in campaign.runs if run.role != "holdout")
    found, start = estimate_logger(replace(campaign, runs=fitted)), dict[str, float]()
    # of one slider no filter is told from a law, and without friction nothing turns round at once
    if not campaign.specimen.free or not campaign.specimen.slides:
        return campaign, found, start
    likeliest = found.likeliest
    if likeliest is None:
        try:
            start = dict(fit_roughly(campaign, invalid).values)
        except InputError:  # what a fit lacks is told by whoever asks for one
            return campaign, found, start
        likeliest = Logger(LowPass(start["rig.logger"]), known=True)
    elif found.causal is not None:
        found = _told_by_reversals(campaign, invalid, found, likeliest, found.causal)
        likeliest = found.likeliest or likeliest
    return replace(campaign, logger=replace(likeliest, thinning=campaign.logger.thinning)), found, start


def _told_by_reversals(
    campaign: Campaign, invalid: InvalidSamples, found: LoggerEstimate, likeliest: Logger, causal: LowPass
) -> LoggerEstimate:
    """Return the estimate with that one of two filters that fall alike with which a rough fit leaves less.

    Of 19 campaigns in which four poles there and back fell as the spectrum did, all eight that were filtered so left
    0.5 to 18 % more with the other, and all six causal ones of six and eight poles 0.7 to 47 % less.
    """
    other = replace(likeliest, every=causal)
    try:
        costs = [fit_roughly(replace(campaign, logger=logger), invalid).cost for logger in (likeliest, other)]
    except InputError:  # what a fit lacks is told by whoever asks for one
        return found
    if costs[0] <= costs[1]:
        return found
    before = likeliest.every
    scale = causal.frequency / before.frequency if before is not None else 1.0
    lowpass = None if found.lowpass is None else causal
    why = f"{found.why}; eight causal poles rather than four there and back, for nothing rings before a reversal"
    return replace(found, lowpass=lowpass, low=found.low * scale, high=found.high * scale, why=why, likeliest=other)


def estimate_logger(campaign: Campaign) -> LoggerEstimate:
    """Estimate frequency, order and phase of the filter that all channels went through.

    Phase is told from the order only: forward and backward filters fall twice as steeply. Beside a filter of four poles
    there and back stand the eight causal ones that fall alike; `determine_logger` tells the two by a rough fit.
    """
    spectrum = _spectrum(campaign)
    if spectrum is None:
        if any(_forces(run.record) for run in campaign.runs):
            return _unknown("its runs are too short, or sampled too slowly, for a spectrum of friction")
        return _unknown("no horizontal force was recorded, and only reversals of friction show it")
    frequency, power, weight = spectrum
    if len(frequency) < 24:
        return _unknown(f"sampled too slowly: nothing is seen above {frequency[-1] if len(frequency) else 0.0:.0f} Hz")
    # the last one is without a filter at all: a corner far above everything
    asked = [*((*shape, None) for shape in (*_SHAPES, _CAUSAL)), (1, "causal", 50.0 * frequency[-1])]
    *shapes, eight, plain = on_every_core(
        lambda i: _fit(frequency, power, weight, *asked[i]), len(asked), "the logger's filter"
    )
    best = min(shapes, key=lambda shape: shape.cost)
    if plain.cost - best.cost < 10.0 or best.corner > _BELOW * frequency[-1]:
        return _unknown("the spectrum of friction falls evenly into the noise: no filter is seen", Logger(known=True))
    by = LowPass(best.corner, best.order, best.phase)
    likeliest = Logger(by, known=True)
    causal = LowPass(eight.corner, *_CAUSAL) if (best.order, best.phase) == _THERE_AND_BACK else None
    level, slope, _, noise, _ = best.numbers
    if np.exp(level - slope * np.log(best.corner / 50.0)) < _ABOVE * np.exp(noise):
        return _unknown(f"noise hides the bend near {best.corner:.0f} Hz", likeliest, causal)
    spread = compute_halfwidth(best.error)
    if spread > _WIDEST:
        return _unknown(f"the bend near {best.corner:.0f} Hz is uncertain by {spread:.0%}", likeliest, causal)
    alike = [shape for shape in shapes if shape.cost < best.cost + 4.0 and shape is not best]
    corners = [best.corner, *(shape.corner for shape in alike)]
    why = "from the bend in the spectrum of friction"
    if alike:
        others = " or ".join(f"{shape.corner:.0f} Hz, order {shape.order}, {shape.phase}" for shape in alike)
        why += f"; another filter with nearly the same response fits as well: {others}"
    low, high = min(corners) * np.exp(-spread), max(corners) * np.exp(spread)
    return LoggerEstimate(by, float(low), float(high), why, likeliest, causal)


def _unknown(why: str, likeliest: Logger | None = None, causal: LowPass | None = None) -> LoggerEstimate:
    return LoggerEstimate(None, 0.0, 0.0, why, likeliest, causal)


def _forces(record: Record) -> list[str]:
    return [n for n in record.channels if n.startswith("pad_") and n.endswith(("_Fx", "_Fy"))]


def _spectrum(campaign: Campaign) -> tuple[Array, Array, float] | None:
    """Return frequencies, mean density over cells and runs, and the number of independent stretches."""
    total, count, frequency = None, 0.0, None
    for run in campaign.runs:
        record = run.record
        dt = record.dt
        size = round(_STRETCH / dt)
        names = _forces(record)
        if size < 32 or len(record) < 2 * size or not names:
            continue
        if total is not None and len(total) != size // 2 + 1:
            continue
        for name in names:
            frequency, power = welch(record[name], 1.0 / dt, "hann", size, size * 3 // 4, detrend="linear")
            share = len(record) / size
            total = power * share if total is None else total + power * share
            count += share
    if total is None or frequency is None:
        return None
    kept = (frequency > _FROM) & (frequency < 0.98 * frequency[-1])
    # the cells feel the same reversals: only the runs are independent
    return frequency[kept], (total / count)[kept], count / len(campaign.runs) ** 0.5 / 4.0


def _model(numbers: Array, frequency: Array, order: int, phase: str) -> tuple[Array, Array]:
    """Return the density (m,) and its derivatives by the numbers (5, m)."""
    level, slope, corner, noise, tilt = numbers
    passes = 2.0 if phase == "zero" else 1.0
    ratio = (frequency / np.exp(corner)) ** (2 * order)
    above = np.log(frequency / 50.0)
    signal = np.exp(np.minimum(level - slope * above, _LOUDEST)) * (1.0 + ratio) ** -passes
    part = frequency / frequency[-1] - 0.75
    white = np.exp(np.minimum(noise + tilt * part, _LOUDEST))
    bend = signal * passes * 2.0 * order * ratio / (1.0 + ratio)
    return signal + white, np.stack([signal, -signal * above, bend, white, white * part])


def _fit(frequency: Array, power: Array, weight: float, order: int, phase: str, corner: float | None = None) -> _Shape:
    """Fit one shape; with a given corner, that one stays."""

    def cost(numbers: Array) -> tuple[float, Array]:
        model, slopes = _model(numbers, frequency, order, phase)
        value = weight * float(np.sum(np.log(model) + power / model))
        return value, weight * (slopes @ ((1.0 - power / model) / model))

    level = float(np.log(np.interp(50.0, frequency, power)))
    noise = float(np.log(np.median(power[-max(len(power) // 12, 4) :])))
    corners = (45.0, 80.0, 130.0, 180.0) if corner is None else (corner,)
    best = None
    for first in corners:
        if corner is not None or first < 0.95 * frequency[-1]:
            at = (np.log(first), np.log(first)) if corner is not None else (np.log(20.0), np.log(2.0 * frequency[-1]))
            bounds = [(None, None), (0.5, 8.0), at, (None, None), (-4.0, 1.0)]
            begin = np.array([level, 2.0, np.log(first), noise, 0.0])
            found = minimize(cost, begin, jac=True, method="L-BFGS-B", bounds=bounds)
            if best is None or found.fun < best.fun:
                best = found
    if best is None:
        return _Shape(order, phase, np.inf, np.zeros(5), np.inf)
    model, slopes = _model(best.x, frequency, order, phase)
    relative = slopes / model
    error = float(np.sqrt(max(np.linalg.pinv(weight * relative @ relative.T)[2, 2], 0.0)))
    return _Shape(order, phase, float(best.fun), best.x, error)
