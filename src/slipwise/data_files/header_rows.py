"""Where the table begins in a file of a laboratory: preamble, names, units, statistics, then rows of numbers.

A row of numbers may hold texts and time stamps beside its numbers. The names stand in the line above the units or,
where there are none, just above the numbers; LabVIEW, catman, Dewesoft, MTS and Campbell loggers put more lines there:
numbers of the channels, ranges, statistics. Kyowa and others say in the first cell of each line what it holds.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from slipwise.data_files.time_stamps import is_time_stamp
from slipwise.errors import InputError, UnitError
from slipwise.units import parse_unit

#: Lines in which a table must have begun.
_PREAMBLE = 400
#: Rows that are looked at to be sure of a table, and lines that may stand between its names and its numbers.
_SURE, _HEADER_LINES = 3, 6
#: Rows that show whether a column counts, rises or holds parts of a second.
_LOOK_AT = 60
#: What Campbell loggers write among the units for a time stamp and a record's number; read as units, tera- and ronna-.
_NO_UNITS = ("TS", "RN")
NUMBER = re.compile(r"^[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?$")
MISSING = (
    *("", "nan", "NaN", "NAN", "na", "NA", "N/A", "#N/A", "-", "--", "null", "inf", "-inf", "Inf", "-Inf", "+Inf"),
    *("#DIV/0!", "#NUM!", "#VALUE!", "#REF!"),
)
#: What the first cell of a line says that it holds, in the languages of loggers' makers.
_ROW_LABELS = {
    "names": re.compile(r"name|名称|名前|bezeichnung|\bnom(bre)?\b|signal|ad[ıi]\b", re.IGNORECASE),
    "units": re.compile(r"unit|einheit|単位|单位|單位|birim|unidad|\bEU\b", re.IGNORECASE),
    "other": re.compile(r"\bno\b|\bnr\b|number|nummer|range|bereich|レンジ|量程|番号|gain|scale|type", re.IGNORECASE),
}
_RANGE = re.compile(r"^(?:\(?[±+-]?\s*\d.*|off|on|auto|ac|dc|none|ch(annel)?[\s_-]*\d+)?$", re.IGNORECASE)
#: Names of columns that hold the part of a second which a clock does not show -> their unit [s].
_PARTS_OF_A_SECOND = (
    (re.compile(r"\b(?:ms|msecs?|milli\w*)\b|ミリ秒|毫秒", re.IGNORECASE), 1e-3),
    (re.compile(r"\b(?:us|µs|usecs?|micro\w*)\b", re.IGNORECASE), 1e-6),
)


@dataclass(frozen=True)
class Header:
    """Where a table begins.

    Attributes:
        names: of the columns.
        units: of the columns, empty if no line holds them.
        line: index of the line of names.
        first: index of the first row of numbers.
        stamps: numbers of the columns that hold time stamps.
        leading: number of the first column that holds a number or a time stamp in every row.
        part: number and unit [s] of the column with the parts of a second that the time stamps do not show, or None.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    line: int
    first: int
    stamps: tuple[int, ...]
    leading: int = 0
    part: tuple[int, float] | None = None

    def columns(self, what: str) -> tuple[str, ...]:
        """Return names with their units in brackets, "Force [kN]".

        Args:
            what: the file, for messages.

        Raises:
            InputError: a name and the row of units state different units.
        """
        out = []
        for k, name in enumerate(self.names):
            unit = self.units[k].strip().strip("[]()").strip() if self.units else ""
            unit = "" if unit in _NO_UNITS else unit
            found = re.search(r"[\[(]([^\])]*)[\])]\s*$", name)
            own = found[1].strip() if found and _is_unit(found[1].strip()) else ""
            if k in self.stamps and "[" not in name:
                unit = "s"  # time stamps are read as seconds since the first one
            elif own and unit != own and _is_unit(unit):
                raise InputError(
                    f"{what}: the column {name!r} states its unit in its name, and the row of units says {unit!r}; "
                    "correct the wrong one"
                )
            elif own:
                unit = ""
            out.append(f"{name} [{unit}]" if unit and "[" not in name else name)
        return tuple(out)

    def is_row(self, cells: Sequence[str]) -> bool:
        """Return whether a line is a row of the table: totals and words below it do not begin with a number."""
        return len(cells) > self.leading and _is_value(cells[self.leading])


