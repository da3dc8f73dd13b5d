"""Which format a file has, told from its content and never from its name."""

from pathlib import Path

from slipwise.errors import InputError
from slipwise.motion.formats import FORMATS, Format
from slipwise.motion.source_file import SourceFile, open_source
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace


def detect(source: SourceFile) -> Format:
    """Tell the format of a file.

    Raises:
        InputError: none of the formats that are read.
    """
    for known in FORMATS:
        if bool(source.lines) != known.binary and known.recognise(source.head):
            return known
    if not source.lines:
        raise InputError(
            f"{source.name}: this is no text file, or NUL bytes stand within it; export the motion as text, or fetch "
            f"the file again; binary ones that are read are {', '.join(f.name for f in FORMATS if f.binary)}"
        )
    raise InputError(
        f"{source.name}: the format is not known, the file begins {source.lines[0].strip()[:50]!r}; "
        f"read are {', '.join(known.name for known in FORMATS)}"
    )


def read_file(path: Path, given: Given) -> list[Trace]:
    """Read every component of a file.

    Args:
        path: the file.
        given: step and unit, for files that do not state them.

    Returns:
        The components in the file's order.

    Raises:
        InputError: missing, empty, unknown or damaged file.
        UnitError: unit missing, unknown or of the wrong dimension.
    """
    source = open_source(path)
    return detect(source).read(source, given)
