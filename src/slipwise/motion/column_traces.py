"""Components of a motion from columns, whatever file holds them: text, function file, workbook or MATLAB file."""

import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.statements import Peak, Statements
from slipwise.errors import InputError, SlipwiseWarning, UnitError
from slipwise.motion.column_kind import Kind, kind_of
from slipwise.motion.header_peaks import header_peak, peak_of, unit_of_peaks
from slipwise.motion.orientation import component_of, name_from_stem, orientation, sensor_of
from slipwise.motion.origin import origin_of
from slipwise.motion.source_file import LARGEST, SourceFile, check_count
from slipwise.motion.stated import Given, agreed_step, agreed_unit, settle_step, settle_unit
from slipwise.motion.time_column import counts_rows, even_step, rises_evenly
from slipwise.motion.trace import Trace
from slipwise.units import parse_unit

#: What a headless column of times may be in.
_SECONDS_PER = {"s": 1.0, "ms": 1e-3}
#: Columns of times with other steps are clocks, in nanoseconds since 1970 for one [s].
_STEP_RANGE = (1e-6, 10.0)


@dataclass(frozen=True, eq=False)
class ColumnTable:
    """Columns as a file holds them.

    Attributes:
        names: of the columns; empty if nothing names them.
        units: as written, "" of a column that has none.
        values: (n, columns).
        stated: what the lines above state.
        at: gives the place of a row, for messages.
        rounding: what the last digit of a column's numbers is worth; 0 where they are no text.
        title: of the record, "" if nothing tells it.
        read_as: what kind of file it is.
        words: what else was done or told.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Array
    stated: Statements
    at: Callable[[int], str]
    rounding: Callable[[int], float] = lambda _: 0.0
    title: str = ""
    read_as: str = "text columns"
    words: tuple[str, ...] = field(default=())


def column_traces(table: ColumnTable, source: SourceFile, given: Given) -> list[Trace]:
    """Make a component of every column of acceleration or, where there is none, of displacement.

    Raises:
        InputError: no step, times that do not rise evenly, columns that nothing names, statements that contradict
            each other, or another number of rows than stated.
        UnitError: no unit, or one that is none of acceleration.
    """
    table = _with_names(_without_row_numbers(table, given), source)
    _refuse_gaps(table)
    kinds: list[Kind] = [_kind(table, k, source) for k in range(len(table.names))]
    table, step = _timed(table, kinds, source, given)
    chosen = [k for k, kind in enumerate(kinds) if kind == "acceleration"]
    moved = [] if chosen else [k for k, kind in enumerate(kinds) if kind == "displacement"]
    left = [
        f"{table.names[k]} ({kind})" for k, kind in enumerate(kinds) if kind != "time" and k not in (*chosen, *moved)
    ]
    if left:
        table = replace(table, words=(*table.words, f"left out: {', '.join(left)}"))
    if table.stated.count is not None:
        check_count(len(table.values), table.stated.count, source, "the header", given.allow_short)
    dt, dt_words = settle_step(step, given, source, table.stated.lines.get("step", ""))
    if moved:
        return [_of_displacement(table, k, dt, dt_words, source, given) for k in moved]
    if not chosen:
        raise UnitError(
            f"{source.name}: no column holds an acceleration, there are {', '.join(left) or table.names[0]}; "
            "a column like 'EW [m/s^2]' is needed"
        )
    names = [table.names[k] for k in chosen]
    peaks = [peak_of(table.stated.peaks, name, place, len(names)) for place, name in enumerate(names)]
    by_peaks = None
    if not any(table.units[k] for k in chosen) and table.stated.unit is None and given.factor(source) is None:
        by_peaks = unit_of_peaks([table.values[:, k] for k in chosen], peaks, source)
    return [
        _trace(table, k, peak, by_peaks, len(chosen) > 1, dt, dt_words, source, given)
        for k, peak in zip(chosen, peaks, strict=True)
    ]


def _refuse_gaps(table: ColumnTable) -> None:
    """Refuse values that are missing, not finite or beyond all reason.

    Raises:
        InputError: there are some; the message names the first row.
    """
    wrong = np.argwhere(~(np.abs(table.values) < LARGEST))
    if len(wrong):
        row, k = (int(place) for place in wrong[0])
        value = table.values[row, k]
        words = "is too large to be a measurement" if np.isfinite(value) else "is missing"
        raise InputError(f"{table.at(row)}: the value {value:g} {words}; fill or cut the gap, a table cannot follow it")


def _without_row_numbers(table: ColumnTable, given: Given) -> ColumnTable:
    """Leave out a first column that numbers the rows; of two columns without names only if a step is known."""
    width = table.values.shape[1]
    if width < 2 or not counts_rows(table.values[:, 0]):
        return table
    step = table.stated.step if table.stated.step is not None else given.dt
    if table.names:
        numbers = kind_of(table.names[0], table.units[0], "") == "row number"
    else:
        numbers = (width == 3 and rises_evenly(table.values[:, 1])) or (width == 2 and step not in (None, 1.0, 1e-3))
    if not numbers:
        return table
    return replace(
        table,
        names=table.names[1:],
        units=table.units[1:],
        values=table.values[:, 1:],
        rounding=lambda k: table.rounding(k + 1),
        words=(*table.words, "left out: the numbers of the rows"),
    )


def _with_names(table: ColumnTable, source: SourceFile) -> ColumnTable:
    """Name the columns of a table without names: a series, or time and a series.

    Raises:
        InputError: more than two columns.
    """
    width = table.values.shape[1]
    if table.names:
        # "gFx" of a phone is a share of gravity.
        units = zip(table.names, table.units, strict=True)
        return replace(
            table,
            units=tuple("g" if not unit and re.fullmatch(r"gF[xyz]|TgF", name) else unit for name, unit in units),
        )
    if width > 2:
        text = table.read_as == "text columns"
        where = "write a header as the last line above the numbers" if text else "save the columns under names"
        raise InputError(
            f"{source.name}: {width} columns without a header that names them, and they do not look like one series "
            f"with several values a line or pairs of time and value; {where}, for example "
            "'time [s],EW [cm/s^2],NS [cm/s^2],UD [cm/s^2]'"
        )
    return replace(table, names=("", "")[:width], units=("", "")[:width])


def _kind(table: ColumnTable, k: int, source: SourceFile) -> Kind:
    name, unit = table.names[k], table.units[k]
    if not name and not unit:
        return "time" if len(table.names) == 2 and k == 0 else "acceleration"
    kind = kind_of(name, unit, f"column {name!r} of {source.name}")
    return "acceleration" if kind == "row number" and not counts_rows(table.values[:, k]) else kind


def _timed(table: ColumnTable, kinds: list[Kind], source: SourceFile, given: Given) -> tuple[ColumnTable, float | None]:
    """Return the step [s] that the table states; where its clock wavers the values are put on even times.

    Raises:
        InputError: several columns of times, or times that are not even or contradict what is stated.
    """
    places = [k for k, kind in enumerate(kinds) if kind == "time"]
    seconds = {k: parse_unit(table.units[k] or "s", "s", f"column {table.names[k]!r} of {source.name}") for k in places}
    if len(places) > 1:
        steps = {k: seconds[k] * float(np.median(np.diff(table.values[:, k]))) for k in places}
        places = [k for k in places if _STEP_RANGE[0] <= steps[k] <= _STEP_RANGE[1]]
        if len(places) != 1:
            called = ", ".join(repr(table.names[k]) for k in steps)
            raise InputError(f"{source.name}: several columns hold times, {called}; leave one of them")
    if not places:
        return table, table.stated.step
    k = places[0]
    name, time = table.names[k], table.values[:, k]
    step, wavers = even_step(time, table.rounding(k), table.at)
    if wavers:
        even = np.linspace(time[0], time[-1], len(time))
        others = [np.interp(even, time, column) for column in table.values.T]
        words = f"the clock of {source.name} wavers: values are put on even times of {step * seconds[k]:.6g} s"
        warnings.warn(words, SlipwiseWarning, stacklevel=5)
        table = replace(table, values=np.stack(others, axis=1), words=(*table.words, words))
    if name or table.units[k]:
        step *= seconds[k]
        if not table.units[k]:
            table = replace(table, words=(*table.words, f"column {name!r} has no unit: taken in seconds"))
    else:
        # A headless column of times has no unit: the step must be given all the same.
        known = given.dt if given.dt is not None else table.stated.step
        if known is None:
            raise InputError(
                f"{source.name}: the file does not state its time step; give it, for example --motion-dt '{step:g} s': "
                f"the first column advances by {step:g} a row, and nothing says in what unit"
            )
        settle_step(table.stated.step, given, source, table.stated.lines.get("step", ""))
        step = _headless_step(step, known, source)
    return table, agreed_step(table.stated.step, step, "its time column", source)


def _headless_step(step: float, stated: float, source: SourceFile) -> float:
    """Hold a headless time column against the step that was given or stated."""
    for seconds in _SECONDS_PER.values():
        if abs(step * seconds - stated) <= 1e-4 * stated:
            return step * seconds
    raise InputError(
        f"{source.name}: the first column advances by {step:g} a row, {stated:g} s was given as the step; neither in "
        f"{' nor in '.join(_SECONDS_PER)} do they agree"
    )


def _of_displacement(table: ColumnTable, k: int, dt: float, dt_words: str, source: SourceFile, given: Given) -> Trace:
    """Make a component of a table's displacement."""
    name, unit = table.names[k], table.units[k]
    if not unit:
        raise UnitError(f"{source.name}: the displacement {name!r} has no unit; write it in brackets: '{name} [mm]'")
    if given.unit is not None:
        raise UnitError(f"{source.name}: {name!r} is a displacement in {unit}; leave --unit {given.unit} out")
    metres = table.values[:, k] * parse_unit(unit, "m", f"column {name!r} of {source.name}")
    acceleration, words = _acceleration_of(metres, dt, source, name)
    si = replace(
        table,
        names=(name.replace("table_d", "table_a"),),
        units=("m/s^2",),
        values=acceleration[:, None],
        stated=replace(table.stated, unit=None),
        words=(*table.words, words),
    )
    return _trace(si, 0, None, None, True, dt, dt_words, source, given)


