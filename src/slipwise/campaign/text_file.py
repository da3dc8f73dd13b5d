"""Text tables: comma, semicolon or tab; decimal point or comma; loggers' encodings; lines above the header."""

import codecs
import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv as pa_csv
from numpy.typing import NDArray

from slipwise.errors import InputError

Array = NDArray[np.float64]
#: Bytes that are looked at to find out how a file is written.
_HEAD = 1 << 16
#: Lines above the header that are tolerated.
_PREAMBLE = 60
_NUMBER = re.compile(r"^[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?$")
_MISSING = ("", "nan", "NaN", "NAN", "na", "NA", "N/A", "#N/A", "-", "--", "null", "inf", "-inf", "Inf", "-Inf", "+Inf")


@dataclass(frozen=True)
class TextLayout:
    """How a text table is written.

    Attributes:
        headers: of all columns; "name [unit]" where the units stand in a row of their own.
        encoding: Python's name.
        delimiter: between columns.
        decimal: "." or ",".
        skip: lines above the first row of numbers.
    """

    headers: tuple[str, ...]
    encoding: str
    delimiter: str
    decimal: str
    skip: int


def inspect_text(path: Path) -> TextLayout:
    """Find out how a text table is written.

    Raises:
        InputError: an empty file, or no line of column names above rows of numbers.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD)
    if not head.strip(b"\x00\r\n\t ;,"):
        raise InputError(f"{path}: the file is empty")
    encoding = _encoding(head)
    text = codecs.getincrementaldecoder(encoding)("replace").decode(head).lstrip("\ufeff")
    lines = re.split(r"\r\n|\n|\r", text)
    if len(head) == _HEAD:
        lines = lines[:-1]
    for delimiter in ("\t", ";", ","):
        for i, line in enumerate(lines[:_PREAMBLE]):
            names = _split(line, delimiter)
            first = _next_row(lines, i)
            if len(names) < 2 or first is None or _looks_numeric(names) or not any(n.strip() for n in names):
                continue
            row = _split(lines[first], delimiter)
            units: list[str] = []
            if len(row) == len(names) and not _looks_numeric(row):
                following = _next_row(lines, first)
                if following is not None:
                    units, first = row, following
                    row = _split(lines[first], delimiter)
            if len(row) != len(names) or not _looks_numeric(row):
                continue
            decimal = "," if _decimal_comma(lines[first:], delimiter) else "."
            return TextLayout(_headers(names, units), encoding, delimiter, decimal, first)
    if _looks_numeric(re.split(r"[\s;,]+", lines[0].strip())):
        raise InputError(f"{path}: the first line holds numbers; a line of column names is needed above them")
    raise InputError(
        f"{path}: no line of column names above rows of numbers was found in its first lines; "
        "columns must be separated by comma, semicolon or tab"
    )


def read_text_columns(path: Path, layout: TextLayout, wanted: Sequence[int]) -> list[Array]:
    """Read columns by number, each (n,); an empty or NaN cell becomes NaN.

    Raises:
        InputError: a row with another number of columns, or a cell that is no number; the message says where.
    """
    # Columns are numbered: headers may be doubled among the columns that nobody asks for.
    names = [str(i) for i in range(len(layout.headers))]
    chosen = [names[i] for i in wanted]
    bad: list[str] = []

    def ragged(row: pa_csv.InvalidRow) -> str:
        if row.text is not None and not row.text.strip(layout.delimiter + " \t\x1a\x00"):
            return "skip"
        bad.append(f"a row with {row.actual_columns} columns where the header has {row.expected_columns}: {row.text!r}")
        return "error"

    try:
        table = pa_csv.read_csv(
            path,
            read_options=pa_csv.ReadOptions(column_names=names, skip_rows=layout.skip, encoding=layout.encoding),
            parse_options=pa_csv.ParseOptions(delimiter=layout.delimiter, invalid_row_handler=ragged),
            convert_options=pa_csv.ConvertOptions(
                column_types={name: pa.float64() for name in chosen},
                include_columns=chosen,
                null_values=list(_MISSING),
                decimal_point=layout.decimal,
                strings_can_be_null=True,
            ),
        )
    except (pa.ArrowInvalid, UnicodeDecodeError) as error:
        raise InputError(f"{path.name}: {bad[0] if bad else _cell_error(str(error), layout)}") from None
    return [np.asarray(table.column(name).to_numpy(), dtype=float) for name in chosen]


def _cell_error(message: str, layout: TextLayout) -> str:
    """Say in which column pyarrow met something that is no number."""
    found = re.search(r"In CSV column #(\d+): (?:Row #(\d+): )?(.*)", message)
    if found is None:
        return message
    column, row, words = found.groups()
    where = f"column {layout.headers[int(column)]!r}" + (f", row {row}" if row else "")
    return f"{where}: {words.replace('CSV conversion error to double: ', '')}"


def _encoding(head: bytes) -> str:
    for mark, name in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if head.startswith(mark):
            return name
    zeros = head[:400].count(0)
    if zeros > len(head[:400]) // 4:
        return "utf-16-le" if head[1:2] == b"\x00" else "utf-16-be"
    # the last bytes may hold half a character
    for cut in range(4):
        try:
            head[: len(head) - cut].decode("utf-8")
            return "utf-8"
        except UnicodeDecodeError:
            continue
    for cut in range(2):
        try:
            text = head[: len(head) - cut].decode("cp932")
        except UnicodeDecodeError:
            continue
        # Half-width katakana alone may be Latin-1 signs such as a degree or a micro: real Japanese has wide characters.
        if sum("\u3040" <= c <= "\u9fff" for c in text) >= 2:
            return "cp932"
    return "latin-1"


def _split(line: str, delimiter: str) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]


def _next_row(lines: Sequence[str], i: int) -> int | None:
    return next((k for k in range(i + 1, len(lines)) if lines[k].strip()), None)


def _looks_numeric(cells: Sequence[str]) -> bool:
    """Tell whether a line holds data: most cells are numbers or empty, and at least one is a number."""
    numbers = sum(bool(_NUMBER.match(cell)) for cell in cells)
    return numbers > 0 and numbers + sum(cell in _MISSING for cell in cells) >= 0.5 * len(cells)


def _decimal_comma(lines: Sequence[str], delimiter: str) -> bool:
    cells = [cell for line in lines[:200] for cell in _split(line, delimiter)]
    commas = sum("," in cell and bool(_NUMBER.match(cell)) for cell in cells)
    points = sum("." in cell and bool(_NUMBER.match(cell)) for cell in cells)
    return commas > points


def _headers(names: Sequence[str], units: Sequence[str]) -> tuple[str, ...]:
    cleaned = [name.lstrip("#% ").strip() if i == 0 else name for i, name in enumerate(names)]
    if not units:
        return tuple(cleaned)
    joined = []
    for name, unit in zip(cleaned, units, strict=True):
        bare = unit.strip().strip("[]()")
        joined.append(f"{name} [{bare}]" if bare and "[" not in name else name)
    return tuple(joined)