def find_header(rows: Sequence[Sequence[str]]) -> Header | None:
    """Find the first table that has names, None where there is none.

    Args:
        rows: the cells of the file's first lines; an empty line has no cells.
    """
    for first in range(1, min(len(rows), _PREAMBLE)):
        width = len(rows[first])
        if width < 2 or not looks_numeric(rows[first]) or not _goes_on(rows, first) or _is_number_row(rows, first):
            continue
        above = _lines_above(rows, first)
        if not above:
            continue
        following = [row for row in rows[first : first + _LOOK_AT] if len(row) == width]
        labels = _labels(rows, above)
        found = _labelled(above, labels) if labels else _unlabelled(rows, above)
        if found is None:
            continue
        line, units_at = found
        names = [rows[line][0].lstrip("#% "), *rows[line][1:]]
        if len(names) < width or not any(names):
            continue
        units = [] if units_at is None else list(rows[units_at][:width])
        if labels:  # the first cells say what the lines hold
            names[0] = "time" if _rises([row[0] for row in following]) else ""
            units[:1] = [""] if units else []
        stamps = tuple(k for k, cell in enumerate(rows[first]) if is_time_stamp(cell))
        leading = next((k for k in range(width) if all(_is_value(row[k]) for row in following[:_SURE])), 0)
        part = _part(names, units, stamps, following)
        return Header(tuple(names[:width]), tuple(units), line, first, stamps, leading, part)
    return None


def looks_numeric(cells: Sequence[str]) -> bool:
    """Return whether a line holds data: most cells are numbers, time stamps or empty, and it is no "key, number"."""
    numbers = sum(map(_is_value, cells))
    most = numbers > 0 and numbers + sum(cell in MISSING for cell in cells) >= 0.5 * len(cells)
    begins = bool(cells) and (_is_value(cells[0]) or cells[0] in MISSING)
    return most and (begins or numbers > 0.5 * len(cells))


def _is_value(cell: str) -> bool:
    return bool(NUMBER.match(cell)) or is_time_stamp(cell)


def _goes_on(rows: Sequence[Sequence[str]], first: int) -> bool:
    """Return whether the lines that follow are rows of the same width."""
    following = [row for row in rows[first + 1 : first + 1 + 3 * _SURE] if any(row)][: _SURE - 1]
    return all(len(row) == len(rows[first]) and looks_numeric(row) for row in following)


def _is_number_row(rows: Sequence[Sequence[str]], i: int) -> bool:
    """Tell a line that numbers the columns, "1,2,3" or "CH No,1,2,3", from a row of data.

    Its numbers count, and the first column does not go on from it as it goes on below.
    """
    cells = rows[i]
    numbers = cells if cells[0].isdigit() else cells[1:]
    if len(cells) < 3 or not all(cell.isdigit() for cell in numbers):
        return False
    counted = list(map(int, numbers))
    if counted[0] > 1 or counted != list(range(counted[0], counted[0] + len(counted))):
        return False
    if not cells[0].isdigit() and cells[0] not in MISSING:
        return True
    below = [row[0] for row in rows[i + 1 : i + 3] if row]
    if len(below) < 2 or not all(map(NUMBER.match, below)):
        return bool(below) and not NUMBER.match(below[0]) and below[0] not in MISSING
    one, two, three = (float(cell.replace(",", ".") or "nan") for cell in (cells[0], *below))
    return not 0.5 * (three - two) <= two - one <= 2.0 * (three - two)


