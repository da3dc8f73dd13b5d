"""What stands below a text table: words, totals and empty lines of a spreadsheet, found from the end of the file."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path

from slipwise.text_encoding import decoded

#: Bytes at the end that are looked at; lines that may stand below a table, and rows of numbers behind an empty line.
_TAIL, _FOOTER, _SUMMARY = 1 << 16, 20, 5
#: Rows before an empty line that show how a table goes on.
_BEFORE = 6
_LINE = re.compile(rb"[^\r\n]*(?:\r\n|\n|\r|$)")


def find_end(
    path: Path, encoding: str, split: Callable[[str], Sequence[str]], is_row: Callable[[Sequence[str]], bool]
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
    below = [i for i in range(last + 1, len(lines)) if any(lines[i])]
    if last == len(lines) - 1 or len(below) > _FOOTER:
        return None, ()
    end = size - sum(map(len, raw[last + 1 :]))
    if not below:
        return end, ()
    first = " ".join(cell for cell in lines[below[0]] if cell)[:60]
    counted = "1 line" if len(below) == 1 else f"{len(below)} lines"
    return end, (f"{path.name}: {counted} below the table left out, beginning {first!r}",)


def _before_summary(lines: Sequence[Sequence[str]], last: int, is_row: Callable[[Sequence[str]], bool]) -> int:
    """Give the last row before a few numbers behind an empty line that do not go on where the table ended: sums.

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
