"""Columns of a structure without force gauges: which acceleration is the table's, in which order the levels stand.

What drives is told by what it makes (`slipwise.campaign.level_order`), and a displacement by the accelerations whose
double integral it is (`slipwise.campaign.double_integrals`). Numbers in the names decide only between orders that the
data cannot tell apart.

    table_ax        the cause of all others
    girder_ax       the base, the lowest level above the isolators
    storey_1_ax     the level above it, and so on
    table_dx        double integral of the table's acceleration
    slip_x          of the base's minus the table's
    storey_1_dx     of the level's minus the table's; other references are computed away in [derived]
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.double_integrals import AGREE, Source, find_sources, judge_fineness
from slipwise.campaign.draft.column import Column, Mapped
from slipwise.campaign.draft.data_files import DataFile
from slipwise.campaign.draft.time_column import time_column
from slipwise.campaign.level_order import MOST_LEVELS, LevelOrder, find_order, judge_order
from slipwise.campaign.level_spectra import level_spectra

#: Orders that leave less more than the best one are as good: the numbers of the columns decide between them [1].
_AS_GOOD = 0.15
#: From this margin on an order is sure [1].
_SURE = 0.3
#: A level that moves by less than this part of what the others do shows nothing [1].
_IDLE = 0.08
#: Sources are as good as the best where they miss it by so many times what it lacks itself, and this [1].
_LIKE, _BESIDE = 0.3, 1e-4
#: Units that a displacement without one is tried in [m].
_UNITS = (("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("in", 0.0254))


@dataclass(frozen=True)
class MappedLevels:
    """How the files of a folder hold the levels of a structure.

    Attributes:
        common: header -> channel, in most files.
        own: name of a file -> the same, of a file whose levels stand in another order.
        left: header -> why a column of an acceleration or a displacement is no channel.
        order: of the levels in the files of `common`, from that which moves most; None where no file shows one.
    """

    common: Mapping[str, Mapped]
    own: Mapping[str, Mapping[str, Mapped]]
    left: Mapping[str, str]
    order: LevelOrder | None


_NONE = MappedLevels({}, {}, {}, None)


def map_levels(files: Sequence[DataFile]) -> MappedLevels:
    """Return which columns of some files are the levels of one structure, where no file has a force.

    Args:
        files: of a folder, the one that moves most first.
    """
    if any(_has_forces(file) for file in files):
        return _NONE
    found = {file.path.name: levels for file in files if (levels := _levels_of(file)) is not None}
    if not found:
        return _NONE
    orders = [_channels(levels.mapped) for levels in found.values()]
    usual = max(orders, key=orders.count)
    reference = next(levels for levels in found.values() if _channels(levels.mapped) == usual)
    own = {
        name: levels.mapped
        for name, levels in found.items()
        if _channels(levels.mapped) != usual and levels.order.margin > _SURE
    }
    left = {header: why for header, why in reference.left.items() if header not in reference.mapped}
    return MappedLevels(reference.mapped, own, left, reference.order)


@dataclass(frozen=True)
class _Levels:
    """What one file shows: header -> channel, header -> why none, and the order of its levels."""

    mapped: Mapping[str, Mapped]
    left: Mapping[str, str]
    order: LevelOrder


def _channels(mapped: Mapping[str, Mapped]) -> dict[str, tuple[str, int]]:
    return {header: (one.channel, one.sign) for header, one in mapped.items()}


def _has_forces(file: DataFile) -> bool:
    return any(c.kind in ("force", "pressure") for c in file.columns) or any(n.startswith("pad_") for n in file.known)


def _levels_of(file: DataFile) -> _Levels | None:
    dt = _step(file)
    if dt is None:
        return None
    mapped: dict[str, Mapped] = {}
    left: dict[str, str] = {}
    first: LevelOrder | None = None
    for axis in "xy":
        accelerations = [c for c in file.columns if c.kind == "acceleration" and _along(c) == axis]
        known = [n for n in file.known if n.endswith(f"_a{axis}")]
        named = len(accelerations) == 2 and all(c.meanings & {"table", "girder"} for c in accelerations)
        if len(accelerations) < 2 or known or named or any(c.channel for c in accelerations):
            continue
        moving = _moving(accelerations)
        order = _order(moving, dt) if 2 <= len(moving) <= MOST_LEVELS else None
        if order is None or not order.holds or (len(moving) == 2 and order.margin < _SURE):
            continue
        first = first or order
        mapped |= _accelerations(moving, order, axis)
        left |= {c.header: "it hardly moves beside the others: is it dead?" for c in accelerations if c not in moving}
        lengths = [c for c in file.columns if c.kind == "length" and _along(c) == axis and not c.no_channel]
        for column, found, why in _displacements(lengths, moving, order, axis, dt, file.known):
            if found is None:
                left[column.header] = why
            else:
                mapped[column.header] = found
    return None if first is None else _Levels(mapped, left, first)


def _step(file: DataFile) -> float | None:
    """Return the step of a file's samples [s]; None where no column tells it."""
    time = file.known.get("time")
    if time is None and (found := time_column(file.columns, file.step)) is not None:
        time = next(c.values for c in file.columns if c.header == found[0])
    if time is None or len(time) < 2:
        return file.step
    return float(np.median(np.diff(time)))


