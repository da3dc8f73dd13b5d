"""Faults of samples: a wrong sign, a rail, lost samples. They are seen in the samples, before any fit.

Signs are told by balances that no law of friction enters: slip against accelerometers, heave, friction against motion.
A rail is a stretch of equal extreme values; lost samples repeat the one before more often than rounding does.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign import Campaign
from slipwise.channels import PADS, VELOCITY_CHANNELS
from slipwise.record import Record
from slipwise.signals import LowPass, lowpass, white_level
from slipwise.signals.ends import in_frequency

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: A correlation below this says that a sign is wrong.
_AGAINST = -0.3
#: Equal samples at an extreme that make a rail; share of repeated samples above chance that means lost ones.
_PLATEAU, _REPEATED = 4, 0.002
#: So many repeats at the ends of the runs, some in each, mean it too where chance repeats at most this share: records
#: that had to be filled up, for what was lost had moved all that came after.
_FILLED, _RARELY = 8, 0.1
#: Spoiled before and after a bad sample; more where the velocity is made of the channel [samples].
_REACH, _REACH_OF_MOTION = 6, 40


@dataclass(frozen=True)
class SampleFault:
    """A fault that the samples show.

    Attributes:
        effect: "channel_sign", "channel_clipping" or "dropped_samples".
        channel: name.
        share: of the samples that it touches [1].
        moved: whether samples were lost for good, so that all that came after is late.
    """

    effect: str
    channel: str
    share: float
    moved: bool = False


def sample_faults(campaign: Campaign) -> tuple[SampleFault, ...]:
    """Find the faults of samples of a campaign."""
    found = [SampleFault("channel_sign", c, 1.0) for c in _wrong_signs(campaign)]
    if not campaign.specimen.free:
        return tuple(found)  # a slider's actuator may rest at its ends as long as it likes
    names = [n for n in campaign.runs[0].record.channels if not n.startswith("table_d")]
    # what every channel repeats at its end is a record that was cut, no gauge's loss
    cut = [min(_filled_up(r.record[n]) for n in names if n in r.record) for r in campaign.runs]
    for name in names:
        here = zip(campaign.runs, cut, strict=True)
        runs = [r.record[name][: len(r.record) - c] for r, c in here if name in r.record]
        if any(_coarse(values) for values in runs):
            continue  # rounding makes equal samples of its own
        rails = [_at_rail(values) for values in runs]
        held = [_repeats(values) for values in runs]
        # a peak that is held looks like a rail, but then other samples are held as well
        elsewhere = [_repeats(values[~rail]) for values, rail in zip(runs, rails, strict=True)]
        filled = [_filled_up(values) for values in runs]
        moved = min(filled) > 0 and sum(filled) >= _FILLED
        lost = all(h > _REPEATED for h in held) or moved
        total = sum(len(values) for values in runs)
        clipped = sum(int(np.count_nonzero(r)) for r in rails)
        if clipped >= _PLATEAU and not (lost and all(h > _REPEATED for h in elsewhere)):
            found.append(SampleFault("channel_clipping", name, clipped / total))
        elif lost:
            share = max(float(np.mean(held)), sum(filled) / total)
            found.append(SampleFault("dropped_samples", name, share, moved))
    return tuple(found)


def mended(campaign: Campaign, faults: tuple[SampleFault, ...]) -> tuple[Campaign, dict[str, dict[str, Mask]]]:
    """Turn wrong signs round, and tell which samples of each run and channel must not be judged.

    Args:
        campaign: as measured.
        faults: found in it.
    """
    records: dict[str, Record] = {}
    spoiled: dict[str, dict[str, Mask]] = {}
    for run in campaign.runs:
        record, spoilt = run.record, dict[str, Mask]()
        for fault in (f for f in faults if f.channel in record):
            values = record[fault.channel]
            if fault.effect == "channel_sign":
                record = record.replaced(**{fault.channel: -values})
                continue
            bad = _at_rail(values)
            if fault.effect == "dropped_samples":
                bad[1:] |= values[1:] == values[:-1]
                between = np.interp(record.time, record.time[~bad], values[~bad])
                record = record.replaced(**{fault.channel: between})
            reach = _REACH_OF_MOTION if fault.channel in VELOCITY_CHANNELS else _REACH
            spoilt[fault.channel] = np.convolve(bad, np.ones(2 * reach + 1), mode="same") > 0.5
        records[run.name] = record
        spoiled[run.name] = spoilt
    runs = tuple(replace(r, record=records[r.name]) for r in campaign.runs)
    return replace(campaign, runs=runs), spoiled


def _wrong_signs(campaign: Campaign) -> list[str]:
    if not campaign.specimen.free:
        return []
    signs: dict[str, list[float]] = {}
    for run in campaign.runs:
        for name, value in _signs(run.record).items():
            signs.setdefault(name, []).append(value)
    mean = {n: float(np.mean(v)) for n, v in signs.items()}
    out = []
    if mean.get("slip_x", 1.0) < _AGAINST:
        out.append("slip_x")
    elif mean.get("girder_ax", 1.0) < _AGAINST:
        out.append("girder_ax")
    turned = -1.0 if "slip_x" in out else 1.0
    out += [n for n, v in mean.items() if n.endswith("_Fx") and turned * v < _AGAINST]
    if mean.get("girder_az", 1.0) < _AGAINST:
        out.append("girder_az")
    return out


def _signs(record: Record) -> Mapping[str, float]:
    """Give a number for each channel: near 1 where its sign is right, near -1 where it is wrong."""
    out: dict[str, float] = {}
    dt, smooth = record.dt, LowPass(min(12.0, 0.1 / record.dt), 4, "aligned")
    slip = lowpass(record["slip_x"] - record["slip_x"][0], dt, smooth)
    rate = np.gradient(slip, dt)
    if record.has_all("girder_ax", "table_ax"):
        bend = in_frequency(slip, dt, lambda f: -((2.0 * np.pi * f) ** 2), 256)
        girder, table = (lowpass(record[n], dt, smooth) for n in ("girder_ax", "table_ax"))
        own, other = np.linalg.lstsq(np.stack([girder, -table], axis=1), bend, rcond=None)[0]
        out["slip_x"] = -1.0 if own < 0.0 and other < 0.0 else 1.0
        out["girder_ax"] = -1.0 if own < 0.0 < other else 1.0
    moving = np.abs(rate) > 0.2 * float(np.max(np.abs(rate)))
    for pad in PADS:
        name = f"pad_{pad}_Fx"
        if name in record and moving.any():
            out[name] = float(np.mean(np.sign(record[name][moving]) * np.sign(rate[moving])))
    loads = [f"pad_{p}_N" for p in PADS]
    if record.has_all("girder_az", *loads):
        total = lowpass(sum(record[n] for n in loads), dt, smooth)  # type: ignore[arg-type]
        vertical = lowpass(record["girder_az"], dt, smooth)
        strong = float(np.std(vertical)) > 3.0 * white_level(record["girder_az"]) * np.sqrt(2.0 * 12.0 * dt)
        if strong:
            out["girder_az"] = float(np.corrcoef(total, vertical)[0, 1])
    return out


def _coarse(values: Array) -> bool:
    """Tell whether a channel is rounded so much that equal neighbours are usual."""
    steps = np.abs(np.diff(values))
    steps = steps[steps > 0.0]
    return steps.size < 32 or float(steps.min()) > 0.3 * white_level(values)


def _at_rail(values: Array) -> Mask:
    """Tell which samples stand at the largest or smallest value, in stretches of equal ones."""
    out = np.zeros(len(values), dtype=bool)
    if float(np.ptp(values)) == 0.0:
        return out
    for rail in (values.max(), values.min()):
        here = values == rail
        joined = here & (np.roll(here, 1) | np.roll(here, -1))
        if np.count_nonzero(joined) >= _PLATEAU:
            out |= here
    return out


def _repeats(values: Array) -> float:
    """Give the share of samples that repeat the one before, above what rounding makes of noise."""
    same, expected = _same(values), _by_chance(values)
    if expected == 1.0:
        return 0.0
    return max(float(np.mean(same)) - expected - 4.0 * np.sqrt(expected / len(same)), 0.0)


def _filled_up(values: Array) -> int:
    """Give how often the last value was repeated to fill up the record; 0 where rounding may have done it."""
    other = np.flatnonzero(~_same(values))
    return len(values) - 2 - int(other[-1]) if other.size and _by_chance(values) < _RARELY else 0


def _same(values: Array) -> Mask:
    return np.diff(values) == 0.0


def _by_chance(values: Array) -> float:
    """Give the share of samples that repeat the one before because of rounding; 1 where nothing changes [1]."""
    steps = np.diff(values)
    finite = np.abs(steps[steps != 0.0])
    if finite.size < 32:
        return 1.0
    quantum = float(finite.min())
    spread = np.hypot(1.4142 * white_level(values), quantum)
    slope = np.convolve(steps, np.ones(15) / 15.0, mode="same")
    return float(np.mean(np.minimum(quantum / (2.5066 * spread) * np.exp(-0.5 * (slope / spread) ** 2), 1.0)))