def _trace(
    table: ColumnTable,
    k: int,
    peak: Peak | None,
    by_peaks: tuple[str, str] | None,
    several: bool,
    dt: float,
    dt_words: str,
    source: SourceFile,
    given: Given,
) -> Trace:
    """Make one component of a column or a series."""
    stated = table.stated
    if by_peaks is not None:
        factor, unit_words = settle_unit(by_peaks[0], given, source)[0], by_peaks[1]
    else:
        unit = agreed_unit(table.units[k] or None, stated.unit, source)
        factor, unit_words = settle_unit(unit, given, source, "" if table.units[k] else stated.lines.get("unit", ""))
    letter = False
    name = table.names[k]
    if not several and (not name or orientation(name) == "unknown"):
        from_file = name_from_stem(source.stem)
        name = component_of(stated) or from_file or source.stem
        letter = name == from_file and len(name) == 1
    origin = origin_of(stated)
    return Trace(
        source=source,
        name=name,
        title=" ".join(part for part in (origin.station, origin.event) if part) or table.title or source.stem,
        dt=dt,
        acceleration=table.values[:, k] * factor,
        baseline="none",
        treatment=(
            f"read as {table.read_as}: {source.name}, component {name}",
            f"{unit_words}; {dt_words}",
            *table.words,
        ),
        header_peak=None if peak is None else header_peak(peak, factor, source),
        origin=replace(origin, sensor=origin.sensor or sensor_of(name)),
        letter_of_file=letter,
    )


def _acceleration_of(displacement: Array, dt: float, source: SourceFile, name: str) -> tuple[Array, str]:
    """Differentiate a displacement twice, and say so: it is the table's command as some controllers write it.

    Args:
        displacement: (n,) [m].
        dt: step [s].
        source: the file, for messages.
        name: of the column.

    Returns:
        The acceleration (n,) [m/s^2] and what was done, in words.

    Raises:
        InputError: too few samples.
    """
    from slipwise.signals.second_derivative import second_derivative  # here, for it takes long to load

    if len(displacement) < 9:
        raise InputError(f"{source.name}: {len(displacement)} samples of a displacement are too few to differentiate")
    values, frequency = second_derivative(displacement, dt)
    return values, f"{name} is a displacement: differentiated twice, below {frequency:.3g} Hz"
