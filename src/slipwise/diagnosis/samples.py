"""Faults of samples: a wrong sign, a rail, lost samples. They are seen in the samples, before any fit.

Signs are told by balances that no law of friction enters: slip against accelerometers, heave, friction against motion.
Rails and samples that repeat or were lost are those that the audit of the instruments finds.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign import Campaign
from slipwise.channels import PADS, VELOCITY_CHANNELS
from slipwise.instruments import sample_faults as samples
from slipwise.instruments.suspects import effect_of
from slipwise.record import Record
from slipwise.signals import LowPass, lowpass, white_level
from slipwise.signals.ends import in_frequency

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: A correlation below this says that a sign is wrong.
_AGAINST = -0.3
#: Spoiled before and after a bad sample; more where the velocity is made of the channel [samples].
_REACH, _REACH_OF_MOTION = 6, 40


@dataclass(frozen=True)
class SampleFault:
    """A fault that the samples show.

    Attributes:
        effect: name in the catalogue.
        channel: name.
        share: of the samples that it touches [1].
        moved: whether samples were lost for good, so that all that came after is late.
        seen: what the audit's look at the samples found; empty for a wrong sign.
    """

    effect: str
    channel: str
    share: float
    moved: bool = False
    seen: tuple[samples.SampleFault, ...] = ()


def sample_faults(campaign: Campaign) -> tuple[SampleFault, ...]:
    """Find the faults of samples of a campaign, as the audit of the instruments finds them."""
    found = [SampleFault(effect_of("turned").name, c, 1.0) for c in _wrong_signs(campaign)]
    if not campaign.specimen.free:
        return tuple(found)  # a slider's actuator may rest at its ends as long as it likes
    for (effect, channel), faults in _by_channel(samples.sample_faults(campaign)).items():
        runs = [run.record[channel] for run in campaign.runs if channel in run.record]
        bad = [_bad_samples(faults, run.name, run.record[channel]) for run in campaign.runs if channel in run.record]
        moved = any(fault.kind == "lost" for fault in faults)
        share = faults[0].size if moved else sum(int(b.sum()) for b in bad) / sum(len(v) for v in runs)
        found.append(SampleFault(effect, channel, share, moved, faults))
    return tuple(found)


def _by_channel(faults: list[samples.SampleFault]) -> dict[tuple[str, str], tuple[samples.SampleFault, ...]]:
    """Give the faults of every channel that a fit must know: both rails together; a gap is the clock's, no gauge's."""
    out: dict[tuple[str, str], tuple[samples.SampleFault, ...]] = {}
    for fault in (f for f in faults if f.kind in (*samples.RAILS, "held", "lost")):
        for name in fault.channels:
            key = effect_of(fault.kind).name, name
            out[key] = (*out.get(key, ()), fault)
    return out


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
            if not fault.seen:
                record = record.replaced(**{fault.channel: -values})
                continue
            bad = _bad_samples(fault.seen, run.name, run.record[fault.channel])
            if all(one.kind not in samples.RAILS for one in fault.seen):
                between = np.interp(record.time, record.time[~bad], values[~bad])
                record = record.replaced(**{fault.channel: between})
            reach = _REACH_OF_MOTION if fault.channel in VELOCITY_CHANNELS else _REACH
            spoilt[fault.channel] = np.convolve(bad, np.ones(2 * reach + 1), mode="same") > 0.5
        records[run.name] = record
        spoiled[run.name] = spoilt
    runs = tuple(replace(r, record=records[r.name]) for r in campaign.runs)
    return replace(campaign, runs=runs), spoiled


def _bad_samples(faults: tuple[samples.SampleFault, ...], run: str, values: Array) -> Mask:
    """Give the samples (n,) that are no measurement; of a channel that lost some, those that repeat the one before."""
    bad = np.zeros(len(values), dtype=bool)
    for fault in faults:
        if fault.kind == "lost":
            bad[1:] |= values[1:] == values[:-1]
        else:
            bad |= fault.bad.get(run, False)
    return bad


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
