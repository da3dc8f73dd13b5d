"""Records without the harm that bad samples do: balances leave rows out, fits leave samples out.

Wrong signs, units and zeros that are far off are put right in both. A balance looks at all channels at one
instant, so that one bad sample costs a row; a fit judges channel by channel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from slipwise.campaign import Campaign, Run
from slipwise.campaign.aligned import spread
from slipwise.campaign.wild_samples import WildSamples
from slipwise.channels import VELOCITY_CHANNELS
from slipwise.preparation.outliers import without_outliers
from slipwise.preparation.sample_faults import RAILS, SampleFault
from slipwise.preparation.synchronisation import in_step, without_partner
from slipwise.record import Record

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: run -> channel -> samples (n,) at which the channel is no measurement.
InvalidSamples = Mapping[str, Mapping[str, Mask]]
#: Faults whose samples are no measurement.
_INVALID = (*RAILS, "held", "lost", "dead", "wild")
#: Invalid before and after a bad sample; more where the velocity is made of the channel [samples].
_REACH, _REACH_OF_MOTION = 6, 40
#: Rows left out before and after a rail or a gap [s].
_AROUND = 0.03


def for_balances(campaign: Campaign, faults: Sequence[SampleFault]) -> tuple[dict[str, Record], dict[str, Mask]]:
    """Return records in which bad samples do no harm to the balances, and the samples to leave out, by run.

    Wrong signs are reversed, units and zeros put right, repeated samples bridged; around rails, gaps and wild samples
    rows are left out; outliers are bridged; a channel that is dead or wild throughout, or has lost samples and so its
    place in time, is taken out.
    """
    records, out = {}, {}
    for run in campaign.runs:
        channels = dict(_put_right(_in_step(run.record, faults), faults).channels)
        leave = _without_partner(run.record, faults)
        for one in _wild_in_step(run, faults):
            leave |= one.bad
        for fault in faults:
            bad = fault.bad.get(run.name)
            if bad is None:
                continue
            if fault.kind in (*RAILS, "gap"):
                leave |= bad
            for name in fault.channels:
                if fault.kind == "held" and name in channels:
                    channels[name] = bridged(channels[name], bad)
        for fault in faults:
            if fault.kind in ("lost", "dead", "wild"):
                for name in fault.channels:
                    channels.pop(name, None)
        reach = max(int(_AROUND / run.record.dt), 1)
        record = Record(run.record.time, channels, run.record.provenance)
        records[run.name] = without_outliers(record, campaign.specimen)
        out[run.name] = spread(leave, reach, reach) if leave.any() else leave
    return records, out


def for_fits(campaign: Campaign, faults: Sequence[SampleFault]) -> tuple[Campaign, InvalidSamples]:
    """Reverse wrong signs, bridge repeated samples, and tell which samples of each channel must not be judged.

    Args:
        campaign: as recorded.
        faults: found in it.
    """
    records: dict[str, Record] = {}
    invalid: dict[str, dict[str, Mask]] = {}
    for run in campaign.runs:
        aligned, found = _in_step(run.record, faults), dict[str, Mask]()
        record = _put_right(aligned, faults)
        unpaired = _without_partner(record, faults)
        for name in dict.fromkeys(name for fault in faults for name in fault.channels if name in record):
            values = aligned[name]
            own = [fault for fault in faults if name in fault.channels and fault.kind in _INVALID]
            if unpaired.any():
                found[name] = unpaired
            if not own:
                continue
            bad = np.any([_bad_samples(fault, run.name, values) for fault in own], axis=0)
            if all(fault.kind not in RAILS for fault in own) and not bad.all():
                between = np.interp(record.time, record.time[~bad], record[name][~bad])
                record = record.replaced(**{name: between})
            found[name] = unpaired | _around(name, bad)
        records[run.name] = record
        invalid[run.name] = found
    runs = (replace(r, record=records[r.name], wild=_wild_in_step(r, faults)) for r in campaign.runs)
    return replace(campaign, runs=tuple(runs)), invalid


def with_wild(run: Run, invalid: Mapping[str, Mask]) -> dict[str, Mask]:
    """Return the samples that a fit must not judge: those given, and those around a run's wild samples.

    Args:
        run: with its wild samples.
        invalid: channel -> samples (n,) at which it is no measurement.
    """
    out = dict(invalid)
    for name, bad in run.invalid.items():
        out[name] = out.get(name, np.zeros(len(bad), dtype=bool)) | _around(name, bad)
    return out


def _around(name: str, bad: Mask) -> Mask:
    """Return the samples (n,) that bad ones of a channel make unsure."""
    reach = _REACH_OF_MOTION if name in VELOCITY_CHANNELS else _REACH
    return spread(bad, reach, reach)


def _wild_in_step(run: Run, faults: Sequence[SampleFault]) -> tuple[WildSamples, ...]:
    """Return the wild samples of a run where they are once its late channels were brought forward."""
    late = {name: fault.size for fault in faults if fault.kind == "late" for name in fault.channels}
    moved = []
    for one in run.wild:
        steps = round(late.get(one.channel, 0.0) / run.record.dt)
        at = np.flatnonzero(one.bad) - steps
        bad = np.zeros(len(one.bad), dtype=bool)
        bad[at[(at >= 0) & (at < len(bad))]] = True
        moved.append(replace(one, bad=spread(bad, 1, 1) if steps else bad))
    return tuple(moved)


def _in_step(record: Record, faults: Sequence[SampleFault]) -> Record:
    for fault in (f for f in faults if f.kind == "late"):
        record = in_step(record, fault.channels, fault.size)
    return record


def _without_partner(record: Record, faults: Sequence[SampleFault]) -> Mask:
    """Return the samples (n,) at which channels that were late have ended before the others."""
    late = [without_partner(len(record), record.dt, fault.size) for fault in faults if fault.kind == "late"]
    return np.any([np.zeros(len(record), dtype=bool), *late], axis=0)


def _put_right(record: Record, faults: Sequence[SampleFault]) -> Record:
    factors = {n: fault.size for fault in faults if fault.kind == "scaled" for n in fault.channels if n in record}
    record = record.replaced(**{name: record[name] / factor for name, factor in factors.items()})
    shift = {n: fault.size for fault in faults if fault.kind == "shifted" for n in fault.channels if n in record}
    level = record.replaced(**{name: record[name] - size for name, size in shift.items()})
    wrong = [name for fault in faults if fault.kind == "turned" for name in fault.channels if name in record]
    return level.replaced(**{name: -level[name] for name in wrong})


def _bad_samples(fault: SampleFault, run: str, values: Array) -> Mask:
    """Return samples (n,) that are no measurement; of a channel that lost some, those that repeat the one before."""
    if fault.kind == "lost":
        return np.concatenate([[False], values[1:] == values[:-1]])
    return fault.bad.get(run, np.zeros(len(values), dtype=bool))


def bridged(values: Array, bad: Mask) -> Array:
    """Return the values with bad samples interpolated between their good neighbours, by cubic splines."""
    good = np.flatnonzero(~bad)
    return np.where(bad, CubicSpline(good, values[good])(np.arange(len(values))), values)
