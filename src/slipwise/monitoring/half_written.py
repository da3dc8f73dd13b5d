"""Whether a data file is whole, by its last bytes: a logger that still writes stops in the middle of a line."""

from pathlib import Path
from typing import Literal

from slipwise.data_files.table import TEXT_SUFFIXES

#: "open": its last line has no end and as many columns as the line before: it may be whole, or cut in its last number.
Ending = Literal["whole", "open", "cut"]
#: What stands between columns, the likelier first: where there is a tab or a semicolon, a comma is a decimal comma.
_SEPARATORS = (b"\t", b";", b",")
#: Bytes at the end of a file in which two lines of a table lie.
_TAIL = 1 << 17


def how_it_ends(path: Path) -> Ending:
    """Return how a data file ends.

    Args:
        path: of it; one that is no text table tells nothing by its end, and counts as whole.

    Raises:
        OSError: it cannot be read.
    """
    if path.suffix.lower() not in TEXT_SUFFIXES:
        return "whole"
    with path.open("rb") as stream:
        stream.seek(max(stream.seek(0, 2) - _TAIL, 0))
        tail = stream.read().replace(b"\x00", b"")  # two bytes a character, as some loggers write
    if not tail.strip():
        return "cut"
    if tail.endswith((b"\n", b"\r")):
        return "whole"
    lines = tail.splitlines()
    if len(lines) < 2:
        return "cut"
    # a name or a number may be cut as well, and nobody can see it: such a file has to stand still for longer
    last, whole = lines[-1], lines[-2]
    separator = next((mark for mark in _SEPARATORS if mark in whole), None)
    return "cut" if len(last.split(separator)) < len(whole.split(separator)) else "open"
