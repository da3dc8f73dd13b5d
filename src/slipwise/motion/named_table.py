"""Tables whose columns are named, read as those of campaigns are, in any file that holds a table."""

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.data_files.acceleration_unit import is_acceleration
from slipwise.data_files.column_names import name_and_unit
from slipwise.data_files.statements import read_statements
from slipwise.data_files.table import Table, open_table
from slipwise.data_files.table_rows import left_out_below
from slipwise.data_files.text_file import BLANKS, TextLayout, columns_of_text, layout_of
from slipwise.data_files.words import folded, words
from slipwise.errors import InputError
from slipwise.motion.column_kind import is_column_word, is_time_word
from slipwise.motion.column_traces import ColumnTable
from slipwise.motion.number_rows import COMMENT_SIGNS, refuse_cut_number
from slipwise.motion.source_file import SourceFile, is_number
from slipwise.motion.time_column import last_digit

#: Lines in which the names of the columns must stand.
_LOOK_AT = 500
_BRACKETS = re.compile(r"^\s*(?P<name>[^\[(]*?)\s*[\[(](?P<unit>.*)[\])]\s*$")
#: Columns of a matrix of MATLAB, which nothing names: "x(:,3)".
_UNNAMED = re.compile(r"\w+\((?::,\d+|\d+,:)\)")


def text_table(source: SourceFile) -> ColumnTable | None:
    """Read a text table whose columns are named, None where none is.

    Raises:
        InputError: a row that is damaged, a last number that is cut off, or several tables that no times join.
    """
    layout = layout_of(source.lines[:_LOOK_AT], source.name)
    if layout is None:
        return None
    names, units = names_and_units(layout.headers)
    # Two words above two columns may as well be a title: names without units must be known ones.
    named = any(units) or all(map(is_column_word, names)) or is_time_word(names[0])
    half = len(names) // 2
    if not named or (half > 1 and names == names[:2] * half) or _is_prose(layout, names, units):
        return None
    # Words, totals and empty lines may stand below.
    last = next(i for i in reversed(range(len(source.lines))) if layout.header.is_row(layout.cells(source.lines[i])))
    refuse_cut_number(source, range(layout.header.first, last + 1))
    text = "\n".join(source.lines[: last + 1])
    if re.search(r"\d[dD][+-]\d", source.lines[layout.header.first]):
        text = re.sub(r"(?<=[\d.])[dD](?=[+-]?\d)", "e", text)  # Fortran's double precision
    columns, blocks = columns_of_text(text, source.name, layout, range(len(names)))
    if blocks and not any(map(is_time_word, names)):
        raise InputError(
            f"{source.name}: {len(blocks)} tables stand one below the other, from lines "
            f"{', '.join(str(block.line) for block in blocks)} on, and no column of times says that they are one "
            "record; cut the file there"
        )
    above = [line.strip().lstrip(COMMENT_SIGNS) for line in layout.above if line.strip()]
    return ColumnTable(
        names,
        units,
        np.stack(columns, axis=1),
        read_statements(above, source.name),
        at=lambda row: _place(source, layout, row),
        rounding=lambda k: last_digit(layout.cells(source.lines[last])[k]),
        title=above[0] if above else "",
        words=left_out_below(source.name, [layout.cells(line) for line in source.lines[last + 1 :]]),
    )


def file_table(source: SourceFile) -> ColumnTable:
    """Read the table of a file that is no text: a workbook, a MATLAB, Parquet or LabVIEW file.

    Raises:
        InputError: the file cannot be read.
    """
    if source.path is None:
        raise InputError(f"{source.name}: this file is read from where it stands; give its path")
    table = open_table(source.path)
    columns, left = _longest(table)
    headers = [table.headers[k] for k in columns]
    # "rec.time", "rec.ax": the structure that holds all of them tells nothing.
    within = {header.rpartition(".")[0] for header in headers}
    names, units = names_and_units([h.rpartition(".")[2] for h in headers] if len(within) == 1 else headers)
    beside = () if table.step is None else (f"time step = {table.step!r} s",)
    if all(map(_UNNAMED.fullmatch, headers)):
        names, units = (), ()
    words = (f"left out, for they are shorter or hold no numbers: {', '.join(left)}",) if left else ()
    return ColumnTable(
        names,
        units,
        np.stack(list(columns.values()), axis=1),
        read_statements([*table.above, *beside], source.name),
        at=lambda row: f"{source.name}, row {row + 1}",
        title=table.above[0].strip() if table.above else "",
        read_as="a table of a campaign",
        words=(*table.notes, *words),
    )


def _longest(table: Table) -> tuple[dict[int, NDArray[np.float64]], list[str]]:
    """Read the columns (n,) of numbers that are as long as the longest, by number; the others are named.

    Raises:
        InputError: no column can be read.
    """
    read: dict[int, NDArray[np.float64]] = {}
    for k in range(len(table.headers)):
        try:
            (read[k],) = table.columns([k]).values
        except InputError:
            if k == len(table.headers) - 1 and not read:
                raise
    longest = max(map(len, read.values()))
    kept = {k: column for k, column in read.items() if len(column) == longest}
    return kept, [header for k, header in enumerate(table.headers) if k not in kept]


def names_and_units(headers: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Take headers apart; the unit stays as written, "" where there is none."""
    pairs = [_name_and_unit(header) for header in headers]
    return tuple(name for name, _ in pairs), tuple(unit for _, unit in pairs)


def _name_and_unit(header: str) -> tuple[str, str]:
    match = _BRACKETS.match(header)
    # "El Centro (1940)" is a title; brackets without a letter hold no unit.
    if match and any(c.isalpha() for c in match["unit"]):
        return match["name"], match["unit"].strip()
    found = name_and_unit(header)
    if found.kind in ("time", "acceleration") and found.unit not in ("?", "") and found.name != header.strip():
        return found.name, found.unit
    return header.strip(), "" if not is_acceleration(header) or len(header.strip()) < 2 else header.strip()


def _is_prose(layout: TextLayout, names: Sequence[str], units: Sequence[str]) -> bool:
    """Tell a sentence that happens to have as many words as there are columns from names that blanks separate."""
    if layout.delimiter != BLANKS:
        return False
    links = re.compile(words().links, re.IGNORECASE)
    in_sentences = any(
        name.endswith((",", ";", ":", "=")) or is_number(name) or (len(name) > 1 and links.fullmatch(folded(name)))
        for name in names
    )
    # Among names a unit stands in brackets, or every column has one.
    loose = not all(units) and any(unit and unit == name for name, unit in zip(names, units, strict=True))
    return in_sentences or loose


def _place(source: SourceFile, layout: TextLayout, row: int) -> str:
    """Say where a row stands; empty lines and repeated headers are no rows."""
    rows = -1
    for i in range(layout.header.first, len(source.lines)):
        rows += layout.header.is_row(layout.cells(source.lines[i]))
        if rows == row:
            return source.at(i)
    return source.name
