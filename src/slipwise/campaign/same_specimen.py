"""All runs of a campaign must be of one specimen: weight and lever of inertia show it without a friction law."""

import warnings
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.campaign import Campaign, Run
from slipwise.campaign.zero_state import carries_nothing, shifted_zeros
from slipwise.errors import InputError, SlipwiseWarning
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes
from slipwise.signals.filters import LowPass, lowpass

#: Largest difference of weight between runs of one specimen, and from a stated mass: gauges drift, seating changes [1].
_WEIGHT = 0.10
#: The same of the lever: the two rigs of the paper weigh the same and differ by a factor of two; buffers above the
#: slide and a table that rocks have pulled runs of one rig apart by 1.43 [1].
_LEVER = 0.65
#: A table that rocks turns the girder faster than this: slower, its pitch is that of the girder's inertia alone [Hz].
_SLOW = LowPass(2.5, 4, "aligned")
#: The weight differs more than this from the rig's: another unit, another specimen [1].
_RATED = 0.30
#: Pitch says nothing of the lever while the girder accelerates less than this (standard deviation) [m/s^2].
_MOVING = 0.3
#: More of the pitch than this share is not the inertia's: a table that rocks at its resonance, and no lever [1].
_UNEXPLAINED = 0.2
#: Two levers of one run that differ by more than this are none: with and without a table that rocks as it is shaken,
#: of its first and its last motion, between which a gauge lost samples and came out of step with the others [1].
_SAME = 0.3
#: A cell that scatters less than this share of what the others do is dead [1].
_ALIVE = 0.02
#: A channel that stands at its largest or smallest value for more than this share of its samples is clipped [1].
_AT_RAIL = 0.005
#: Samples beyond this part of a channel's largest are left out: a clipped channel is a fault, not another rig [1].
_PEAKS = 0.97


def check_same_specimen(campaign: Campaign) -> tuple[str, ...]:
    """Refuse runs of different rigs, and give notes on runs that differ in channels or sampling.

    A mass that campaign.toml states and the load cells contradict is warned of: nobody but its writer can mend it.

    Raises:
        InputError: weight or lever of the weight differ between runs by more than one specimen can.
    """
    notes = _different_channels(campaign.runs)
    rig = campaign.specimen
    loads = tuple(f"pad_{pad}_N" for pad in rig.pads)
    records = [run.record for run in campaign.runs]
    weighing = [run for run in campaign.runs if _weighs(run.record, loads, records)]
    if not weighing or not rig.free:
        return tuple(notes)
    zeros = shifted_zeros(records, loads, rig.weight)
    notes += [f"{zero.words}; `slipwise audit` says how to put it right" for zero in zeros]
    if any(zero.tared for zero in zeros):
        return tuple(notes)
    _refuse_some_tared(weighing, loads, rig.weight)
    weights = [(run, float(np.median(_pressing(run.record, rig.pads).sum(axis=1)))) for run in weighing]
    _compare(weights, _WEIGHT, "the load cells carry", "kN", 1e3)
    levers = [(run, lever) for run in weighing if (lever := lever_of(run.record, rig)) is not None]
    _compare(levers, _LEVER, "inertia of the girder acts at a lever of", "of the pad spacing", 1.0)
    typical = float(np.median([weight for _, weight in weights]))
    rated = rig.weight
    if "mass" in campaign.known and abs(typical / rated - 1.0) > _WEIGHT:
        notes.append(
            f"the load cells carry {typical / 1e3:.3g} kN together, but with the mass that campaign.toml states the "
            f"girder weighs {rated / 1e3:.3g} kN: correct the mass in [specimen], or the unit of the cells"
        )
        warnings.warn(notes[-1], SlipwiseWarning, stacklevel=3)
    elif abs(typical / rated - 1.0) > _RATED:
        notes.append(
            f"the load cells carry {typical / 1e3:.3g} kN together, but the girder of {campaign.rig} weighs "
            f"{rated / 1e3:.3g} kN: check the units, the rig, or give its mass in [specimen]"
        )
    return tuple(notes)


def _weighs(record: Record, loads: Sequence[str], records: Sequence[Record]) -> bool:
    """Return whether all load cells are there and none is dead beside the others: a dead one is no other rig."""
    if not record.has_all(*loads) or any(carries_nothing(name, record, records, loads) for name in loads):
        return False
    scatter = np.stack([record[name] for name in loads], axis=1).std(axis=0)
    return bool(scatter.min() >= _ALIVE * np.median(scatter))


