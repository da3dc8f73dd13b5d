"""Plain columns: acceleration alone, time and acceleration, or more with a header that names each.

Step, unit, count, peak and component are taken from any header ("KEY: value"), from a first line "npts dt", or from
the user; those that contradict each other are refused. A headless time column has no unit, so it only confirms the
step that was given. One series may be wrapped, several values a line.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError, UnitError
from slipwise.motion.column_kind import kind_of
from slipwise.motion.displacement import acceleration_of
from slipwise.motion.first_lines import read_first_lines
from slipwise.motion.free_header import Peak, Stated, read_free_header
from slipwise.motion.orientation import name_from_stem, orientation, sensor_of
from slipwise.motion.rows import Rows, find_first_row, read_rows
from slipwise.motion.source_file import SourceFile, check_count, is_number
from slipwise.motion.stated import Given, acceleration_factor, agreed_step, agreed_unit, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.time_column import column_step
from slipwise.motion.trace import Trace, check_header_peak, half_last_digit
from slipwise.motion.wrapped import wrapped_series
from slipwise.units import parse_unit

#: What a headless column of times may be in.
_SECONDS_PER = {"s": 1.0, "ms": 1e-3}


def recognise(head: bytes) -> bool:
    """Tell whether some line of the head holds nothing but numbers."""
    # The head may cut its last line anywhere.
    lines = head.decode("utf-8", "replace").splitlines()
    return find_first_row(lines if len(lines) < 2 else lines[:-1]) is not None


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every column of acceleration.

    Raises:
        InputError: no step, rows that are damaged, times that do not rise evenly, columns that nothing names, or
            statements that contradict each other.
        UnitError: no unit, or one that is none of acceleration.
    """
    first = read_first_lines(read_rows(source), given.dt, source)
    rows, stated = first.rows, read_free_header(source, first.rows.header)
    counted = agreed_count(first.count, stated.count, source)
    stated = replace(stated, step=agreed_step(stated.step, first.step, "its first lines", source), count=counted)
    series = wrapped_series(rows)
    if series is not None:
        words = (f"{len(rows.values[0])} values a line, read line by line as one series",)
        return [_trace(source, given, stated, "", "", series, None, words, rows)]
    return _columns(source, given, stated, rows)


def agreed_count(one: int | None, other: int | None, source: SourceFile) -> int | None:
    """Give the count that header and first line state.

    Raises:
        InputError: two that differ.
    """
    if one is not None and other is not None and one != other:
        raise InputError(f"{source.name}: the header states {other} values, its first line {one}; correct one of them")
    return one if one is not None else other


def _columns(source: SourceFile, given: Given, stated: Stated, rows: Rows) -> list[Trace]:
    """Read a table: time if it is there, and every column of acceleration."""
    width = len(rows.values[0])
    if width > 2 and not rows.names:
        raise InputError(
            f"{source.name}: {width} columns without a header that names them, and they do not look like one series "
            "with several values a line; write a header as the last line above "
            "the numbers, for example 'time [s],EW [cm/s^2],NS [cm/s^2],UD [cm/s^2]'"
        )
    values = rows.table(source)
    names, units = rows.names, rows.units
    if not names:
        names, units = (("time", ""), ("", "")) if width == 2 else (("",), ("",))
    kinds = [
        "acceleration" if not name and not unit else kind_of(name, unit, f"column {name!r} of {source.name}")
        for name, unit in zip(names, units, strict=True)
    ]
    words: list[str] = []
    step = None
    if "time" in kinds[1:] or kinds.count("time") > 1:
        raise InputError(f"{source.name}: the time must be the first column, and there may be only one")
    if kinds[0] == "time":
        step = column_step(rows, values, units[0] or "s", source)
        if not rows.names:
            # A headless column of times has no unit: the step must be given all the same.
            settle_step(stated.step, given, source)
            step = _headless_step(step, given.dt if given.dt is not None else stated.step, source)
        elif not units[0]:
            words.append(f"column {names[0]!r} has no unit: taken in seconds")
    stated = replace(stated, step=agreed_step(stated.step, step, "its time column", source))
    chosen = [k for k, kind in enumerate(kinds) if kind == "acceleration"]
    moved = not chosen and "displacement" in kinds
    if moved:
        chosen = [k for k, kind in enumerate(kinds) if kind == "displacement"]
    left = [f"{names[k] or f'column {k + 1}'} ({kinds[k]})" for k in range(width) if k not in (0, *chosen)]
    if left:
        words.append(f"left out: {', '.join(left)}")
    if not chosen:
        raise UnitError(
            f"{source.name}: no column holds an acceleration, there are {', '.join(left) or names[0]}; "
            "a column like 'EW [m/s^2]' is needed"
        )
    if moved:
        dt = settle_step(stated.step, given, source)[0]
        return [_of_displacement(source, given, stated, names[k], units[k], values[:, k], dt, rows) for k in chosen]
    several = len(chosen) > 1
    return [
        _trace(source, given, stated, names[k], units[k], values[:, k], several, tuple(words), rows) for k in chosen
    ]


