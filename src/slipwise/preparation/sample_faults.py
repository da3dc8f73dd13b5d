"""What samples show by themselves: wrong signs, dead channels, rails, samples that repeat, samples that are lost."""

import re
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign import Campaign, Run
from slipwise.campaign.wild_samples_of_runs import FAULTY, faulty_share
from slipwise.campaign.zero_state import carries_nothing
from slipwise.channels import pads_in
from slipwise.preparation.level_faults import agreed_late, agreed_turned, dead_in, read_levels, turned_displacements
from slipwise.preparation.outliers import bridge_outliers
from slipwise.preparation.put_right import put_right
from slipwise.preparation.rounding import NEAR, estimate_chance_of_equal, is_coarse
from slipwise.preparation.sample_fault import SampleFault
from slipwise.preparation.signs import find_wrong_signs
from slipwise.preparation.synchronisation import (
    LateChannels,
    find_late_cells,
    find_late_motion,
    find_late_single_cells,
)
from slipwise.preparation.tare import find_shifted_zeros, find_tared_cells
from slipwise.preparation.wrong_units import LIKE_IT, find_wrong_units
from slipwise.rig import Specimen
from slipwise.rig.load_basis import RIGID_MODES, basis_of
from slipwise.signals.noise import quantum, white_level
from slipwise.signals.resample import slower_rate

#: A pad's cell, and the share of what its like scatter below which it shows nothing but noise [1].
_CELL, _IDLE = re.compile(r"pad_[A-Za-z0-9]+_(?P<kind>N|Fx|Fy)$"), 0.08
#: A channel that is dead in one run is dead in another that scatters by so many times as much at most [1].
_NOISY = 2.0
#: A rail holds at least this many samples of a campaign, in one place at least that many, this part side by side [1].
_RAIL, _LONG_RAIL, _BESIDE = 6, 15, 0.5
#: A rail is met faster than this many standard deviations of noise, and this many steps of rounding, a sample [1].
_FAST, _STEPS = 0.2, 1.5
#: Samples repeat when so many more of them equal their neighbour than rounding explains (standard deviations), and
#: this part of all [1].
_SURE, _REPEATED = 6.0, 0.002
#: What rounding does may be misjudged by this share: a converter's steps and a file's digits do not fit each other [1].
_MISJUDGED = 1.0
#: Equal values at the end of a run, and of all runs, where single ones are rare: as many were lost before.
_TAIL, _TAILS, _RARE = 4, 8, 0.15
#: A step of time longer than this many usual ones has lost samples.
_GAP = 1.6


def find_sample_faults(campaign: Campaign) -> list[SampleFault]:
    """Look for late loggers, wrong signs and units, zeros that are far off and bad samples in every channel and run.

    Each step looks at records in which what was found before is put right; lags, signs, units and zeros are told from
    records without outliers.
    """
    steady = bridge_outliers(campaign)
    late = _late(campaign, find_late_motion(steady))
    late += _late(campaign, find_late_cells(put_right(steady, late)))
    for one in find_late_single_cells(put_right(steady, late)):
        late += _late(campaign, one)
    steady = put_right(steady, late)
    scaled = _scaled(steady)
    steady = put_right(steady, scaled)
    turned = _turned(steady)
    levels = read_levels(put_right(steady, turned))
    every = tuple(run.name for run in campaign.runs)
    turned += [SampleFault("turned", (name,), -1.0, {}, every) for name in agreed_turned(levels)]
    backwards = turned_displacements(put_right(steady, turned))
    turned += [SampleFault("turned", (name,), -1.0, {}, every) for name in backwards]
    late += [SampleFault("late", (name,), delay, {}, every) for name, delay in agreed_late(levels).items()]
    bad = _bad_samples(put_right(campaign, late + scaled), dead_in(levels))
    return [*_gaps(campaign), *_join([*turned, *_shifted(steady), *scaled, *late, *bad])]


