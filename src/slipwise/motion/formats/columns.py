"""Plain columns: acceleration alone, time and acceleration, or more with a header that names each.

Step, unit, count, peaks and component are taken from any header, from a first line "npts dt", or from the user; those
that contradict each other are refused. A headless time column has no unit, so it only confirms the step that was given.
One series may be wrapped, several values or several pairs of time and value a line.
"""

import re
from dataclasses import replace

from slipwise.data_files.acceleration_unit import is_acceleration
from slipwise.data_files.statements import read_statements
from slipwise.data_files.text_file import layout_of
from slipwise.errors import InputError
from slipwise.motion.column_traces import ColumnTable, column_traces
from slipwise.motion.first_lines import read_first_lines
from slipwise.motion.named_table import names_and_units, text_table
from slipwise.motion.number_rows import Rows, find_first_row, numbers_of, read_rows
from slipwise.motion.source_file import HEAD_BYTES, SourceFile
from slipwise.motion.stated import Given, agreed_step
from slipwise.motion.time_column import last_digit
from slipwise.motion.trace import Trace
from slipwise.motion.wrapped import wrapped_pairs, wrapped_series


def recognise(head: bytes) -> bool:
    """Return whether some line of the head holds nothing but numbers, or names stand above a table."""
    # A head that is not the whole file may end within a number.
    whole = head if len(head) < HEAD_BYTES else re.sub(rb"[^\s,;]*$", b"", head)
    lines = whole.decode("utf-8", "replace").splitlines()
    # Rows of named columns may hold time stamps.
    return find_first_row(lines) is not None or layout_of(lines, "") is not None


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every column of acceleration.

    Raises:
        InputError: no step, rows that are damaged, times that do not rise evenly, columns that nothing names, or
            statements that contradict each other.
        UnitError: no unit, or one that is none of acceleration.
    """
    table = text_table(source)
    if table is not None:
        return column_traces(table, source, given)
    first = read_first_lines(read_rows(source), given.dt, source)
    rows, stated = first.rows, read_statements(first.rows.header, source.name)
    stated = replace(
        stated,
        step=agreed_step(stated.step, first.step, "its first lines", source),
        count=agreed_count(first.count, stated.count, source),
    )
    per_line = len(rows.values[0])
    names, units = _name_above(rows) if per_line == 1 else ((), ())
    words: tuple[str, ...] = ()
    if (values := wrapped_pairs(rows)) is not None:
        names, units = ("time", ""), ("s", "")
        words = (f"{per_line // 2} pairs of time and value a line, time taken in seconds",)
    elif (series := wrapped_series(rows)) is not None:
        values, words = series[:, None], (f"{per_line} values a line, read line by line as one series",)
    else:
        values = rows.table(source)
    table = ColumnTable(
        names,
        units,
        values,
        stated,
        at=lambda row: source.at(rows.places[min(row, len(rows.places) - 1)]),
        rounding=lambda k: last_digit(numbers_of(source.lines[rows.places[-1]])[k]),
        title=rows.header[0] if rows.header else "",
        words=words,
    )
    return column_traces(table, source, given)


def _name_above(rows: Rows) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return name and unit of a single column, where the line above it is a name and a unit of acceleration."""
    names, units = names_and_units(rows.header[-1:])
    return (names, units) if any(map(is_acceleration, units)) else ((), ())


def agreed_count(one: int | None, other: int | None, source: SourceFile) -> int | None:
    """Return the count that header and first line state.

    Raises:
        InputError: two that differ.
    """
    if one is not None and other is not None and one != other:
        raise InputError(f"{source.name}: the header states {other} values, its first line {one}; correct one of them")
    return one if one is not None else other
