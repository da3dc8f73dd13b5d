"""Write finished results: JSON and CSV for programs, pages and drafts for people; each is there whole or not at all."""

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from slipwise.record import write_json, write_text


def save_json(content: object, path: Path) -> Path:
    """Write plain data as JSON.

    Args:
        content: what a result's `as_json()` gives.
        path: of the file; its folder is made.
    """
    write_json(path, content)
    return path


def save_page(text: str, path: Path) -> Path:
    """Write the text of a page.

    Args:
        text: what `diagnosis_page` and its like give.
        path: of the file; its folder is made.
    """
    write_text(path, text)
    return path


def save_rows(rows: Sequence[Mapping[str, Any]], path: Path) -> Path:
    """Write rows as CSV; a column is every key that a row has, and what a row lacks or does not know stays empty.

    Args:
        rows: of a table.
        path: of the file; its folder is made.
    """
    text = io.StringIO()
    writer = csv.DictWriter(text, list(dict.fromkeys(key for row in rows for key in row)), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())
    return path