def _late(campaign: Campaign, found: LateChannels | None) -> list[SampleFault]:
    every = tuple(run.name for run in campaign.runs)
    return [] if found is None else [SampleFault("late", found.channels, found.delay, {}, every)]


def _scaled(campaign: Campaign) -> list[SampleFault]:
    """Wrong units, told by balances, which mean nothing before wrong signs are turned round."""
    every = tuple(run.name for run in campaign.runs)
    units = find_wrong_units(put_right(campaign, _turned(campaign)))
    return [SampleFault("scaled", one.channels, one.factor, {}, every) for one in units]


def _turned(campaign: Campaign) -> list[SampleFault]:
    """Wrong signs; the pads' cells of a kind are one card."""
    every, wrong = tuple(run.name for run in campaign.runs), find_wrong_signs(campaign, find_tared_cells(campaign))
    cards = [tuple(f"pad_{pad}_{kind}" for pad in campaign.specimen.pads) for kind in ("N", "Fx", "Fy")]
    whole = [card for card in cards if set(card) <= set(wrong)]
    alone = [(name,) for name in wrong if not any(name in card for card in whole)]
    return [SampleFault("turned", channels, -1.0, {}, every) for channels in (*whole, *alone)]


def _shifted(campaign: Campaign) -> list[SampleFault]:
    every = tuple(run.name for run in campaign.runs)
    return [SampleFault("shifted", zero.channels, zero.size, {}, every) for zero in find_shifted_zeros(campaign)]


def _bad_samples(campaign: Campaign, idle: Mapping[str, Collection[str]]) -> list[SampleFault]:
    """Channels that are dead or wild, and samples at a rail, repeated or lost; of a dead channel nothing else.

    Args:
        campaign: whose samples are looked at.
        idle: channel -> names of runs in which it shows nothing beside its like.
    """
    found: list[SampleFault] = []
    names = list(dict.fromkeys(name for run in campaign.runs for name in run.record.channels))
    # what every channel repeats at its end is a record that was cut, no gauge's loss
    cut = {
        run.name: min((_tail(values) for values in run.record.channels.values()), default=0) for run in campaign.runs
    }
    for name in names:
        runs = [run for run in campaign.runs if name in run.record]
        fault = _wild(name, runs) or _dead(name, runs, campaign.specimen, idle.get(name, ()))
        if fault is not None:
            found.append(fault)
            continue
        if name.startswith("slip") and not campaign.specimen.free:
            continue  # an actuator rests as long as it likes: no rail, and samples repeat by themselves
        found += _rails(name, runs) or [f for f in (_held(name, runs), _lost(name, runs, cut)) if f]
    return found


def _wild(name: str, runs: Sequence[Run]) -> SampleFault | None:
    """A channel that writes more than single wild samples is no gauge any more; single ones are only left out."""
    share = faulty_share(runs, name)
    if share <= FAULTY:
        return None
    shown = {run.name for run in runs if any(one.channel == name for one in run.wild)}
    bad = {run.name: np.ones(len(run.record), dtype=bool) for run in runs if run.name in shown}
    return SampleFault("wild", (name,), share, bad, tuple(bad))


def _dead(name: str, runs: Sequence[Run], specimen: Specimen, idle: Collection[str]) -> SampleFault | None:
    """A channel that never moves while others do; a constant of campaign.toml does not move in any run.

    The cell of a pad may be dead and noisy: it hardly scatters where the other cells of its kind move.
    """
    constant = {run.name for run in runs if np.ptp(run.record[name]) == 0.0}
    still = set(idle) if len(constant) == len(runs) else constant | set(idle)
    still |= {run.name for run in runs if _idle_beside_its_like(name, run, specimen)}
    if specimen.free:
        records, loads = [run.record for run in runs], [f"pad_{pad}_N" for pad in specimen.pads]
        still |= {run.name for run in runs if carries_nothing(name, run.record, records, loads)}
    if not still:
        return None
    still |= {run.name for run in runs if _shows_what_it_shows_when_dead(name, run, still, runs)}
    bad = {run.name: np.ones(len(run.record), dtype=bool) for run in runs if run.name in still}
    return SampleFault("dead", (name,), -1.0, bad, tuple(bad))


