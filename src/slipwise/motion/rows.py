"""Text files whose lines are rows of numbers, below a header of any kind."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.column_kind import is_column_word, is_time_word
from slipwise.motion.number_rows import DECIMAL_COMMA, numbers_of, rows_of_numbers, split_row
from slipwise.motion.source_file import SourceFile, is_number, number

#: "Time[s]", "time (s)", "table_ax [m/s^2]": a name and, in brackets, its unit.
_CELL = re.compile(r"\s*\"?([^\[\](),;\t]*?)\s*[\[(]([^\[\]()]*(?:\([^()]*\))?[^\[\]()]*)[\])]\"?\s*(?:[,;\t]|\s|$)")
_BRACKETS = re.compile(r"^(?P<name>[^\[(]*?)\s*[\[(](?P<unit>.*)[\])]$")
#: A header may hold rows of numbers of its own, no more than these, within so many lines.
_OWN_ROWS, _HEADER_LINES = 12, 200
#: Lines below the numbers that may mark the end: words, no digits.
_END_MARKS = 3


@dataclass(frozen=True)
class Rows:
    """A table of numbers as it stands in a file.

    Attributes:
        names: of the columns, empty if the header does not name each of them.
        units: of the columns as written, likewise; "" of a column whose name has no unit.
        header: the lines above the numbers and above the names that are not empty, without comment signs.
        values: (n, columns), or the rows one by one where not all are of one length.
        places: index of the line of each row.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    header: tuple[str, ...]
    values: NDArray[np.float64] | tuple[NDArray[np.float64], ...]
    places: Sequence[int]

    @property
    def title(self) -> str:
        """The first header line, "" if there is none."""
        return self.header[0] if self.header else ""

    def table(self, source: SourceFile) -> NDArray[np.float64]:
        """Give the values as a table (n, columns).

        Raises:
            InputError: rows of different lengths.
        """
        if isinstance(self.values, np.ndarray):
            return self.values
        columns = len(self.values[0])
        for i, row in zip(self.places, self.values, strict=True):
            if len(row) != columns:
                raise InputError(
                    f"{source.at(i)}: {len(row)} values stand where {columns} were expected; "
                    "the record is truncated or damaged"
                )
        return np.stack(self.values)

    def series(self) -> NDArray[np.float64]:
        """Give all numbers in reading order."""
        return self.values.ravel() if isinstance(self.values, np.ndarray) else np.concatenate(self.values)

    def below(self, lines: int) -> "Rows":
        """Give the rows below the first ones."""
        return replace(self, values=self.values[lines:], places=self.places[lines:])


def find_first_row(lines: Sequence[str]) -> int | None:
    """Give the index of the first line that holds nothing but numbers, None if there is none."""
    return next((i for i, line in enumerate(lines) if numbers_of(line)), None)


def read_rows(source: SourceFile) -> Rows:
    """Read the rows of numbers below a header.

    Raises:
        InputError: no numbers, or a field that is no number.
    """
    start = find_first_row(source.lines)
    if start is None:
        raise InputError(f"{source.name}: no line of numbers is in this file; see `slipwise motions` for what is read")
    start = _after_the_headers_own(source.lines, start)
    end = _before_end_marks(source.lines, start)
    places: Sequence[int] = [i for i in range(start, end) if source.lines[i].strip()]
    if len(places) == end - start:
        places = range(start, end)  # two million numbers less
    header = [line.strip().lstrip("#%/!*$ ").rstrip(" ,;") for line in source.lines[:start]]
    header = [line for line in header if line]
    single = _single_decimal_commas(source.lines[i] for i in places)
    columns = 1 if single else len(split_row(source.lines[start]))
    _refuse_damaged_first_row(source, start, columns)
    _refuse_cut_number(source, places)
    names, units, lines = _column_names(header, columns)
    return Rows(
        names, units, tuple(header[: len(header) - lines]), rows_of_numbers(source, places, columns, single), places
    )


