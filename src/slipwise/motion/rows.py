"""Text files whose lines are rows of numbers, below a header of any kind."""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.source_file import SourceFile, is_number, number

#: "Time[s]", "time (s)", "table_ax [m/s^2]": a name and, in brackets, its unit.
_CELL = re.compile(r"\s*\"?([^\[\](),;\t]*?)\s*[\[(]([^\[\]()]*(?:\([^()]*\))?[^\[\]()]*)[\])]\"?\s*(?:[,;\t]|\s|$)")


@dataclass(frozen=True)
class Rows:
    """A table of numbers as it stands in a file.

    Attributes:
        names: of the columns, empty if the header does not name each of them with its unit.
        units: of the columns as written, likewise.
        title: the first header line, "" if there is none.
        values: (n, columns) as written.
        first: index of the line of each row.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    title: str
    values: NDArray[np.float64]
    first: tuple[int, ...]


def split_row(line: str) -> list[str]:
    """Cut a line at its commas, semicolons or tabs, or at blanks where there is none of these."""
    text = line.strip()
    for separator in (",", ";", "\t"):
        if separator in text:
            fields = [field.strip() for field in text.split(separator)]
            return fields[:-1] if fields[-1] == "" else fields
    return text.split()


def find_first_row(lines: tuple[str, ...] | list[str]) -> int | None:
    """Give the index of the first line that holds nothing but numbers, None if there is none."""
    for i, line in enumerate(lines):
        fields = split_row(line)
        if fields and all(is_number(field) for field in fields):
            return i
    return None


def read_rows(source: SourceFile) -> Rows:
    """Read the table.

    Raises:
        InputError: no numbers, a row of another length than the first, a field that is no number.
    """
    start = find_first_row(source.lines)
    if start is None:
        raise InputError(f"{source.name}: no line of numbers is in this file; see `slipwise motions` for what is read")
    header = [line.strip().lstrip("#%/! ").rstrip(" ,;") for line in source.lines[:start]]
    header = [line for line in header if line]
    columns = len(split_row(source.lines[start]))
    _refuse_damaged_first_row(source, start, columns)
    values, places = [], []
    for i in range(start, len(source.lines)):
        fields = split_row(source.lines[i])
        if not fields:
            continue
        if len(fields) != columns:
            raise InputError(
                f"{source.at(i)}: {len(fields)} values stand where {columns} were expected; "
                "the record is truncated or damaged"
            )
        values.append([number(field, source.at(i)) for field in fields])
        places.append(i)
    cells = _CELL.findall(header[-1]) if header else []
    # "El Centro (1940)" is a title; brackets without a letter hold no unit.
    if len(cells) != columns or not all(any(c.isalpha() for c in unit) for _, unit in cells):
        cells = []
    return Rows(
        names=tuple(name.strip() for name, _ in cells),
        units=tuple(unit.strip() for _, unit in cells),
        title=header[0] if header else "",
        values=np.array(values, dtype=float),
        first=tuple(places),
    )


def _refuse_damaged_first_row(source: SourceFile, start: int, columns: int) -> None:
    """Refuse a line of data that passes for a header because one of its fields is damaged."""
    if start == 0:
        return
    fields = split_row(source.lines[start - 1])
    numeric = [is_number(field) for field in fields]
    if len(fields) == columns and any(numeric):
        number(fields[numeric.index(False)], source.at(start - 1))
