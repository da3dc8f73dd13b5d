"""A text file as a reader gets it: decoded, cut into lines, its hash kept; and its numbers, each with its place."""

import hashlib
import math
import re
import warnings
from dataclasses import dataclass, field, replace
from pathlib import Path

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.input_file import read_input
from slipwise.text_encoding import decoded

#: How much of a file the recognition of its format sees.
HEAD_BYTES = 4096
#: Beyond this a number in a file is damage, and its square would overflow.
LARGEST = 1e30
#: A record is short by a few values if it lacks no more than this many, or this share of them.
_FEW, _FEW_OF = 20, 0.01
#: Fortran writes double precision with a D: 1.5D-03.
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")
FORTRAN = str.maketrans("dD", "ee")


@dataclass(frozen=True)
class SourceFile:
    """One file of a motion.

    Attributes:
        name: the file's name, for messages and provenance.
        stem: the same without its suffix.
        sha256: of the file's bytes.
        head: its first characters, as UTF-8 without a byte-order mark; of a file that is no text its first bytes.
        lines: the decoded lines, without their ends; none of a file that is no text.
        data: its bytes, kept of a file that is no text.
        path: where it stands, None of bytes that are in memory only.
    """

    name: str
    stem: str
    sha256: str
    head: bytes
    lines: tuple[str, ...]
    data: bytes = field(default=b"", repr=False)
    path: Path | None = None

    def at(self, index: int) -> str:
        """Return "name, line 5" for the line with index 4."""
        return f"{self.name}, line {index + 1}"


def open_source(path: Path) -> SourceFile:
    """Read a file.

    Raises:
        InputError: no such file, a folder, unreadable or empty.
    """
    if path.is_dir():
        raise InputError(f"{path}: this is a folder; name the motion's files one by one")
    try:
        data = read_input(path, pipe=True)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; give the path of a motion file or `sine:2Hz,0.3g`") from None
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read ({error})") from None
    return replace(source_of(path.name, path.stem, data), path=path)


def source_of(name: str, stem: str, data: bytes) -> SourceFile:
    """Decode a file's bytes; NUL bytes that pad its end are left out.

    Raises:
        InputError: nothing in it.
    """
    if not data.removeprefix(b"\xef\xbb\xbf").strip(b"\r\n\t \x1a\x00"):
        raise InputError(f"{name}: the file is empty; fetch or export it again")
    digest = hashlib.sha256(data).hexdigest()
    text = decoded(data).rstrip("\x1a\x00")
    if "\x00" in text:
        return SourceFile(name, stem, digest, data[:HEAD_BYTES], (), data)
    # Some files end their lines with CR CR LF, some end with a row of Ctrl-Z: neither may count as a line.
    ends = "\n" if "\n" in text else "\r"
    lines = tuple(line.rstrip("\r") for line in text.split(ends))
    return SourceFile(name, stem, digest, text[:HEAD_BYTES].encode("utf-8", "replace"), lines)


def number(text: str, place: str) -> float:
    """Return a number of a file.

    Args:
        text: as it stands in the file.
        place: where, as `SourceFile.at` says it.

    Raises:
        InputError: no number, not finite, or beyond all reason.
    """
    stripped = text.strip()
    # float() would also take "1_000", "nan" and "infinity".
    if _NUMBER.fullmatch(stripped):
        value = float(stripped.translate(FORTRAN))
        if abs(value) < LARGEST:
            return value
        raise InputError(f"{place}: {stripped[:40]!r} is too large to be a measurement; the file is damaged")
    if stripped.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise InputError(f"{place}: the value is {stripped}; fill or cut the gap, a table cannot follow it")
    raise InputError(f"{place}: {text[:40]!r} is not a number; the file is damaged or of another format")


def is_number(text: str) -> bool:
    """Return whether a field is meant as a number, be it NaN."""
    return bool(_NUMBER.fullmatch(text)) or text.lower().lstrip("+-") in ("nan", "inf", "infinity")


