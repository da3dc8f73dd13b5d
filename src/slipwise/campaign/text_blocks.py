"""Text tables that plain reading does not take: repeated headers, several tables, a footer, typographic minus signs.

MTS writes names and units again above every block of one test; loggers put one table below the other.
"""

import io
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from slipwise.errors import InputError
from slipwise.input_file import read_input
from slipwise.text_encoding import decoded

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


def read_blocks(path: Path, names: str, delimiter: str, width: int, skip: int) -> list[Block]:
    """Cut a file at its repeated headers.

    Args:
        path: the file.
        names: its line of column names, as it stands there.
        delimiter: between columns.
        width: number of columns.
        skip: lines above the first row.

    Raises:
        InputError: a line that is neither a row nor part of a header, or a second table with other columns.
    """
    text = decoded(read_input(path))
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
        if not _ROW.match(line) or line.rstrip("\n").count(delimiter) != width - 1:
            strange.append((number, line.rstrip("\n")))
            continue
        if strange:
            _check_header(path, strange, names, delimiter)
            closed()
            strange, first = [], number
        out.write(line.encode())
        rows += 1
    closed()
    _check_footer(path, strange, delimiter, width)
    return blocks


def _check_header(path: Path, lines: Iterable[tuple[int, str]], names: str, delimiter: str) -> None:
    """Refuse lines between two rows that do not repeat the header."""
    listed = list(lines)
    if any(line.strip() == names.strip() for _, line in listed):
        return
    number, line = listed[0]
    if len(listed) == 1 and any(character.isdigit() for character in line):
        found = line.count(delimiter) + 1
        raise InputError(
            f"{path.name}, line {number}: a row with {found} columns where the header has "
            f"{names.count(delimiter) + 1}: {line[:80]!r}"
        )
    raise InputError(
        f"{path.name}, line {number}: another table begins here, {line[:60]!r}; only tables with the same header are "
        "read from one file: cut the file there"
    )


def _check_footer(path: Path, lines: list[tuple[int, str]], delimiter: str, width: int) -> None:
    """Refuse lines below the last row that may be rows: a footer has words."""
    for number, line in lines:
        if _ROW.match(line):
            raise InputError(
                f"{path.name}, line {number}: a row with {line.count(delimiter) + 1} columns where the header has "
                f"{width}: {line[:80]!r}"
            )
    if len(lines) > _FOOTER:
        raise InputError(f"{path.name}, line {lines[0][0]}: {len(lines)} lines of words below the table; cut them off")
