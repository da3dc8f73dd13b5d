"""Where the table begins in a file of a laboratory: preamble, names, units, statistics, then rows of numbers.

A row of numbers may hold texts and time stamps beside its numbers. The names stand in the line above the units or,
where there are none, just above the numbers; LabVIEW, catman, Dewesoft, MTS and Campbell loggers put more lines there.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from slipwise.campaign.time_stamps import is_time_stamp
from slipwise.errors import UnitError
from slipwise.units import parse_unit

#: Lines in which a table must have begun.
_PREAMBLE = 400
#: Rows that are looked at to be sure of a table, and lines that may stand between its names and its numbers.
_SURE, _HEADER_LINES = 3, 4
#: What Campbell loggers write among the units for a time stamp and a record's number; read as units, tera- and ronna-.
_NO_UNITS = ("TS", "RN")
NUMBER = re.compile(r"^[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?$")
MISSING = ("", "nan", "NaN", "NAN", "na", "NA", "N/A", "#N/A", "-", "--", "null", "inf", "-inf", "Inf", "-Inf", "+Inf")


@dataclass(frozen=True)
class Header:
    """Where a table begins.

    Attributes:
        names: of the columns.
        units: of the columns, empty if no line holds them.
        line: index of the line of names.
        first: index of the first row of numbers.
        stamps: numbers of the columns that hold time stamps.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    line: int
    first: int
    stamps: tuple[int, ...]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names with their units in brackets: "Force [kN]"."""
        out = []
        for k, name in enumerate(self.names):
            unit = self.units[k].strip().strip("[]()").strip() if self.units else ""
            unit = "" if unit in _NO_UNITS else unit
            if k in self.stamps and "[" not in name:
                unit = "s"  # time stamps are read as seconds since the first one
            out.append(f"{name} [{unit}]" if unit and "[" not in name else name)
        return tuple(out)


def find_header(rows: Sequence[Sequence[str]]) -> Header | None:
    """Find the first table that has names, None where there is none.

    Args:
        rows: the cells of the file's first lines; an empty line has no cells.
    """
    for first in range(1, min(len(rows), _PREAMBLE)):
        width = len(rows[first])
        if width < 2 or not looks_numeric(rows[first]) or not _goes_on(rows, first):
            continue
        above = _lines_above(rows, first)
        if not above:
            continue
        units_at = next((i for i in above if _is_unit_row(rows[i]) and _names_above(rows, i, width)), None)
        line = above[0] if units_at is None else _previous(rows, units_at)
        names = tuple(cell.lstrip("#% ").strip() if k == 0 else cell.strip() for k, cell in enumerate(rows[line]))
        if len(names) < width or not any(names) or looks_numeric(rows[line]):
            continue
        units = () if units_at is None else tuple(rows[units_at][:width])
        stamps = tuple(k for k, cell in enumerate(rows[first]) if is_time_stamp(cell))
        return Header(names[:width], units, line, first, stamps)
    return None


def looks_numeric(cells: Sequence[str]) -> bool:
    """Tell whether a line holds data: most cells are numbers, time stamps or empty, and it is no "key, number"."""
    numbers = sum(bool(NUMBER.match(cell)) or is_time_stamp(cell) for cell in cells)
    most = numbers > 0 and numbers + sum(cell in MISSING for cell in cells) >= 0.5 * len(cells)
    begins = bool(cells) and (bool(NUMBER.match(cells[0])) or is_time_stamp(cells[0]) or cells[0] in MISSING)
    return most and (begins or numbers > 0.5 * len(cells))


def _goes_on(rows: Sequence[Sequence[str]], first: int) -> bool:
    """Tell whether the lines that follow are rows of the same width."""
    following = [row for row in rows[first + 1 : first + 1 + 3 * _SURE] if any(row)][: _SURE - 1]
    return all(len(row) == len(rows[first]) and looks_numeric(row) for row in following)


def _lines_above(rows: Sequence[Sequence[str]], first: int) -> list[int]:
    """Give the lines of the same width above the first row, the nearest first; an empty one may stand between."""
    width, found = len(rows[first]), []
    for i in range(first - 1, max(-1, first - 2 * _HEADER_LINES), -1):
        if not any(rows[i]):
            # Campbell's rows of statistics may be empty but for their separators.
            if len(rows[i]) > 1 or not found:
                continue
            break
        # LabVIEW names a column of comments that the rows do not have.
        if len(rows[i]) not in (width, width + 1) or looks_numeric(rows[i]):
            break
        found.append(i)
    return found[:_HEADER_LINES]


def _previous(rows: Sequence[Sequence[str]], i: int) -> int:
    return next((k for k in range(i - 1, -1, -1) if any(rows[k])), i)


def _names_above(rows: Sequence[Sequence[str]], i: int, width: int) -> bool:
    above = rows[_previous(rows, i)]
    return _previous(rows, i) != i and len(above) in (width, width + 1) and not looks_numeric(above)


def _is_unit_row(cells: Sequence[str]) -> bool:
    """Tell whether most of a line's texts are units."""
    texts = [cell.strip().strip("[]()").strip() for cell in cells if cell.strip()]
    known = sum(_is_unit(text) for text in texts)
    return bool(texts) and known >= 0.5 * len(texts)


def _is_unit(text: str) -> bool:
    if text in ("", "-", "%", "1"):
        return text != ""
    try:
        parse_unit(text, text, "")
    except UnitError:
        return False
    return True