def _shows_what_it_shows_when_dead(name: str, run: Run, still: Collection[str], runs: Sequence[Run]) -> bool:
    """Return whether a channel that is dead in other runs shows their value and their noise: its like hardly moves."""
    dead = np.concatenate([other.record[name] for other in runs if other.name in still])
    noise = _NOISY * float(np.std(dead))
    here = run.record[name]
    return float(np.std(here)) <= noise and abs(float(np.median(here)) - float(np.median(dead))) <= noise


def _idle_beside_its_like(name: str, run: Run, specimen: Specimen) -> bool:
    match = _CELL.match(name)
    pads = pads_in(run.record.channels)
    others = [f"pad_{p}_{match['kind']}" for p in pads if f"pad_{p}_{match['kind']}" != name] if match else []
    if match is None or len(others) < LIKE_IT or not run.record.has_all(*others):
        return False
    moved = float(np.median([np.std(run.record[n]) for n in others]))
    if match["kind"] == "N" and specimen.free and set(pads) == set(specimen.pads):
        moved = min([moved, *(float(np.std(load)) for load in _expected(name, others, run, specimen))])
    return float(np.std(run.record[name])) < _IDLE * moved


def _expected(name: str, others: Sequence[str], run: Run, specimen: Specimen) -> list[Array]:
    """Return what a pad carries (n,) [N] by the others: pads in the middle of a row do not feel the pitch.

    A rigid girder says so by the place of three others, of which one may be dead itself where there are more; where
    there are two, its weight and its vertical acceleration do.
    """
    if len(others) < RIGID_MODES:
        if not run.record.has_all("girder_az"):
            return []
        held = specimen.carried_mass * (specimen.gravity + run.record["girder_az"])
        return [held - np.sum([run.record[n] for n in others], axis=0)]
    rigid = basis_of(specimen).rigid * np.array(specimen.springs)
    patterns = {f"pad_{pad}_N": rigid[:, i] for i, pad in enumerate(specimen.pads)}
    found = []
    for seen in (others, *([n for n in others if n != left] for left in others if len(others) > RIGID_MODES)):
        loads = np.stack([run.record[n] for n in seen])
        found.append(patterns[name] @ np.linalg.lstsq(np.stack([patterns[n] for n in seen]), loads, rcond=None)[0])
    return found


def _rails(name: str, runs: Sequence[Run]) -> list[SampleFault]:
    """An amplifier has two rails, and a gauge may meet either of them or both; its range may change between runs."""
    found = []
    for kind, side in (("upper rail", 1.0), ("lower rail", -1.0)):
        bad = _at_rail(name, runs, side)
        for run in (r for r in runs if not bad.get(r.name, np.zeros(1)).any()):
            bad |= _at_rail(name, [run], side)
        touched = [run for run in runs if bad.get(run.name, np.zeros(1)).any()]
        if touched:
            top = max(float((side * run.record[name]).max()) for run in touched)
            found.append(SampleFault(kind, (name,), side * top, bad, tuple(run.name for run in touched)))
    at_either = sum(int(np.count_nonzero(bad)) for fault in found for bad in fault.bad.values())
    # a signal that knows two values and nothing between is no gauge at its rails: a friction force of one size
    return found if at_either < sum(len(run.record) for run in runs) else []


def _at_rail(name: str, runs: Sequence[Run], side: float) -> dict[str, Mask]:
    """Return the samples of each run (n,) at the largest value of all, where that is a rail; else nothing."""
    top = max(float((side * run.record[name]).max()) for run in runs)
    bad = {run.name: side * run.record[name] >= top for run in runs}
    count = sum(int(b.sum()) for b in bad.values())
    beside = sum(int((b[1:] & b[:-1]).sum()) for b in bad.values())
    # one burst of repeated samples at the peak is no rail
    met = count - beside
    enough = (met >= 2 or count >= _LONG_RAIL) and count >= _RAIL and beside >= _BESIDE * count
    return bad if enough and _cut(name, runs, bad, side) else {}


