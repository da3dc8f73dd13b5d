"""The rows on which relations are evaluated: smoothed to one band, thinned until nearly independent, run after run."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array, Mask
from slipwise.campaign import Campaign, Run
from slipwise.campaign.aligned import AlignedRun, aligned_run, spread
from slipwise.channels import pads_in
from slipwise.noise.gauges import Gauge
from slipwise.record import Record
from slipwise.regression.normal_equations import Block
from slipwise.relations.rigid_balances import Relation
from slipwise.rig import Specimen
from slipwise.rig.load_basis import RIGID_MODES
from slipwise.signals.filters import LowPass, lowpass

#: Band in which channels are compared [Hz]: below the loggers' filters, above what the rig does.
_BAND = 40.0
#: and as a part of the slowest filter of the logger and of the sampling rate [1].
_OF_FILTER, _OF_RATE = 0.6, 0.16
#: Ends that are left out: the band filter's memory, and that of the double integration [s].
_END, _INNER_END = 0.12, 0.7
#: A pad below this part of its median load lifts; the rows around that are left out for this long [1, s].
_LIFTED, _RINGING = 0.05, 0.2
#: Samples and rows that are kept, per period of the band's edge: derivatives need more than evidence.
_KEPT, _ROWS = 6.0, 3.0


@dataclass(frozen=True)
class PreparedRun:
    """One run, smoothed, with the rows that count.

    Attributes:
        name: of the run.
        record: channels smoothed to the common band, thinned to six samples for each period of its edge.
        picked: kind of rows -> sample numbers.
        stretch: number of the quiet stretch of each picked sample of kind "wander".
    """

    name: str
    record: Record
    picked: Mapping[str, NDArray[np.int64]]
    stretch: NDArray[np.int64]

    def rows(self, values: Array, kind: str) -> Array:
        """Return the rows of one kind out of a signal on the record's time."""
        chosen = values[self.picked[kind]]
        if kind != "wander" or len(chosen) == 0:
            return chosen
        sums = np.bincount(self.stretch, weights=chosen)
        return chosen - (sums / np.maximum(np.bincount(self.stretch), 1))[self.stretch]


def prepare_runs(campaign: Campaign, left_out: Mapping[str, Mask] | None = None) -> tuple[list[PreparedRun], float]:
    """Prepare every run; give them and the band's edge [Hz].

    Args:
        campaign: whose runs are prepared.
        left_out: run -> samples (n,) that are no measurement.
    """
    aligned = [aligned_run(run, campaign.logger) for run in campaign.runs]
    filters = [by.frequency for run in aligned for by in run.lowpass.values() if by is not None]
    rate = min(1.0 / run.record.dt for run in aligned)
    band = min(_BAND, _OF_RATE * rate, *(_OF_FILTER * f for f in filters))
    prepared = [
        _prepared(run, one, band, (left_out or {}).get(run.name, np.zeros(len(run.record), dtype=bool)))
        for run, one in zip(campaign.runs, aligned, strict=True)
    ]
    # what only some runs have cannot be compared in all of them
    common = [name for name in prepared[0].record.channels if all(name in run.record for run in prepared)]
    return with_records(prepared, lambda r: Record(r.time, {n: r[n] for n in common}, r.provenance)), band


def _prepared(run: Run, aligned: AlignedRun, band: float, left_out: Mask) -> PreparedRun:
    full = aligned.record
    by = LowPass(band, 6, "aligned")
    every = slice(None, None, max(1, int(1.0 / (_KEPT * band * full.dt))))
    channels = {n: lowpass(v, full.dt, by)[every] for n, v in full.channels.items()}
    record = Record(full.time[every], channels, full.provenance)
    good, quiet = aligned.measured[every] & ~_on(full.time, run.record.time, left_out)[every], aligned.quiet[every]
    pads = pads_in(record.channels)
    loads = [n for n in (f"pad_{pad}_N" for pad in pads) if n in record]
    if len(loads) == len(pads) >= RIGID_MODES:
        lifted = np.any([record[n] < _LIFTED * np.median(record[n]) for n in loads], axis=0)
        good &= ~spread(lifted, int(0.02 / record.dt), int(_RINGING / record.dt))
    thin = np.zeros(len(record), dtype=bool)
    thin[:: max(1, int(1.0 / (_ROWS * band * record.dt)))] = True
    numbers = np.arange(len(record))
    from_end = np.minimum(numbers, len(record) - 1 - numbers) * record.dt
    # a bridge in an acceleration is felt as long as an end is, once it is integrated twice
    moved = np.any([np.zeros(len(run.record), dtype=bool), *(w.bad for w in run.wild if _moves(w.channel))], axis=0)
    reach = int(_INNER_END / full.dt)
    known = ~spread(_on(full.time, run.record.time, moved), reach, reach)[every]
    masks = {"moving": good & (from_end >= _END), "inner": good & known & (from_end >= _INNER_END)}
    masks["quiet"] = masks["wander"] = masks["moving"] & quiet
    picked = {kind: np.flatnonzero(mask & thin) for kind, mask in masks.items()}
    starts = np.cumsum(np.diff(np.concatenate([[0], quiet.astype(int)])) == 1)
    stretch = np.unique(starts[picked["wander"]], return_inverse=True)[1]
    return PreparedRun(run.name, record, picked, np.asarray(stretch))


