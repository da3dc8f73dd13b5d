"""Write tables as a workbook (.xlsx) by the optional openpyxl, whole or not at all."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from slipwise.errors import missing_library, visible
from slipwise.jobs.atomic_write import atomic

#: Widest column [letters].
_WIDEST = 60


def save_workbook(sheets: Mapping[str, Sequence[Mapping[str, Any]]], path: Path) -> Path:
    """Write one sheet for each table: headings in bold that stay in view, numbers as numbers.

    Args:
        sheets: name -> rows; a column is every key that a row has. A table without rows makes no sheet.
        path: of the file; its folder is made.

    Raises:
        InputError: openpyxl is not installed.
    """
    try:
        from openpyxl import Workbook
        from openpyxl.styles import Alignment, Font
        from openpyxl.utils import get_column_letter
    except ModuleNotFoundError:
        raise missing_library(path.name, "workbooks", "openpyxl", "excel", "take the CSV file beside") from None
    book = Workbook()
    book.remove(book.worksheets[0])
    for name, rows in sheets.items():
        if not rows:
            continue
        sheet = book.create_sheet(name)
        columns = list(dict.fromkeys(key for row in rows for key in row))
        sheet.append(columns)
        for row in rows:
            sheet.append([_cell(row.get(key)) for key in columns])
        for number, key in enumerate(columns, start=1):
            head = sheet.cell(1, number)
            head.font, head.alignment = Font(bold=True), Alignment(wrap_text=True, vertical="top")
            longest = max((len(str(row[key])) for row in rows if isinstance(row.get(key), str)), default=0)
            sheet.column_dimensions[get_column_letter(number)].width = min(max(14, longest + 2), _WIDEST)
        sheet.freeze_panes = "A2"
    with atomic(path) as stream:
        book.save(stream)
    return path


def _cell(value: Any) -> Any:
    """Return a value as a cell takes it; text that begins like a formula stays text."""
    if isinstance(value, str):
        return f"'{visible(value)}" if value.startswith(("=", "+", "@")) else visible(value)
    return value
