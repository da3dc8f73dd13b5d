"""CSMIP/CESMD Volume 2: for each channel 45 header lines, then acceleration, velocity and displacement.

Two dialects: the newer one states its Fortran format, "in cm/sec2. (8f10.5)"; the older one, in upper case, writes
"(UNITS: CM/SEC/SEC)" and its columns are 8f10.3. Columns touch. Source: the files' own headers.
"""

import re
import warnings

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion.fixed_width import lines_of
from slipwise.motion.formats.csmip_channel import Values, channel_of, channel_trace, stated_peak
from slipwise.motion.source_file import SourceFile, header_field, number
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace

_DATA = re.compile(
    r"^\s*(?P<count>\d{1,9})\s+points\s+of\s+accel\s+data\s+equally\s+spaced\s+at\s+(?P<dt>[\d.]+)\s*sec\b[.,]*\s*"
    r"(?:in|\(\s*units:)\s+(?P<unit>[^\s()]+?)[.,]?\s*\)?\s*(?:\((?P<per_line>\d{1,2})f(?P<width>\d{1,2})\.\d+\))?\s*$",
    re.IGNORECASE,
)
_START = re.compile(r"^\s*corrected accelerogram\s.*\bchan\s", re.IGNORECASE)
_END = re.compile(r"^/&.*end of data", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether the first line is that of a CSMIP channel."""
    first = head.lstrip().splitlines()[0].lower() if head.strip() else b""
    return first.startswith(b"corrected accelerogram") and b"chan" in first


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the acceleration of every channel of a file.

    Raises:
        InputError: a header line is missing or odd, a block or a channel is incomplete.
        UnitError: the unit is none of acceleration.
    """
    starts = [i for i, line in enumerate(source.lines) if _START.match(line)]
    if not starts:
        raise InputError(f"{source.at(0)}: no line 'Corrected accelerogram ... Chan 1: ...' begins a channel")
    traces = [
        _channel(source, given, start, end) for start, end in zip(starts, [*starts[1:], len(source.lines)], strict=True)
    ]
    # The count is that of the station's recorder; structures come one channel a file.
    promised = re.search(r"\(\s*(\d+)\s+Chns of", "\n".join(source.lines[:25]), re.IGNORECASE)
    if promised and 1 < len(traces) < int(promised[1]):
        warnings.warn(
            f"{source.name}: the recorder has {promised[1]} channels, {len(traces)} are in this file; if it should "
            "hold all of them, fetch it again",
            SlipwiseWarning,
            stacklevel=2,
        )
    return traces


def _channel(source: SourceFile, given: Given, start: int, end: int) -> Trace:
    """Read the channel whose header starts at a line."""
    chan = channel_of(source, start, end)
    name = chan.name
    at = next((i for i in range(start, end) if re.search(r"points\s+of\s+accel\s+data", source.lines[i], re.I)), None)
    match = None if at is None else _DATA.match(source.lines[at])
    if at is None or match is None:
        raise InputError(
            f"{source.at(start if at is None else at)}: channel {name}: the line 'N points of accel data equally "
            "spaced at ... sec, in cm/sec2' is missing or cannot be read; the file is truncated or damaged"
        )
    data = Values(
        at,
        int(match["count"]),
        number(match["dt"], source.at(at)),
        match["unit"],
        int(match["per_line"] or 8),
        int(match["width"] or 10),
    )
    pattern = r"peak acceleration\s*=\s*(-?[\d.]+)\s*(\S+)\s+at\s+([\d.]+)\s*sec"
    found, i = header_field(source, pattern, start, at, "the peak acceleration")
    station = source.lines[start + 6][:40].strip() if start + 6 < at else source.stem
    title = f"{station} {source.lines[min(start + 2, at)].strip()}"
    peak = stated_peak(found[1], found[2], found[3], source.at(i))
    trace = channel_trace(source, given, start, chan, data, peak, title, "V2")
    if not any(_END.match(line) for line in source.lines[at + lines_of(data.count, data.per_line) : end]):
        raise InputError(
            f"{source.name}: channel {name} has no 'End of data' line: the record is truncated; fetch the file again"
        )
    return trace