def _after_the_headers_own(lines: Sequence[str], start: int) -> int:
    """Skip rows of numbers that belong to the header, since words follow them."""
    own = 0
    for i in range(start, min(len(lines), _HEADER_LINES)):
        if not lines[i].strip():
            continue
        if numbers_of(lines[i]):
            own += 1
        elif own > _OWN_ROWS or any(is_number(field) for field in split_row(lines[i])):
            # A line that is half numbers is a damaged row, not a header.
            break
        else:
            following = find_first_row(lines[i:])
            if following is None:
                break
            start, own = i + following, 0
    return start


def _before_end_marks(lines: Sequence[str], start: int) -> int:
    """Give the index after the last row: below it may stand a few lines of words, such as END."""
    end = len(lines)
    for _ in range(_END_MARKS + 1):
        while end > start + 1 and not lines[end - 1].strip():
            end -= 1
        if end <= start + 1 or re.search(r"\d|nan|inf", lines[end - 1], re.IGNORECASE):
            return end
        end -= 1
    return len(lines)


def _single_decimal_commas(lines: Iterable[str]) -> bool:
    """Tell whether every line is one number with a decimal comma: "0,0123", so that the comma separates nothing."""
    any_line = signed = False
    for line in lines:
        text = line.strip()
        if not DECIMAL_COMMA.fullmatch(text):
            return False
        any_line, signed = True, signed or text[0] == "-"
    return any_line and signed


def _column_names(header: Sequence[str], columns: int) -> tuple[tuple[str, ...], tuple[str, ...], int]:
    """Give names and units of the columns from the lines just above them, and how many lines these are."""
    if not header:
        return (), (), 0
    cells = _CELL.findall(header[-1])
    # "El Centro (1940)" is a title; brackets without a letter hold no unit.
    if len(cells) == columns and all(any(c.isalpha() for c in unit) for _, unit in cells):
        return tuple(name.strip() for name, _ in cells), tuple(unit.strip() for _, unit in cells), 1
    if columns == 1:
        return (), (), 0
    names, units = [], []
    above = [split_row(line) for line in header[-2:]]
    two = len(above) == 2 and all(len(row) == columns for row in above)
    if two and not any(map(is_number, above[0] + above[1])) and any(map(is_column_word, above[0])):
        return tuple(cell.strip('"') for cell in above[0]), tuple(cell.strip('"()[] ') for cell in above[1]), 2
    for cell in above[-1]:
        match = _BRACKETS.match(cell.strip('" '))
        names.append(match["name"].strip() if match else cell.strip('" '))
        units.append(match["unit"].strip() if match else "")
    # Two words above two columns may as well be a title: names without units must be known ones.
    named = any(units) or all(map(is_column_word, names)) or is_time_word(names[0])
    if len(names) != columns or any(is_number(name) for name in names) or not named:
        return (), (), 0
    return tuple(names), tuple(units), 1


def _refuse_damaged_first_row(source: SourceFile, start: int, columns: int) -> None:
    """Refuse a line of data that passes for a header because one of its fields is damaged."""
    if start == 0:
        return
    fields = split_row(source.lines[start - 1])
    numeric = [is_number(field) for field in fields]
    if len(fields) == columns and any(numeric) and not all(numeric):
        number(fields[numeric.index(False)], source.at(start - 1))


def _refuse_cut_number(source: SourceFile, places: Sequence[int]) -> None:
    """Refuse a file that ends within a number: no line end, and fewer decimals than every number above has."""
    if len(places) < 6 or places[-1] != len(source.lines) - 1:
        return
    decimals = [len(re.split(r"[.,]", split_row(source.lines[i])[-1])[-1]) for i in (*places[-50:],)]
    if len(set(decimals[:-1])) == 1 and decimals[-1] < decimals[0]:
        raise InputError(
            f"{source.at(places[-1])}: the last number is cut off; the record is truncated, fetch it again"
        )
