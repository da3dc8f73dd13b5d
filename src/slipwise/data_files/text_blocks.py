"""Text tables that plain reading does not take: repeated headers, several tables, a footer, typographic minus signs.

MTS writes names and units again above every block of one test; loggers put one table below the other.
"""

import io
import re
from collections.abc import Iterable
from dataclasses import dataclass

from slipwise.errors import InputError

_ROW = re.compile(r"^\s*\"?[-+.,\d]")
#: Lines of words below the table that are no table of their own.
_FOOTER = 20


@dataclass(frozen=True)
class Block:
    """Rows of one table of a file.

    Attributes:
        line: number of its first row in the file, from 1.
        rows: how many.
        text: the rows, UTF-8.
    """

    line: int
    rows: int
    text: bytes


def read_blocks(name: str, text: str, names: str, delimiter: str, width: int, skip: int) -> list[Block]:
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
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    blocks: list[Block] = []
    strange: list[tuple[int, str]] = []
    out, first, rows = io.BytesIO(), skip + 1, 0

    def closed() -> None:
        nonlocal out, rows
        if rows:
            blocks.append(Block(first, rows, out.getvalue()))
        out, rows = io.BytesIO(), 0

    for number, line in enumerate(io.StringIO(text), 1):
        if number <= skip or not line.strip(f"{delimiter} \t\n\x00\x1a"):
            continue
        if not _ROW.match(line) or _columns(line, delimiter) != width:
            strange.append((number, line.rstrip("\n")))
            continue
        if strange:
            _check_header(name, strange, names, delimiter)
            closed()
            strange, first = [], number
        out.write(line.encode())
        rows += 1
    closed()
    _check_footer(name, strange, delimiter, width)
    return blocks


def _columns(line: str, delimiter: str) -> int:
    """Count the columns of a line; in quotes the delimiter may be a decimal comma."""
    if '"' in line:
        line = re.sub(r'"[^"]*"', "", line)
    return line.rstrip("\r\n").count(delimiter) + 1


def _check_header(name: str, lines: Iterable[tuple[int, str]], names: str, delimiter: str) -> None:
    """Refuse lines between two rows that do not repeat the header."""
    listed = list(lines)
    if any(line.strip() == names.strip() for _, line in listed):
        return
    number, line = listed[0]
    if len(listed) == 1 and any(character.isdigit() for character in line):
        found = line.count(delimiter) + 1
        raise InputError(
            f"{name}, line {number}: a row with {found} columns where the header has "
            f"{names.count(delimiter) + 1}: {line[:80]!r}"
        )
    raise InputError(
        f"{name}, line {number}: another table begins here, {line[:60]!r}; only tables with the same header are "
        "read from one file: cut the file there"
    )


def _check_footer(name: str, lines: list[tuple[int, str]], delimiter: str, width: int) -> None:
    """Refuse lines below the last row that may be rows: a footer has words."""
    for number, line in lines:
        if _ROW.match(line):
            raise InputError(
                f"{name}, line {number}: a row with {line.count(delimiter) + 1} columns where the header has "
                f"{width}: {line[:80]!r}"
            )
    if len(lines) > _FOOTER:
        raise InputError(f"{name}, line {lines[0][0]}: {len(lines)} lines of words below the table; cut them off")