def _of_displacement(
    source: SourceFile,
    given: Given,
    stated: Stated,
    name: str,
    unit: str,
    values: NDArray[np.float64],
    dt: float,
    rows: Rows,
) -> Trace:
    """Make a component of a table's displacement."""
    if not unit:
        raise UnitError(f"{source.name}: the displacement {name!r} has no unit; write it in brackets: '{name} [mm]'")
    if given.unit is not None:
        raise UnitError(f"{source.name}: {name!r} is a displacement in {unit}; leave --unit {given.unit} out")
    metres = values * parse_unit(unit, "m", f"column {name!r} of {source.name}")
    acceleration, words = acceleration_of(metres, dt, source, name)
    si = replace(stated, unit=None, peak=None)
    return _trace(source, given, si, name, "m/s^2", acceleration, True, (words,), rows)


def _trace(
    source: SourceFile,
    given: Given,
    stated: Stated,
    name: str,
    unit: str,
    values: NDArray[np.float64],
    several: bool | None,
    words: tuple[str, ...],
    rows: Rows,
) -> Trace:
    """Make one component of a column or a series."""
    if stated.count is not None:
        check_count(len(values), stated.count, source, "the header")
    dt, dt_words = settle_step(stated.step, given, source)
    factor, unit_words = settle_unit(agreed_unit(unit or None, stated.unit, source), given, source)
    called = name if several else _single_name(name, stated, source)
    acceleration = values * factor
    peak = None if several or stated.peak is None else _header_peak(stated.peak, factor, source)
    if peak is not None:
        check_header_peak(acceleration, dt, peak, source, called)
    origin = stated.origin
    return Trace(
        source=source,
        name=called,
        title=_title(stated, rows, source),
        dt=dt,
        acceleration=acceleration,
        baseline="none",
        treatment=(
            f"read as text columns: {source.name}, component {called}",
            f"{unit_words}; {dt_words}",
            *words,
        ),
        header_peak=peak,
        origin=replace(origin, sensor=origin.sensor or sensor_of(called)),
    )


def _title(stated: Stated, rows: Rows, source: SourceFile) -> str:
    origin = stated.origin
    return " ".join(part for part in (origin.station, origin.event) if part) or rows.title or source.stem


def _single_name(name: str, stated: Stated, source: SourceFile) -> str:
    """Give the name of the only component: the column's, the header's or the file's."""
    if name and orientation(name) != "unknown":
        return name
    return stated.component or name_from_stem(source.stem) or source.stem


def _header_peak(peak: Peak, factor: float, source: SourceFile) -> HeaderPeak | None:
    """Give the stated peak in SI; its own unit where it has one, else that of the data."""
    text = peak.text.replace(",", ".")
    if not is_number(text):
        return None
    own = acceleration_factor(peak.unit, f"the peak in the header of {source.name}") if peak.unit else factor
    return HeaderPeak(float(text) * own, peak.time, half_last_digit(text) * own)


def _headless_step(step: float, stated: float | None, source: SourceFile) -> float:
    """Hold a headless time column against the step that was given or stated."""
    for seconds in _SECONDS_PER.values():
        if stated is not None and abs(step * seconds - stated) <= 1e-4 * stated:
            return step * seconds
    given_words = f"{stated:g} s" if stated is not None else "nothing"
    raise InputError(
        f"{source.name}: the first column advances by {step:g} a row, {given_words} was given as the step; neither in "
        f"{' nor in '.join(_SECONDS_PER)} do they agree"
    )