def _along(column: Column) -> str:
    """Return the axis of a column by its name; what it does not say is along the shaking."""
    return "z" if "up" in column.meanings else "y" if "across" in column.meanings else "x"


def _moving(columns: Sequence[Column]) -> list[Column]:
    size = {c.header: float(np.std(c.values)) for c in columns}
    usual = float(np.median(list(size.values())))
    return [c for c in columns if size[c.header] > _IDLE * usual]


def _order(columns: Sequence[Column], dt: float) -> LevelOrder | None:
    """Return the order of levels; of orders as good that in which the columns are numbered."""
    spectra = level_spectra(np.stack([c.values for c in columns]), dt)
    if spectra is None:
        return None
    best = find_order(spectra)
    table, *levels = best.levels
    numbers = [columns[i].number for i in levels]
    if None in numbers or len(set(numbers)) < len(numbers):
        return best
    counted = sorted(levels, key=lambda i: columns[i].number or 0)
    for numbered in (counted, counted[::-1]):
        links = judge_order(spectra.signed(best.signs), (table, *numbered))
        if tuple(numbered) != tuple(levels) and sum(link.left for link in links) < best.left + _AS_GOOD:
            return LevelOrder((table, *numbered), best.signs, links, 0.0)
    return best


def _accelerations(columns: Sequence[Column], order: LevelOrder, axis: str) -> Iterator[tuple[str, Mapped]]:
    sure = "sure" if order.margin > _SURE else "likely"
    above = len(order.levels) - 1
    for place, i in enumerate(order.levels):
        if place == 0:
            why = "the cause: the others answer it" if above > 1 else "the other answers it"
        else:
            link = order.links[place - 1]
            below = "the table" if place == 1 else repr(columns[order.levels[place - 1]].header)
            why = f"level {place} of {above} from below: it answers {below}, {link.left:.0%} of its force is left"
        if order.signs[i] < 0:
            why += "; turned round, only so it moves with the others"
        yield columns[i].header, Mapped(f"{_place(place)}_a{axis}", columns[i].unit, order.signs[i], why, sure)


def _place(place: int) -> str:
    """Return what a level is called, counted from the table."""
    return ("table", "girder")[place] if place < 2 else f"storey_{place - 1}"