def blank_separated(source: SourceFile, start: int, count: int, stated_by: str, short: bool) -> list[float]:
    """Read numbers that stand between blanks, from a line to the end of the file.

    Args:
        source: the file.
        start: index of the first line.
        count: how many the header states.
        stated_by: the header's words for it, for the message.
        short: whether a few less are taken.

    Raises:
        InputError: something that is no number, or another count than stated.
    """
    end = _end_of_values(source, start)
    values = [number(field, source.at(i)) for i in range(start, end) for field in _fields(source.lines[i])]
    check_count(len(values), count, source, stated_by, short)
    _check_last_number(source, start, end)
    return values


def _fields(line: str) -> list[str]:
    """Cut a line at blanks and commas, and before a sign where two numbers of a fixed width touch."""
    return re.sub(r"(?<=[\d.])(?=[+-])", " ", line.replace(",", " ")).split()


def _end_of_values(source: SourceFile, start: int) -> int:
    """Return the index after the last line with a digit: a mark such as END or / may stand below."""
    end = len(source.lines)
    while end > start and not re.search(r"\d|nan|inf", source.lines[end - 1], re.IGNORECASE):
        end -= 1
    return end


def _check_last_number(source: SourceFile, start: int, end: int) -> None:
    """Refuse a last number that was cut in the middle: it counts as one, but is another number.

    Right-aligned columns tell it: in the last line, too, the last number must end where its column ends.
    """
    filled = [i for i in range(start, end) if source.lines[i].strip()]
    if not filled:
        return
    fields = [[match.end() for match in re.finditer(r"\S+", source.lines[i])] for i in (*filled[:5], filled[-1])]
    *above, last = fields
    column = len(last) - 1
    ends = {ends[column] for ends in above if len(ends) > column}
    if len(filled) > 5 and len(ends) == 1 and last[column] < min(ends):
        raise InputError(
            f"{source.at(filled[-1])}: the last number is cut off; the record is truncated, fetch it again"
        )


def check_count(found: int, stated: int, source: SourceFile, stated_by: str, short: bool) -> None:
    """Refuse a record that holds another number of values than its header states.

    Args:
        found: how many there are.
        stated: how many the header promises.
        source: the file.
        stated_by: the header's words for it, for the message.
        short: whether a few less are taken, with a warning.

    Raises:
        InputError: it does.
    """
    if stated < 2:
        raise InputError(f"{source.name}: {stated_by} promises {stated} values; that is no record")
    if found < stated:
        words = f"{source.name}: the record is truncated: {stated_by} promises {stated} values, {found} are there"
        few = stated - found <= max(_FEW, _FEW_OF * stated)
        if not few or not short:
            raise InputError(f"{words}; fetch the file again{', or take it with --allow-short' if few else ''}")
        warnings.warn(f"{words}; taken as it is", SlipwiseWarning, stacklevel=3)
    if found > stated:
        raise InputError(
            f"{source.name}: {stated_by} promises {stated} values, but {found} are there; "
            "the header or the data are of another record"
        )


def header_field(source: SourceFile, pattern: str, start: int, end: int, what: str) -> tuple[re.Match[str], int]:
    """Find a header line by a regular expression (case does not matter).

    Args:
        source: the file.
        pattern: what to search for.
        start: index of the first line to look at.
        end: index after the last.
        what: what the line states, for the message.

    Returns:
        The match and the index of its line.

    Raises:
        InputError: no line holds it.
    """
    for i in range(start, min(end, len(source.lines))):
        match = re.search(pattern, source.lines[i], re.IGNORECASE)
        if match:
            return match, i
    raise InputError(f"{source.name}: the header does not state {what}; the file is damaged or of another format")


def positive(value: float, place: str, what: str) -> float:
    """Refuse zero and negative values of what must be positive.

    Raises:
        InputError: it is not positive.
    """
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{place}: {what} is {value:g}; it must be positive")
    return value
