"""Displacements held against the accelerations of all levels: another reference than said, or no gauge of their own."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Run
from slipwise.campaign.double_integrals import AGREE, Source, find_sources, judge_fineness
from slipwise.record import Record
from slipwise.rig import Specimen, storey_names

#: A displacement has another reference than said where that leaves so many times less of it unexplained [1], and where
#: what was said leaves at least this [1].
_TIMES, _LEAST = 3.0, 0.001


@dataclass(frozen=True)
class DisplacementChecks:
    """What displacements show beside their accelerations.

    Attributes:
        contradictions: displacements from another point than said, in sentences.
        elsewhere: their channels.
        computed: channels that were computed from accelerations, and are no gauge.
        notes: what should be known of them.
    """

    contradictions: tuple[str, ...]
    elsewhere: tuple[str, ...]
    computed: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass
class _Seen:
    """What the runs show of one displacement: reference found -> runs, and how fine it follows where it is as said."""

    references: dict[str, list[str]] = field(default_factory=dict[str, list[str]])
    fine: list[tuple[bool, float, float]] = field(default_factory=list[tuple[bool, float, float]])


def check_displacements(runs: Sequence[Run], specimen: Specimen) -> DisplacementChecks:
    """Hold the slip, the table's and the floors' displacements against the accelerations of all levels.

    Args:
        runs: put right, whose levels stand in the order in which they are mapped.
        specimen: whose storeys have channels.
    """
    seen: dict[str, _Seen] = {}
    for run in runs:
        for axis in "xy":
            for name, found in _of_run(run.record, specimen, axis):
                one = seen.setdefault(name, _Seen())
                one.references.setdefault(found.reference, []).append(run.name)
                one.fine += [found.fine] if found.fine else []
    contradictions = [
        _elsewhere(name, reference, names, len(runs))
        for name, one in seen.items()
        for reference, names in one.references.items()
        if reference
    ]
    computed = tuple(n for n, one in seen.items() if one.fine and all(fine for fine, _, _ in one.fine))
    elsewhere = tuple(name for name, one in seen.items() if any(one.references))
    notes = tuple(_computed_words(computed, seen))
    return DisplacementChecks(tuple(contradictions), elsewhere, computed, notes)


@dataclass(frozen=True)
class _Found:
    """One displacement in one run: the reference that it has instead of what is said, or ""."""

    reference: str
    fine: tuple[bool, float, float] | None


def _of_run(record: Record, specimen: Specimen, axis: str) -> Iterator[tuple[str, _Found]]:
    places = ["table", "girder", *storey_names(specimen.storeys)]
    levels = [p for p in places if f"{p}_a{axis}" in record and np.ptp(record[f"{p}_a{axis}"]) > 0.0]
    if not levels:
        return
    signals = np.stack([record[f"{place}_a{axis}"] for place in levels])
    for place in places:
        name = f"slip_{axis}" if place == "girder" else f"{place}_d{axis}"
        said = (place,) if place == "table" else (place, "table")
        if name not in record or name in record.provenance.get("computed", ()) or not set(said) <= set(levels):
            continue
        every = find_sources(record[name], signals, record.dt)
        if not every:
            continue
        best = every[0]
        mapped = next(s for s in every if _points(s, levels) == frozenset(said))
        other = best.agreement >= AGREE and 1.0 - mapped.agreement > _LEAST + _TIMES * (1.0 - best.agreement)
        if other:
            yield name, _Found(_reference(best, levels, place), None)
        elif mapped.agreement >= AGREE:
            yield name, _Found("", _fine(record[name], mapped, signals, record.dt))


def _points(source: Source, levels: Sequence[str]) -> frozenset[str]:
    return frozenset(levels[i] for i in (source.plus, source.minus) if i is not None)


def _reference(source: Source, levels: Sequence[str], place: str) -> str:
    """Say what a displacement is instead of what its channel says."""
    points = _points(source, levels)
    if place in points:
        (other,) = points - {place} or {"space"}
        return other
    if source.minus is None:
        return f"another level: {levels[source.plus]} in space"
    source = source.seen_from(levels.index("table"))
    return f"another level: {levels[source.plus]} minus {levels[source.minus or 0]}"


def _fine(values: Array, source: Source, signals: Array, dt: float) -> tuple[bool, float, float] | None:
    acceleration = signals[source.plus] - (0.0 if source.minus is None else signals[source.minus])
    fineness = judge_fineness(values, acceleration, dt)
    return None if fineness is None else (fineness.computed, fineness.size, fineness.above)


def _elsewhere(name: str, reference: str, runs: Sequence[str], count: int) -> str:
    place, axis = name.rsplit("_", 1)[0].replace("slip", "girder"), name[-1]
    where = "" if len(runs) == count else f" in {', '.join(runs)}"
    if reference.startswith("another level: "):
        return (
            f"{name} is not the displacement of its level{where}, by the accelerations it is that of "
            f"{reference.removeprefix('another level: ')}; map the column to that level's channel"
        )
    if place == "table":
        return (
            f"{name}{where} is no displacement in space: by the accelerations it is between the table and {reference}; "
            "map one of the table itself"
        )
    table = f"table_d{axis}"
    if reference == "space":
        return (
            f"{name}{where} is a displacement in space and not one from the table, by its acceleration: map the column "
            f'to {name}_raw, and write {name} = "{name}_raw - {table}" in [derived]'
        )
    other = f"slip_{axis}" if reference == "girder" else f"{reference}_d{axis}"
    return (
        f"{name}{where} is the displacement from {reference} and not that from the table, by their accelerations: map "
        f'the column to {name}_raw, and write {name} = "{name}_raw + {other}" in [derived]'
    )


def _computed_words(computed: Sequence[str], seen: Mapping[str, _Seen]) -> Iterator[str]:
    if computed:
        size, above = max((size, above) for name in computed for _, size, above in seen[name].fine)
        verb = "is" if len(computed) == 1 else "are"
        yield (
            f"{', '.join(computed)} {verb} the double integral of accelerations, too well for a gauge: still alike "
            f"above {above:.3g} Hz, where the motion is {1e6 * size:.2g} um; computed from them, and no independent "
            "measurement"
        )