def _moves(channel: str) -> bool:
    return channel.startswith(("slip_", "girder_a", "table_a", "storey_"))


def _on(time: Array, recorded: Array, mask: Mask) -> Mask:
    """Return the samples (m,) of a uniform axis beside which one of the recorded samples (n,) is marked."""
    return np.interp(time, recorded, mask.astype(float)) > 0.0 if mask.any() else np.zeros(len(time), dtype=bool)


def with_records(runs: Sequence[PreparedRun], change: Callable[[Record], Record]) -> list[PreparedRun]:
    """Return the runs with changed records, the same rows."""
    return [replace(run, record=change(run.record)) for run in runs]


@dataclass(frozen=True)
class Stack:
    """All relations over all runs.

    Attributes:
        residual: relation -> (n,) with the constants as they are.
        base: constant -> its columns, (n, 1) in each relation that holds it.
        run_of: relation -> (n,) number of the run of each row.
    """

    residual: dict[str, Array]
    base: dict[str, Block]
    run_of: dict[str, NDArray[np.int64]]


def list_constants(relations: Sequence[Relation]) -> tuple[str, ...]:
    """Return the names of all constants."""
    return tuple(dict.fromkeys(name for relation in relations for name in relation.terms))


def stack_rows(
    runs: Sequence[PreparedRun], relations: Sequence[Relation], specimen: Specimen, constants: Mapping[str, float]
) -> Stack:
    """Evaluate the relations with the constants as they are; relations without rows are left out."""
    residual: dict[str, Array] = {}
    base: dict[str, dict[str, Array]] = {name: {} for name in list_constants(relations)}
    run_of: dict[str, NDArray[np.int64]] = {}
    for relation in relations:
        parts = [_evaluate(run, relation, specimen, constants) for run in runs]
        rows = np.concatenate([residual for residual, _ in parts])
        if len(rows) == 0:
            continue
        residual[relation.name] = rows
        run_of[relation.name] = np.repeat(np.arange(len(runs)), [len(r) for r, _ in parts])
        for name in relation.terms:
            base[name][relation.name] = np.concatenate([columns[name] for _, columns in parts])[:, None]
    return Stack(residual, {**base}, run_of)


def _evaluate(
    run: PreparedRun, relation: Relation, specimen: Specimen, constants: Mapping[str, float]
) -> tuple[Array, dict[str, Array]]:
    residual = relation.known(run.record, specimen)
    columns = {}
    for name, term in relation.terms.items():
        column = term(run.record, specimen)
        residual = residual + constants[name] * column
        columns[name] = run.rows(column, relation.rows)
    return run.rows(residual, relation.rows), columns


def list_changed_rows(
    changed: Sequence[PreparedRun],
    relations: Sequence[Relation],
    specimen: Specimen,
    constants: Mapping[str, float],
    before: Stack,
    touched: frozenset[str],
) -> dict[str, Array]:
    """Return what a change of some channels changes in the residuals, relation -> (n,).

    Args:
        changed: runs with some channels changed.
        relations: as stacked.
        specimen: of the campaign.
        constants: as they are.
        before: the stack of the runs before the change.
        touched: channels that were changed; other relations are not evaluated again.
    """
    found = {}
    for relation in relations:
        if relation.name in before.residual and not touched.isdisjoint(relation.looks_at(changed[0].record)):
            after = np.concatenate([_evaluate(run, relation, specimen, constants)[0] for run in changed])
            found[relation.name] = after - before.residual[relation.name]
    return found


def draw_run_noise(
    runs: Sequence[PreparedRun], gauges: Mapping[str, Gauge], dt: float, band: float
) -> list[dict[str, Array]]:
    """Return a sample of each run's noise, channel by channel: what its gauges have below the edge of the band.

    Args:
        runs: smoothed.
        gauges: channel -> noise of one recorded sample.
        dt: step of the recorded samples [s].
        band: edge of the band [Hz].
    """
    rng = np.random.default_rng(0)
    by = LowPass(band, 6, "aligned")
    made = []
    for run in runs:
        channels = {}
        for name in run.record.channels:
            white = lowpass(rng.standard_normal(len(run.record)), run.record.dt, by)
            channels[name] = gauges[name].level_below(band, dt) / max(float(white.std()), 1e-12) * white
        made.append(channels)
    return made


def adding(
    runs: Sequence[PreparedRun], noise: Sequence[Mapping[str, Array]], names: Iterable[str]
) -> list[PreparedRun]:
    """Return the runs with noise added to some channels."""
    chosen = set(names)
    return [
        replace(run, record=run.record.replaced(**{n: run.record[n] + z for n, z in more.items() if n in chosen}))
        for run, more in zip(runs, noise, strict=True)
    ]
