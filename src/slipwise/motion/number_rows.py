"""Lines of numbers without names: cut at their separators, decimal commas or points."""

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.data_files.text_file import BLANKS, split_line
from slipwise.errors import InputError
from slipwise.motion.source_file import FORTRAN, LARGEST, SourceFile, is_number, number

Array = NDArray[np.float64]
DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+(?:[eEdD][+-]?\d+)?")
#: Lines that are read at once: their texts take much more memory than their numbers.
_BLOCK = 20_000


def numbers_of(line: str) -> list[str]:
    """Give the fields of a line that holds nothing but numbers, with decimal points; none for another line."""
    delimiter = delimiter_of(line)
    return [] if delimiter is None else [field.replace(",", ".") for field in _fields(line, delimiter)]


def delimiter_of(line: str) -> str | None:
    """Tell what separates the numbers of a line; None where it holds anything else."""
    for delimiter in ("\t", ";", ",", BLANKS):
        fields = _fields(line, delimiter) if delimiter in line.strip() or delimiter == BLANKS else []
        if fields and all(is_number(field) or DECIMAL_COMMA.fullmatch(field) for field in fields):
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
    delimiter = BLANKS if single else delimiter_of(source.lines[places[0]]) or BLANKS
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