def _displacements(
    lengths: Sequence[Column],
    levels: Sequence[Column],
    order: LevelOrder,
    axis: str,
    dt: float,
    known: Mapping[str, Array],
) -> Iterator[tuple[Column, Mapped | None, str]]:
    """Yield each displacement with its channel, or with None and why it is none."""
    signals = np.stack([order.signs[i] * c.values for i, c in enumerate(levels)])
    found = {c.header: _sources(c, levels, order, signals, dt) for c in lengths}
    taken: dict[str, str] = {name: name for name in known}
    names = [f"{_place(place)}_d{axis}" for place in range(len(order.levels))]
    places = {i: place for place, i in enumerate(order.levels)}
    table = names[0] in known or any(s and s.plus == order.levels[0] and s.minus is None for s in found.values())
    agreement = {header: source.agreement if source else 0.0 for header, source in found.items()}
    for column in sorted(lengths, key=lambda c: -agreement[c.header]):
        source = found[column.header]
        if source is None:
            yield column, None, "it is the double integral of no acceleration here, and of no difference of two"
            continue
        channel, derived = _channel_of(source, places, axis, names)
        plain = channel.removesuffix("_raw")
        if plain in taken:
            yield column, None, f"of all accelerations it follows that of {plain}, which is taken from {taken[plain]!r}"
            continue
        if derived.endswith(names[0]) and not table:
            yield column, None, "a displacement in space, and no column holds the table's: nothing gives the slip"
            continue
        taken[plain] = column.header
        unit, sign = _unit_and_sign(column, source)
        yield column, Mapped(channel, unit, sign, _why(column, source, levels, signals, unit, dt), "sure", derived), ""


def _sources(column: Column, levels: Sequence[Column], order: LevelOrder, signals: Array, dt: float) -> Source | None:
    """Return what a displacement belongs to: of sources as good one of the table, and of its own number."""
    every = [source.seen_from(order.levels[0]) for source in find_sources(column.values, signals, dt)]
    if not every or every[0].agreement < AGREE:
        return None
    least = every[0].agreement - _LIKE * (1.0 - every[0].agreement) - _BESIDE
    as_good = [source for source in every if source.agreement >= least]

    def likely(source: Source) -> tuple[bool, bool, float]:
        numbered = column.number is not None and levels[source.plus].number == column.number
        return (source.minus == order.levels[0] or source.plus == order.levels[0], numbered, source.agreement)

    return max(as_good, key=likely)


def _channel_of(source: Source, places: Mapping[int, int], axis: str, names: Sequence[str]) -> tuple[str, str]:
    """Return the channel of a displacement, and how it is computed from the column where that has another reference."""
    names = [names[0], f"slip_{axis}", *names[2:]]
    place = places[source.plus]
    if place == 0:
        return names[0], ""
    if source.minus is None:
        return f"{names[place]}_raw", f"{names[place]}_raw - {names[0]}"
    below = places[source.minus]
    if below == 0:
        return names[place], ""
    upper, lower, sign = (place, below, "+") if place > below else (below, place, "-")
    return f"{names[upper]}_raw", f"{names[lower]} {sign} {names[upper]}_raw"


def _unit_and_sign(column: Column, source: Source) -> tuple[str, int]:
    """Return the unit of a displacement, by its size where none is written, and its sign."""
    sign = 1 if source.scale > 0.0 else -1
    if column.unit != "?":
        return column.unit, sign
    unit, factor = min(_UNITS, key=lambda one: abs(np.log(abs(source.scale) * one[1])))
    return (unit if abs(abs(source.scale) * factor - 1.0) < 0.2 else "?"), sign


def _why(column: Column, source: Source, levels: Sequence[Column], signals: Array, unit: str, dt: float) -> str:
    plus = levels[source.plus].header
    of = repr(plus) if source.minus is None else f"{plus!r} minus {levels[source.minus].header!r}"
    why = f"the double integral of {of}, correlation {source.agreement:.3f}"
    if column.unit == "?" and unit != "?":
        why += ", and its size as such is in this unit"
    acceleration = signals[source.plus] - (0.0 if source.minus is None else signals[source.minus])
    fineness = judge_fineness(column.values / source.scale, acceleration, dt)
    if fineness is not None and fineness.computed:
        why += "; too well for a gauge: it was computed from them"
    return why