def _cut(name: str, runs: Sequence[Run], bad: dict[str, Mask], side: float) -> bool:
    """Tell a rail from a rest at the largest value: a rail is met and left at speed, far above noise and rounding."""
    steps, everywhere, rounding = [], [], []
    for run in runs:
        values, on = side * run.record[name], bad[run.name]
        edges = np.flatnonzero(on[1:] != on[:-1])
        steps.extend(np.abs(values[edges + 1] - values[edges]).tolist())
        everywhere.append(white_level(values))
        rounding.append(quantum(values))
    least = max(_FAST * float(np.median(everywhere)), _STEPS * max(rounding))
    return bool(steps) and float(np.median(steps)) > least


def _held(name: str, runs: Sequence[Run]) -> SampleFault | None:
    # what was computed from coarse channels repeats with them
    computed = name.startswith("slip_v") or any(f"{name}_raw" in run.record for run in runs)
    if computed or any(is_coarse(run.record[name]) for run in runs):
        return None
    bad: dict[str, Mask] = {}
    equal = expected = count = 0.0
    for run in runs:
        values = run.record[name]
        same = np.zeros(len(values), dtype=bool)
        same[1:] = values[1:] == values[:-1]
        same[len(values) - _tail(values) :] = False
        same[: 1 + _tail(values[::-1])] = False  # a simulation begins at rest, to the last digit
        equal, expected, count = (
            equal + same.sum(),
            expected + estimate_chance_of_equal(values).sum(),
            count + len(values),
        )
        bad[run.name] = same
    more = float(equal - expected)
    if more < max(_SURE * np.sqrt(expected + 1.0), _REPEATED * count, _MISJUDGED * expected):
        return None
    return SampleFault("held", (name,), more / float(count), bad, tuple(n for n, b in bad.items() if b.any()))


def _tail(values: Array) -> int:
    """How many samples before the last one equal it without a break."""
    different = np.flatnonzero(values != values[-1])
    return len(values) - 1 - int(different[-1]) - 1 if len(different) else 0


def _lost(name: str, runs: Sequence[Run], cut: Mapping[str, int]) -> SampleFault | None:
    tails = {run.name: _tail(run.record[name]) - cut[run.name] for run in runs}
    ends = {
        run.name: estimate_chance_of_equal(run.record[name])[-NEAR - tails[run.name] - cut[run.name] :] for run in runs
    }
    shown = [n for n, tail in tails.items() if tail >= _TAIL and float(np.mean(ends[n])) < _RARE]
    if sum(tails[n] for n in shown) < _TAILS or any(is_coarse(run.record[name]) for run in runs):
        return None
    bad = {run.name: np.ones(len(run.record), dtype=bool) for run in runs if run.name in shown}
    count = sum(len(run.record) for run in runs)
    return SampleFault("lost", (name,), sum(tails.values()) / count, bad, tuple(shown))


def _gaps(campaign: Campaign) -> list[SampleFault]:
    lost, bad, count = 0, {}, 0
    for run in campaign.runs:
        steps = np.diff(run.record.time)
        dt = float(np.median(steps))
        wide = (steps > _GAP * dt) & ~slower_rate(steps, dt)
        # a clock that is only rounded has no gap: its steps make up for each other
        if np.any(wide) and np.sum(steps[wide]) - dt * wide.sum() > 2.0 * dt:
            lost += int(np.sum(np.round(steps[wide] / dt) - 1))
            bad[run.name] = np.concatenate([[False], wide])
        count += len(run.record)
    names = tuple(campaign.runs[0].record.channels)
    return [SampleFault("gap", names, lost / (count + lost), bad, tuple(bad))] if lost else []


def _join(faults: list[SampleFault]) -> list[SampleFault]:
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