def _refuse_some_tared(runs: Sequence[Run], loads: Sequence[str], weight: float) -> None:
    """Refuse load cells that were set to zero under the girder before some of the runs only.

    Raises:
        InputError: some were; no single correction suits all runs.
    """
    tared = {run.name: [z for z in shifted_zeros([run.record], loads, weight) if z.tared] for run in runs}
    found = {name: zeros for name, zeros in tared.items() if zeros}
    if found:
        words = "; ".join(zero.words for zero in next(iter(found.values())))
        raise InputError(
            f"in {', '.join(found)} alone {words}; put these runs into a campaign of their own: there "
            "`slipwise audit --correct` puts the load back"
        )


def _different_channels(runs: Sequence[Run]) -> list[str]:
    notes = []
    every = set.union(*(set(run.record.channels) for run in runs))
    for run in runs:
        if missing := sorted(every - set(run.record.channels)):
            notes.append(f"{run.name} has no {', '.join(missing)}, which other runs have")
    steps = {run.name: run.record.dt for run in runs}
    if max(steps.values()) > 1.01 * min(steps.values()):
        rates = ", ".join(f"{name} {1.0 / dt:.4g} Hz" for name, dt in steps.items())
        notes.append(f"runs are sampled at different rates: {rates}")
    return notes


def _pressing(record: Record, pads: Sequence[str]) -> NDArray[np.float64]:
    """Return the loads (n, n_pads), those of cells that count compression negative turned round."""
    loads = record.stacked("pad_{}_N", pads)
    return loads * np.where(np.median(loads, axis=0) < 0.0, -1.0, 1.0)


def lever_of(record: Record, specimen: Specimen) -> float | None:
    """Height of the centre of gravity over pad spacing, from the pitch of the loads; None where it cannot be seen.

    Of a girder with storeys it cannot: they push at levers of their own.
    """
    if specimen.storeys or not record.has_all("girder_ax", "slip_x") or record["girder_ax"].std() < _MOVING:
        return None
    told = ("girder_ax", *(f"pad_{p}_N" for p in specimen.pads))
    if any(_clipped(record[name]) for name in told):
        return None  # the filter would carry what is cut off into the samples beside it
    modes = load_modes(_pressing(record, specimen.pads), basis_of(specimen))
    weight = float(np.median(modes.heave))
    signals = (record["girder_ax"] * weight / 9.80665, record["slip_x"] * weight, modes.pitch)
    pushed, slid, pitch = (lowpass(values, record.dt, _SLOW) for values in signals)
    # cells behind a slow filter of their own are late: a fault again, and no other rig
    late = [np.gradient(values, record.dt) for values in (pushed, slid)]
    # and a cell that drifts leans on whatever else is slow
    columns = np.stack([pushed, slid, *late, np.ones(len(record)), np.linspace(-1.0, 1.0, len(record))], axis=1)
    kept = np.all([_within(record[name]) for name in told], axis=0)
    slopes = np.linalg.lstsq(columns[kept], pitch[kept], rcond=None)[0]
    left = pitch[kept] - columns[kept] @ slopes
    if left.std() > _UNEXPLAINED * pitch[kept].std():
        return None
    if "table_ax" in record:
        shaken = np.column_stack([columns, lowpass(record["table_ax"], record.dt, _SLOW)])
        beside = np.linalg.lstsq(shaken[kept], pitch[kept], rcond=None)[0]
        if abs(beside[0] - slopes[0]) > _SAME * abs(slopes[0]):
            return None  # a table that rocks as it is shaken, or a girder that never slid beside it
    first = np.cumsum(pushed**2) < 0.5 * float(pushed @ pushed)
    halves = [np.linalg.lstsq(columns[k], pitch[k], rcond=None)[0][0] for k in (kept & first, kept & ~first)]
    if abs(halves[0] - halves[1]) > _SAME * abs(slopes[0]):
        return None  # out of step
    return float(-slopes[0] / 2.0)


def _clipped(values: NDArray[np.float64]) -> bool:
    """Return whether a channel (n,) stands at a rail; rounding alone seldom repeats an extreme so often."""
    often = max(np.count_nonzero(values == values.max()), np.count_nonzero(values == values.min()))
    return bool(often > _AT_RAIL * len(values))


def _within(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which samples (n,) are not among the largest, where a channel may have been clipped."""
    away = np.abs(values - np.median(values))
    return away < _PEAKS * away.max()


def _compare(values: Sequence[tuple[Run, float]], apart: float, words: str, unit: str, scale: float) -> None:
    if len(values) < 2:
        return
    middle = float(np.median([value for _, value in values]))
    for run, value in values:
        smaller, larger = sorted((abs(value), abs(middle)))
        if value * middle < 0.0 or larger > (1.0 + apart) * smaller:
            raise InputError(
                f"runs of different rigs in one campaign: in {run.name!r} {words} {value / scale:.3g} {unit}, in the "
                f"others {middle / scale:.3g}; put them into campaigns of their own, or correct the units of {run.file}"
            )
