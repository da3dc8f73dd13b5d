"""CSMIP/CESMD Volume 1 (uncorrected): for each channel a header, then values at equal steps, "points at 200 pts/sec".

Older Volume 1 files hold pairs of time and acceleration in g/10 as they were digitized from film, at uneven times, and
Volume 3 files hold spectra: both are refused by name. Source: the files' own headers.
"""

import re

from slipwise.errors import InputError
from slipwise.motion.formats.csmip_channel import Values, channel_of, channel_trace, stated_peak
from slipwise.motion.source_file import SourceFile, number, positive
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace

_START = re.compile(r"^\s*uncorrected accelerogram data", re.IGNORECASE)
_DATA = re.compile(
    r"^\s*(?P<count>\d{1,9})\s+accelerogram\s+points\s+at\s+(?P<rate>[\d.]+)\s*pts/sec\s+in\s+units\s+of\s+"
    r"(?P<unit>\S+?)\s*\.?\s+format:\s*\(\s*(?P<per_line>\d{1,2})f(?P<width>\d{1,2})\.\d+\s*\)",
    re.IGNORECASE,
)
_PEAK = re.compile(r"max\s*=\s*(-?[\d.]+)\s*(\S+?)\s*,\s*at\s+([\d.]+)\s*sec", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether the first line is that of an uncorrected CSMIP channel."""
    return head.lstrip().lower().startswith(b"uncorrected accelerogram data")


def recognise_spectra(head: bytes) -> bool:
    """Return whether the first line is that of a Volume 3 file."""
    return head.lstrip().lower().startswith(b"response and fourier amplitude spectra")


def refuse_spectra(source: SourceFile, given: Given) -> list[Trace]:
    """Refuse a Volume 3 file.

    Raises:
        InputError: always.
    """
    raise InputError(
        f"{source.name}: this is a Volume 3 file: response and Fourier spectra, no motion; "
        "take the V2 file (corrected acceleration) of the same record"
    )


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every channel of a file.

    Raises:
        InputError: pairs digitized from film, a header line that is missing or odd, or a block that is incomplete.
        UnitError: the unit is none of acceleration.
    """
    starts = [i for i, line in enumerate(source.lines) if _START.match(line)]
    return [
        _channel(source, given, start, end) for start, end in zip(starts, [*starts[1:], len(source.lines)], strict=True)
    ]


def _channel(source: SourceFile, given: Given, start: int, end: int) -> Trace:
    """Read the channel whose header starts at a line."""
    at, match = next(((i, m) for i in range(start, end) if (m := _DATA.match(source.lines[i]))), (start, None))
    if match is None:
        raise InputError(
            f"{source.name}: this is an uncorrected accelerogram (Volume 1) as it was digitized, with times of its "
            "own; take the V2 file (corrected acceleration at equal steps) of the same record"
        )
    chan = channel_of(source, start, at)
    rate = positive(number(match["rate"], source.at(at)), source.at(at), "the sampling rate")
    data = Values(at, int(match["count"]), 1.0 / rate, match["unit"], int(match["per_line"]), int(match["width"]))
    found = next((m for line in source.lines[start:at] if (m := _PEAK.search(line))), None)
    peak = stated_peak(found[1], found[2], found[3], source.at(start)) if found else None
    title = " ".join(source.lines[i].strip() for i in (start + 5, start + 1) if i < at)
    return channel_trace(source, given, start, chan, data, peak, title, "V1 (uncorrected)")
