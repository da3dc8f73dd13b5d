"""Workbooks (.xlsx), read by the optional openpyxl: the first sheet that holds a table, or the one that is named."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date, datetime, time
from itertools import islice
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.header_rows import MISSING, Header, find_header
from slipwise.data_files.named_columns import unreadable
from slipwise.data_files.table_rows import left_out_below
from slipwise.data_files.time_stamps import seconds_of_stamps
from slipwise.errors import InputError, missing_library

_LOOK_AT = 500
#: A workbook that unpacks to more is no record of a rig [bytes].
_LARGEST = 800_000_000


@dataclass(frozen=True)
class Sheet:
    """A table of a workbook.

    Attributes:
        name: of the sheet.
        headers: of its columns.
        above: the rows above, each as one text.
        header: where it begins.
        rows: down to the first empty row, or to the sums below the table.
        notes: what is left out below, and other sheets that hold tables, in words.
    """

    name: str
    headers: tuple[str, ...]
    above: tuple[str, ...]
    header: Header
    rows: tuple[list[str], ...]
    notes: tuple[str, ...]


def inspect_sheet(path: Path, wanted: str | None) -> Sheet:
    """Find the table of a workbook.

    Args:
        path: the file.
        wanted: name or number of the sheet, None for the first that holds a table.

    Raises:
        InputError: openpyxl is not installed, no workbook, no such sheet, or no table in it.
    """
    book = _workbook(path)
    names = list(book.sheetnames)
    if wanted is not None and wanted.isdigit() and wanted not in names and 1 <= int(wanted) <= len(names):
        wanted = names[int(wanted) - 1]
    if wanted is not None and wanted not in names:
        raise InputError(f"{path}: no sheet is called {wanted!r}; it has {', '.join(names)}")
    found: list[tuple[str, Header, list[list[str]], Iterator[list[str]]]] = []
    for name in names if wanted is None else [wanted]:
        cells = _rows(book[name], path)
        rows = list(islice(cells, _LOOK_AT))
        width = max((len(row) for row in rows), default=0)
        header = find_header([_without_tail(row) for row in rows]) if width > 1 else None
        if header:
            found.append((name, header, rows, cells))
    if not found:
        raise InputError(f"{path}: no sheet holds a line of column names above rows of numbers")
    name, header, rows, cells = found[0]
    above = tuple("\t".join(cell for cell in row if cell) for row in rows[: header.line])
    rows = [*rows[header.first :], *cells]
    book.close()
    end = next((i for i, row in enumerate(rows) if not any(row)), len(rows))
    while end > 1 and not header.is_row(rows[end - 1]):
        end -= 1
    notes = left_out_below(f"{path.name}, sheet {name}", rows[end:])
    if len(found) > 1:
        others = ", ".join(other for other, *_ in found[1:])
        notes = (*notes, f"sheets {others} of {path.name} hold tables too and are not read")
    return Sheet(name, header.columns(path.name), above, header, tuple(rows[:end]), notes)


def read_sheet(file: str, sheet: Sheet, wanted: Sequence[int]) -> list[Array]:
    """Read columns by number, each (n,).

    Raises:
        InputError: a cell that is no number.
    """
    part = sheet.header.part
    columns = [[row[k] if k < len(row) else "" for row in sheet.rows] for k in wanted]
    out = []
    for column, k in zip(columns, wanted, strict=True):
        what = f"{file}, sheet {sheet.name}, column {sheet.headers[k]!r}"
        if k in sheet.header.stamps:
            seconds = seconds_of_stamps(column, what)
            out.append(seconds if part is None else seconds + [part[1] * float(row[part[0]]) for row in sheet.rows])
            continue
        try:
            out.append(np.array([np.nan if cell in MISSING else float(cell.replace(",", ".")) for cell in column]))
        except ValueError as error:
            raise InputError(f"{what}: {error}; cells below the names must be numbers") from None
    return out


def _workbook(path: Path) -> Any:
    try:
        from openpyxl import load_workbook  # type: ignore[import-untyped]
    except ModuleNotFoundError:
        raise missing_library(path, ".xlsx files", "openpyxl", "excel", "save the sheet as CSV") from None
    try:
        with ZipFile(path) as packed:
            unpacked = sum(part.file_size for part in packed.infolist())
        if unpacked > _LARGEST:
            raise InputError(
                f"{path}: this workbook unpacks to {unpacked / 1e6:.0f} MB, more than {_LARGEST / 1e6:g} MB; save the "
                "sheet of one run as CSV"
            )
        return load_workbook(path, read_only=True, data_only=True)
    except InputError:
        raise
    except Exception as error:  # zip, xml and key errors of damaged files come through as they are
        raise unreadable(path, "workbook", error, "save it again, or as CSV") from None


def _rows(sheet: Any, path: Path) -> Iterator[list[str]]:
    """Yield the rows of a sheet as texts.

    Raises:
        InputError: the sheet is damaged.
    """
    try:
        for row in sheet.iter_rows(values_only=True):
            yield [_text(cell) for cell in row]
    except Exception as error:  # rows are unpacked and parsed as they are asked for: zip, xml and value errors
        raise InputError(f"{path}: the sheet {sheet.title!r} is damaged ({error}); save it again, or as CSV") from None


def _text(cell: Any) -> str:
    if cell is None:
        return ""
    if isinstance(cell, datetime):
        return cell.isoformat(sep=" ", timespec="microseconds")
    if isinstance(cell, time):
        return cell.isoformat(timespec="microseconds")
    if isinstance(cell, date):
        return cell.isoformat()
    return repr(cell) if isinstance(cell, float) else str(cell).strip()


def _without_tail(row: Sequence[str]) -> list[str]:
    """Return the cells without the empty ones at the end, which a sheet's widest row adds to all others."""
    cells = list(row)
    while cells and not cells[-1]:
        cells.pop()
    return cells
