"""Lines of numbers: cut at their separators, decimal commas or points; many lines alike are read at once."""

import csv
import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.motion.source_file import FORTRAN, LARGEST, SourceFile, is_number, number

Array = NDArray[np.float64]
DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+(?:[eEdD][+-]?\d+)?")
#: Lines that are read at once.
_BLOCK = 20_000
_PLAIN = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?"


def split_row(line: str) -> list[str]:
    """Cut a line at its commas, semicolons or tabs, or at blanks where there is none of these; quotes are left out."""
    text = line.strip()
    if '"' in text:
        for separator in ("\t", ";", ","):
            fields = [field.strip() for field in next(csv.reader([text], delimiter=separator), [])]
            if len(fields) > 1:
                return fields
        text = text.replace('"', "")
    separators = (";", "\t", ",") if _has_decimal_commas(text) else (",", ";", "\t")
    for separator in separators:
        if separator in text and not (separator == "," and _has_decimal_commas(text)):
            fields = [field.strip() for field in text.split(separator)]
            return fields[:-1] if fields[-1] == "" else fields
    return text.split()


def _has_decimal_commas(text: str) -> bool:
    """Tell whether a line is written with decimal commas: "0,01;1,5" and "0,01 1,5", but not "1,5"."""
    fields = split_row(text) if '"' in text else re.split(r"[;\t]|\s+", text.strip().rstrip(";"))
    fields = [field for field in fields if field]
    return len(fields) > 1 and "." not in text and any(DECIMAL_COMMA.fullmatch(f) for f in fields) and all(
        DECIMAL_COMMA.fullmatch(f) or is_number(f) for f in fields
    )  # fmt: skip


def numbers_of(line: str) -> list[str]:
    """Give the fields of a line that holds nothing but numbers, with decimal points; none for another line."""
    comma = _has_decimal_commas(line)
    fields = [field.replace(",", ".") if comma else field for field in split_row(line)]
    return fields if fields and all(is_number(field) for field in fields) else []


def rows_of_numbers(source: SourceFile, places: Sequence[int], columns: int, single: bool) -> Array | tuple[Array, ...]:
    """Read lines of numbers, (n, columns), or row by row where not all are of one length.

    Args:
        source: the file.
        places: of the lines.
        columns: numbers in the first line.
        single: every line is one number with a decimal comma.

    Raises:
        InputError: a field that is no number; the message says where.
    """
    blocks: list[Array | list[Array]] = []
    for k in range(0, len(places), _BLOCK):
        part = places[k : k + _BLOCK]
        alike = _alike([source.lines[i] for i in part], columns)
        blocks.append(_one_by_one(source, part, single) if alike is None else alike)
    if all(isinstance(block, np.ndarray) or all(len(row) == columns for row in block) for block in blocks):
        return np.concatenate([np.asarray(block) for block in blocks])
    return tuple(row for block in blocks for row in block)


def _alike(lines: list[str], columns: int) -> Array | None:
    """Read lines (n, columns) that are all written like the first; None where they are not."""
    first = lines[0]
    separator = next((s for s in ("\t", ";") if s in first), " ")
    if "," in first:
        if _has_decimal_commas(first):
            if any("." in line for line in lines):
                return None
            lines = [line.replace(",", ".") for line in lines]
        elif separator == " ":
            separator = ","
        else:
            return None
    between = "[ ]+" if separator == " " else f"[ ]*{separator}[ ]*"
    row = re.compile(rf"[ \t]*{_PLAIN}(?:{between}{_PLAIN}){{{columns - 1}}}[ \t]*", re.ASCII)
    if not all(map(row.fullmatch, lines)):
        return None
    mark = separator if separator in ",;" else " "
    values = np.fromstring(mark.join(lines).translate(FORTRAN), sep=mark)
    if values.size != len(lines) * columns or not np.all(np.abs(values) < LARGEST):
        return None
    return values.reshape(-1, columns)


def _one_by_one(source: SourceFile, places: Sequence[int], single: bool) -> list[Array]:
    values = []
    for i in places:
        line = source.lines[i]
        comma = single or _has_decimal_commas(line)
        fields = [line.strip()] if single else split_row(line)
        values.append(np.array([number(f.replace(",", ".") if comma else f, source.at(i)) for f in fields]))
    return values
