"""Text files whose lines are rows of numbers without names, below a header of any kind; decimal commas or points."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.text_file import BLANKS, DELIMITERS, split_line
from slipwise.errors import InputError
from slipwise.motion.source_file import FORTRAN, LARGEST, SourceFile, is_number, number

#: A header may hold rows of numbers of its own, no more than these, within so many lines.
_OWN_ROWS, _HEADER_LINES = 12, 200
#: Lines below the numbers that may mark the end: words, no digits.
_END_MARKS = 3
#: What may stand before the words of a header.
COMMENT_SIGNS = "#%/!*$ "
_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+(?:[eEdD][+-]?\d+)?")
#: Lines that are read at once: their texts take much more memory than their numbers.
_BLOCK = 20_000


@dataclass(frozen=True)
class Rows:
    """Rows of numbers as they stand in a file.

    Attributes:
        header: the lines above the numbers that are not empty, without comment signs.
        values: (n, columns), or the rows one by one where not all are of one length.
        places: index of the line of each row.
    """

    header: tuple[str, ...]
    values: Array | tuple[Array, ...]
    places: Sequence[int]

    def table(self, source: SourceFile) -> Array:
        """Return the values as a table (n, columns).

        Raises:
            InputError: rows of different lengths.
        """
        if isinstance(self.values, np.ndarray):
            return self.values
        return table_of_numbers(source, self.places, len(self.values[0]))

    def series(self) -> Array:
        """Return all numbers in reading order."""
        return self.values.ravel() if isinstance(self.values, np.ndarray) else np.concatenate(self.values)

    def below(self, lines: int) -> "Rows":
        """Return the rows below the first ones."""
        return replace(self, values=self.values[lines:], places=self.places[lines:])


def find_first_row(lines: Sequence[str]) -> int | None:
    """Return the index of the first line that holds nothing but numbers, None if there is none."""
    return next((i for i, line in enumerate(lines) if numbers_of(line)), None)


def read_rows(source: SourceFile) -> Rows:
    """Read the rows of numbers below a header.

    Raises:
        InputError: no numbers, a field that is no number, or a last number that is cut off.
    """
    start = find_first_row(source.lines)
    if start is None:
        raise InputError(f"{source.name}: no line of numbers is in this file; see `slipwise motions` for what is read")
    start = _after_the_headers_own(source.lines, start)
    end = _before_end_marks(source.lines, start)
    places: Sequence[int] = range(start, end)
    if not all(map(str.strip, source.lines[start:end])):
        places = [i for i in places if source.lines[i].strip()]
    header = [line.strip().lstrip(COMMENT_SIGNS).rstrip(" ,;") for line in source.lines[:start]]
    # "0,0123" in every line: the comma separates nothing.
    single = all(_DECIMAL_COMMA.fullmatch(source.lines[i].strip()) for i in places) and any(
        source.lines[i].lstrip().startswith("-") for i in places
    )
    columns = 1 if single else len(numbers_of(source.lines[start]))
    _refuse_damaged_first_row(source, start, columns)
    refuse_cut_number(source, places)
    return Rows(tuple(line for line in header if line), rows_of_numbers(source, places, single), places)


def _after_the_headers_own(lines: Sequence[str], start: int) -> int:
    """Skip rows of numbers that belong to the header, since words follow them."""
    own = 0
    for i in range(start, min(len(lines), _HEADER_LINES)):
        if not lines[i].strip():
            continue
        if numbers_of(lines[i]):
            own += 1
        elif own > _OWN_ROWS or any(map(is_number, re.split(r"[\s,;]+", lines[i]))):
            # A line that is half numbers is a damaged row, not a header.
            break
        else:
            following = find_first_row(lines[i:])
            if following is None:
                break
            start, own = i + following, 0
    return start


def _before_end_marks(lines: Sequence[str], start: int) -> int:
    """Return the index after the last row: below it may stand a few lines of words, such as END."""
    end = len(lines)
    for _ in range(_END_MARKS + 1):
        while end > start + 1 and not lines[end - 1].strip():
            end -= 1
        if end <= start + 1 or re.search(r"\d|nan|inf", lines[end - 1], re.IGNORECASE):
            return end
        end -= 1
    return len(lines)


def _refuse_damaged_first_row(source: SourceFile, start: int, columns: int) -> None:
    """Refuse a line of data that passes for a header because one of its fields is damaged."""
    if start == 0:
        return
    delimiter = _delimiter(source.lines[start])
    fields = source.lines[start - 1].strip().split(None if delimiter == BLANKS else delimiter)
    numeric = [is_number(field.strip()) for field in fields]
    # A sentence may have as many words, and a year among them.
    if len(fields) == columns and 2 * sum(numeric) >= columns and not all(numeric):
        number(fields[numeric.index(False)], source.at(start - 1))


def refuse_cut_number(source: SourceFile, places: Sequence[int]) -> None:
    """Refuse a file that ends within a number: no line end, and fewer decimals than every number above has.

    Args:
        source: the file.
        places: of its rows.

    Raises:
        InputError: it does.
    """
    if len(places) <= 5 or places[-1] != len(source.lines) - 1:
        return
    rows = (numbers_of(source.lines[i]) for i in places[-50:])
    decimals = [len(row[-1].partition(".")[2]) for row in rows if row]
    if len(set(decimals[:-1])) == 1 and decimals[-1] < decimals[0]:
        raise InputError(
            f"{source.at(places[-1])}: the last number is cut off; the record is truncated, fetch it again"
        )


def numbers_of(line: str) -> list[str]:
    """Return the fields of a line that holds nothing but numbers, with decimal points; none for another line."""
    delimiter = _delimiter(line)
    return [] if delimiter is None else [field.replace(",", ".") for field in _fields(line, delimiter)]


def _delimiter(line: str) -> str | None:
    """Tell what separates the numbers of a line; None where it holds anything else."""
    for delimiter in DELIMITERS:
        fields = _fields(line, delimiter) if delimiter in line.strip() or delimiter == BLANKS else []
        if fields and all(is_number(field) or _DECIMAL_COMMA.fullmatch(field) for field in fields):
            return delimiter
    return None


def _fields(line: str, delimiter: str) -> list[str]:
    """Cut a line; a separator may also end it."""
    if '"' in line:
        fields = split_line(line, delimiter)
    else:
        fields = line.split() if delimiter == BLANKS else [field.strip() for field in line.split(delimiter)]
    return fields[:-1] if fields and not fields[-1] else fields


def rows_of_numbers(source: SourceFile, places: Sequence[int], single: bool = False) -> Array | tuple[Array, ...]:
    """Read lines of numbers, (n, columns), or row by row where not all are of one length.

    Args:
        source: the file.
        places: of the lines; all are separated as the first one is.
        single: every line is one number with a decimal comma.

    Raises:
        InputError: a field that is no number; the message says where.
    """
    delimiter = BLANKS if single else _delimiter(source.lines[places[0]]) or BLANKS
    comma = "," if delimiter == "," else "."
    blocks: list[Array] = []
    lengths: list[int] = []
    for k in range(0, len(places), _BLOCK):
        part = places[k : k + _BLOCK]
        rows = [_fields(source.lines[i].replace(",", comma), delimiter) for i in part]
        flat = _at_once([field for row in rows for field in row])
        if flat is None or flat.size != sum(map(len, rows)):
            # Slower, and says where the damage is; another line may be separated in another way.
            rows = [numbers_of(source.lines[i]) or row for i, row in zip(part, rows, strict=True)]
            flat = np.array([number(field, source.at(i)) for i, row in zip(part, rows, strict=True) for field in row])
        blocks.append(flat)
        lengths += map(len, rows)
    values = np.concatenate(blocks)
    if len(set(lengths)) == 1:
        return values.reshape(len(lengths), -1)
    return tuple(np.split(values, np.cumsum(lengths)[:-1]))


def _at_once(fields: list[str]) -> Array | None:
    """Read many numbers, None where one of them is none or no measurement."""
    text = " ".join(fields).translate(FORTRAN)
    try:
        values = np.array(text.split(" "), dtype=np.float64)
    except ValueError:
        return None
    # float() would also take "1_000" and "infinity"
    return values if "_" not in text and bool(np.all(np.abs(values) < LARGEST)) else None


def table_of_numbers(source: SourceFile, places: Sequence[int], columns: int) -> Array:
    """Read lines of numbers as a table (n, columns); empty lines are passed over.

    Raises:
        InputError: a line with more or fewer numbers, or with something else.
    """
    filled = [i for i in places if source.lines[i].strip()]
    rows = rows_of_numbers(source, filled) if filled else np.empty((0, columns))
    for i, row in zip(filled, rows, strict=True):
        if len(row) != columns:
            raise InputError(
                f"{source.at(i)}: {len(row)} values stand where {columns} were expected; "
                "the record is truncated or damaged, fetch the file again"
            )
    return np.asarray(rows)
