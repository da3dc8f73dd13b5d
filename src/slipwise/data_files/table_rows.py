"""Which lines of a text are rows of its table, where plain reading does not tell: several tables, and what is below.

MTS writes names and units again above every block of one test; loggers put one table below the other. Below the last
row words, totals and the empty lines of a spreadsheet may stand.
"""

import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from slipwise.errors import InputError
from slipwise.text_encoding import decoded

IsRow = Callable[[Sequence[str]], bool]
#: Bytes at the end that are looked at; lines that may stand below a table, and rows of numbers behind an empty line.
_TAIL, _FOOTER, _SUMMARY = 1 << 16, 20, 5
#: Rows before an empty line that show how a table goes on.
_BEFORE = 6
_LINE = re.compile(rb"[^\r\n]*(?:\r\n|\n|\r|$)")
_ROW = re.compile(r"^\s*\"?[-+.,\d]")


@dataclass(frozen=True)
class RowBlock:
    """Rows of one table of a file.

    Attributes:
        line: number of its first row in the file, from 1.
        rows: how many.
        text: the rows.
    """

    line: int
    rows: int
    text: str


def find_end(
    path: Path, encoding: str, split: Callable[[str], Sequence[str]], is_row: IsRow
) -> tuple[int | None, tuple[str, ...]]:
    """Find the last row of a table.

    Args:
        path: the file.
        encoding: Python's name.
        split: gives the cells of a line.
        is_row: tells whether a line is meant as a row.

    Returns:
        How many bytes there are down to the end of the last row, None where nothing stands below it or more than what
        is known to stand there, and what is left out, in words.
    """
    size = path.stat().st_size
    if encoding.startswith("utf-16"):  # a line's end is two bytes; its readers find the rows in the whole text
        return None, ()
    with path.open("rb") as stream:
        stream.seek(max(0, size - _TAIL))
        tail = stream.read()
    raw = [line for line in _LINE.findall(tail) if line]
    if size > _TAIL:
        raw = raw[1:]  # it may have begun before
    lines = [split(decoded(line).strip("\r\n\x00\x1a")) for line in raw]
    last = next((i for i in reversed(range(len(lines))) if is_row(lines[i])), None)
    if last is None:
        return None, ()
    last = _before_summary(lines, last, is_row)
    below = lines[last + 1 :]
    if not below or sum(map(any, below)) > _FOOTER:
        return None, ()
    return size - sum(map(len, raw[last + 1 :])), left_out_below(path.name, below)


def left_out_below(name: str, below: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Say which lines below a table are left out; nothing where all are empty.

    Args:
        name: of the file, for the note.
        below: the cells of the lines.
    """
    filled = [[cell for cell in cells if cell] for cells in below if any(cells)]
    if not filled:
        return ()
    counted = "1 line below the table is" if len(filled) == 1 else f"{len(filled)} lines below the table are"
    return (f"{name}: {counted} left out, beginning {' '.join(filled[0])[:60]!r}",)


def _before_summary(lines: Sequence[Sequence[str]], last: int, is_row: IsRow) -> int:
    """Return the last row before a few numbers behind an empty line that do not go on where the table ended: sums.

    They begin with another number than the next row would, or stand below words in another number of columns.
    """
    blank = next((i for i in range(last, max(-1, last - _SUMMARY - 1), -1) if not any(lines[i])), None)
    if blank is None:
        return last
    before = [i for i in range(blank) if is_row(lines[i])][-_BEFORE:]
    if before and not is_row(lines[blank + 1]) and len(lines[last]) != len(lines[before[-1]]):
        return before[-1]
    values = [_first_number(lines[i]) for i in [*before, blank + 1]]
    numbers = [value for value in values if value is not None]
    if len(before) < _BEFORE or len(numbers) < len(values):
        return last
    steps = [b - a for a, b in zip(numbers[:-2], numbers[1:-1], strict=True)]
    goes_on = min(steps) - abs(min(steps)) <= numbers[-1] - numbers[-2] <= max(steps) + abs(max(steps))
    return last if goes_on else before[-1]


def _first_number(cells: Sequence[str]) -> float | None:
    try:
        return float(next(cell for cell in cells if cell).replace(",", "."))
    except (ValueError, StopIteration):
        return None


def read_blocks(name: str, text: str, names: str, delimiter: str, width: int, skip: int) -> list[RowBlock]:
    """Cut a file at its repeated headers.

    Args:
        name: of the file, for messages.
        text: of the file.
        names: its line of column names, as it stands there.
        delimiter: between columns.
        width: number of columns.
        skip: lines above the first row.

    Raises:
        InputError: a line that is neither a row nor part of a header, or a second table with other columns.
    """
    blocks: list[RowBlock] = []
    first, rows = skip + 1, []
    others: list[tuple[int, str]] = []
    for number, line in enumerate(io.StringIO(text, newline=None), 1):
        if number <= skip or not line.strip(f"{delimiter} \t\n\x00\x1a"):
            continue
        if not _ROW.match(line) or _columns(line, delimiter) != width:
            others.append((number, line.rstrip("\n")))
            continue
        if others:
            _check_header(name, others, names, delimiter, width)
            blocks += [RowBlock(first, len(rows), "".join(rows))] if rows else []
            first, rows, others = number, [], []
        rows.append(line)
    blocks += [RowBlock(first, len(rows), "".join(rows))] if rows else []
    for number, line in others:
        if _ROW.match(line):  # what stands below the last row has words
            raise _wrong_width(name, number, line, delimiter, width)
    if len(others) > _FOOTER:
        raise InputError(f"{name}, line {others[0][0]}: {len(others)} lines of words below the table; cut them off")
    return blocks


def _columns(line: str, delimiter: str) -> int:
    """Count the columns of a line; in quotes the delimiter may be a decimal comma."""
    return re.sub(r'"[^"]*"', "", line).count(delimiter) + 1


def _check_header(name: str, lines: Sequence[tuple[int, str]], names: str, delimiter: str, width: int) -> None:
    """Refuse lines between two rows that do not repeat the header."""
    if any(line.strip() == names.strip() for _, line in lines):
        return
    number, line = lines[0]
    if len(lines) == 1 and any(character.isdigit() for character in line):
        raise _wrong_width(name, number, line, delimiter, width)
    raise InputError(
        f"{name}, line {number}: another table begins here, {line[:60]!r}; only tables with the same header are "
        "read from one file: cut the file there"
    )


def _wrong_width(name: str, number: int, line: str, delimiter: str, width: int) -> InputError:
    return InputError(
        f"{name}, line {number}: a row with {line.count(delimiter) + 1} columns where the header has {width}: "
        f"{line[:80]!r}"
    )
