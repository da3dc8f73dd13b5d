"""Single samples that no gauge would give: dead channels, rails, samples that repeat, samples that are lost."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from slipwise.campaign import Campaign, Run
from slipwise.campaign.aligned import spread
from slipwise.record import Record
from slipwise.signals import white_level

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: A rail holds at least this many samples of a campaign, most of them side by side [1].
_RAIL, _BESIDE = 6, 0.6
#: Samples repeat when so many more of them equal their neighbour than equal the one after it (standard deviations),
#: and this part of all [1].
_SURE, _REPEATED = 6.0, 0.002
#: Equal values at the end of a channel that others do not have: as many were lost before.
_TAIL = 4
#: A step of time longer than this many usual ones has lost samples.
_GAP = 1.6


@dataclass(frozen=True)
class SampleFault:
    """Bad samples of one channel, or of several at the same instants.

    Attributes:
        kind: "dead", "rail", "held", "lost" or "gap".
        channels: that show it.
        size: rail in the channel's unit; else share of all samples [1].
        bad: run -> samples that are no measurement (n,).
        runs: names of the runs that show it.
    """

    kind: str
    channels: tuple[str, ...]
    size: float
    bad: dict[str, Mask]
    runs: tuple[str, ...]


def sample_faults(campaign: Campaign) -> list[SampleFault]:
    """Look for bad samples in every channel of every run."""
    found: list[SampleFault] = []
    names = list(dict.fromkeys(name for run in campaign.runs for name in run.record.channels))
    for name in names:
        runs = [run for run in campaign.runs if name in run.record]
        fault = _dead(name, runs)
        if fault is None and not (name.startswith("slip") and not campaign.specimen.free):
            fault = _rail(name, runs)
        found += [fault] if fault else [f for f in (_held(name, runs), _lost(name, runs)) if f]
    return [*_gaps(campaign), *_together(found)]


def _dead(name: str, runs: Sequence[Run]) -> SampleFault | None:
    """A channel that never moves while others do; a constant of campaign.toml does not move in any run."""
    still = [run for run in runs if np.ptp(run.record[name]) == 0.0]
    if not still or len(still) == len(runs):
        return None
    bad = {run.name: np.ones(len(run.record), dtype=bool) for run in still}
    return SampleFault("dead", (name,), -1.0, bad, tuple(bad))


def _rail(name: str, runs: Sequence[Run]) -> SampleFault | None:
    for side in (1.0, -1.0):
        top = max(float((side * run.record[name]).max()) for run in runs)
        bad = {run.name: side * run.record[name] >= top for run in runs}
        count = sum(int(b.sum()) for b in bad.values())
        beside = sum(int((b[1:] & b[:-1]).sum()) for b in bad.values())
        if count >= _RAIL and beside >= _BESIDE * count and _cut(name, runs, bad, side):
            return SampleFault("rail", (name,), side * top, bad, tuple(n for n, b in bad.items() if b.any()))
    return None


def _cut(name: str, runs: Sequence[Run], bad: dict[str, Mask], side: float) -> bool:
    """Tell a rail from a rest at the largest value: a rail is met and left at speed, far above the noise of a sample."""
    steps, everywhere = [], []
    for run in runs:
        values, on = side * run.record[name], bad[run.name]
        edges = np.flatnonzero(on[1:] != on[:-1])
        steps.extend(np.abs(values[edges + 1] - values[edges]).tolist())
        everywhere.append(white_level(values))
    return bool(steps) and float(np.median(steps)) > 0.2 * float(np.median(everywhere))


def _held(name: str, runs: Sequence[Run]) -> SampleFault | None:
    bad: dict[str, Mask] = {}
    equal = unequal = count = 0
    for run in runs:
        values = run.record[name]
        same = np.zeros(len(values), dtype=bool)
        same[1:] = values[1:] == values[:-1]
        # by chance a sample equals the one before the last as often as the last
        chance = np.zeros(len(values), dtype=bool)
        chance[2:] = (values[2:] == values[:-2]) & ~same[2:] & ~same[1:-1]
        tail = _tail(values)
        same[len(values) - tail :] = False
        equal, unequal, count = equal + int(same.sum()), unequal + int(chance.sum()), count + len(values)
        bad[run.name] = same
    coarse = any(_coarse(run.record[name]) for run in runs)
    if coarse or equal - unequal < _SURE * np.sqrt(equal + unequal + 1.0) or equal - unequal < _REPEATED * count:
        return None
    return SampleFault("held", (name,), (equal - unequal) / count, bad, tuple(n for n, b in bad.items() if b.any()))


def _coarse(values: Array) -> bool:
    """Tell whether values are so coarse that neighbours are often equal by rounding."""
    steps = np.abs(np.diff(values))
    moving = steps[steps > 0.0]
    return (
        len(moving) < 10
        or float(np.median(moving)) < 4.0 * float(np.quantile(moving, 0.02))
        or (len(np.unique(values)) < 0.05 * len(values))
    )


def _tail(values: Array) -> int:
    """How many samples before the last one equal it without a break."""
    different = np.flatnonzero(values != values[-1])
    return len(values) - 1 - int(different[-1]) - 1 if len(different) else 0


def _lost(name: str, runs: Sequence[Run]) -> SampleFault | None:
    tails = {run.name: _tail(run.record[name]) for run in runs}
    shown = [n for n, tail in tails.items() if tail >= _TAIL]
    if not shown or any(_coarse(run.record[name]) for run in runs):
        return None
    bad = {run.name: np.ones(len(run.record), dtype=bool) for run in runs if run.name in shown}
    count = sum(len(run.record) for run in runs)
    return SampleFault("lost", (name,), sum(tails.values()) / count, bad, tuple(shown))


def _gaps(campaign: Campaign) -> list[SampleFault]:
    lost, bad, count = 0, {}, 0
    for run in campaign.runs:
        steps = np.diff(run.record.time)
        dt = float(np.median(steps))
        wide = steps > _GAP * dt
        # a clock that is only rounded has no gap: its steps make up for each other
        if np.any(wide) and np.sum(steps[wide]) - dt * wide.sum() > 2.0 * dt:
            lost += int(np.sum(np.round(steps[wide] / dt) - 1))
            bad[run.name] = np.concatenate([[False], wide])
        count += len(run.record)
    names = tuple(campaign.runs[0].record.channels)
    return [SampleFault("gap", names, lost / (count + lost), bad, tuple(bad))] if lost else []


def _together(faults: list[SampleFault]) -> list[SampleFault]:
    """Join channels that repeat or lose the same samples: they are one card."""
    joined: list[SampleFault] = []
    for fault in faults:
        for i, other in enumerate(joined):
            if fault.kind == other.kind and fault.kind in ("held", "lost") and _alike(fault, other):
                channels = (*other.channels, *fault.channels)
                joined[i] = SampleFault(fault.kind, channels, max(fault.size, other.size), other.bad, other.runs)
                break
        else:
            joined.append(fault)
    return joined


def _alike(one: SampleFault, other: SampleFault) -> bool:
    if set(one.bad) != set(other.bad):
        return False
    both = sum(int((one.bad[n] & other.bad[n]).sum()) for n in one.bad if len(one.bad[n]) == len(other.bad[n]))
    most = max(sum(int(b.sum()) for b in f.bad.values()) for f in (one, other))
    return both > 0.7 * most and abs(one.size - other.size) < 0.3 * max(one.size, other.size)


def repaired(campaign: Campaign, faults: Sequence[SampleFault]) -> tuple[dict[str, Record], dict[str, Mask]]:
    """Give records in which bad samples do no harm to the balances, and the samples to leave out, by run.

    Repeated samples are bridged; around rails and gaps rows are left out; a channel that is dead, or has lost samples
    and so its place in time, is taken out.
    """
    records, out = {}, {}
    for run in campaign.runs:
        channels = dict(run.record.channels)
        leave = np.zeros(len(run.record), dtype=bool)
        for fault in faults:
            bad = fault.bad.get(run.name)
            if bad is None:
                continue
            if fault.kind in ("rail", "gap"):
                leave |= bad
            for name in fault.channels:
                if fault.kind == "held" and name in channels:
                    channels[name] = bridged(channels[name], bad)
        for fault in faults:
            if fault.kind in ("lost", "dead"):
                for name in fault.channels:
                    channels.pop(name, None)
        reach = max(int(0.03 / run.record.dt), 1)
        records[run.name] = Record(run.record.time, channels, run.record.provenance)
        out[run.name] = spread(leave, reach, reach) if leave.any() else leave
    return records, out


def bridged(values: Array, bad: Mask) -> Array:
    """Give the values with bad samples interpolated between their good neighbours, by cubic splines."""
    good = np.flatnonzero(~bad)
    return np.where(bad, CubicSpline(good, values[good])(np.arange(len(values))), values)