def _lines_above(rows: Sequence[Sequence[str]], first: int) -> list[int]:
    """Return the lines of the same width above the first row, the nearest first; an empty one may stand between."""
    width, found = len(rows[first]), []
    for i in range(first - 1, max(-1, first - 2 * _HEADER_LINES), -1):
        if not any(rows[i]):
            # Campbell's rows of statistics may be empty but for their separators.
            if len(rows[i]) > 1 or not found:
                continue
            break
        # LabVIEW names a column of comments that the rows do not have.
        if len(rows[i]) not in (width, width + 1) or (looks_numeric(rows[i]) and not _is_number_row(rows, i)):
            break
        found.append(i)
    return found[:_HEADER_LINES]


def _labels(rows: Sequence[Sequence[str]], above: Sequence[int]) -> list[str]:
    """Return what the first cell of each line says that the line holds; nothing where lines do not begin so."""
    said = [next((what for what, label in _ROW_LABELS.items() if label.search(rows[i][0])), "") for i in above]
    return said if sum(map(bool, said)) >= (2 if "names" in said else 3) else []


def _labelled(above: Sequence[int], labels: Sequence[str]) -> tuple[int, int | None] | None:
    """Return the lines of names and units where the first cell of each line says what it holds."""
    if "names" not in labels:
        return None
    return above[labels.index("names")], above[labels.index("units")] if "units" in labels else None


def _unlabelled(rows: Sequence[Sequence[str]], above: Sequence[int]) -> tuple[int, int | None] | None:
    """Return the lines of names and units: the names stand above the units, whatever stands between them."""
    units_at = next((i for i in above if _is_unit_row(rows[i])), None)
    if units_at is not None:
        over = [i for i in above if i < units_at]
        if not over and not (above[0] > units_at and all(map(_is_unit, rows[units_at]))):
            # A file of one header row may be named by symbols that are units too: t, s, N.
            units_at = None
        above = over or above
    names = next((i for i in above if not _is_number_row(rows, i) and not _is_range_row(rows[i])), None)
    return None if names is None or looks_numeric(rows[names]) else (names, units_at)


def _is_range_row(cells: Sequence[str]) -> bool:
    """Tell a line of ranges, "±10 V", "OFF", "CH1", from a line of names."""
    texts = [cell for cell in cells if cell]
    return bool(texts) and all(_RANGE.match(cell) for cell in texts)


def _is_unit_row(cells: Sequence[str]) -> bool:
    """Return whether most of a line's texts are units."""
    texts = [cell.strip().strip("[]()").strip() for cell in cells if cell.strip()]
    known = sum(_is_unit(text) for text in texts)
    return bool(texts) and known >= 0.5 * len(texts)


def _is_unit(text: str) -> bool:
    if text in ("", "-", "%", "1"):
        return text != ""
    if text[0].isdigit():  # a range: "50 mm"
        return False
    try:
        parse_unit(text, text, "")
    except UnitError:
        return False
    return True


def _rises(cells: Sequence[str]) -> bool:
    """Return whether numbers rise in even steps."""
    if len(cells) < 2 or not all(NUMBER.match(cell) for cell in cells):
        return False
    values = [float(cell.replace(",", ".")) for cell in cells]
    step = (values[-1] - values[0]) / (len(values) - 1)
    return step > 0.0 and all(abs(value - values[0] - k * step) < step for k, value in enumerate(values))


def _part(
    names: Sequence[str], units: Sequence[str], stamps: Sequence[int], following: Sequence[Sequence[str]]
) -> tuple[int, float] | None:
    """Find the column with the milliseconds of a clock that shows whole seconds."""
    clock = [row[stamps[-1]] for row in following] if stamps else []
    if len(set(clock)) == len(clock) or any(re.search(r"[.,]\d", cell) for cell in clock):
        return None
    for k in range(len(following[0])):
        for words, unit in _PARTS_OF_A_SECOND:
            texts = [row[k] for row in following]
            named = words.search(names[k].replace("_", " ")) or (units and words.fullmatch(units[k].strip("[]() ")))
            if named and all(text.isdigit() and int(text) * unit < 1.0 for text in texts):
                return k, unit
    return None
