"""Write finished results: JSON for programs, pages and drafts for people; each is there whole or not at all."""

from pathlib import Path

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
