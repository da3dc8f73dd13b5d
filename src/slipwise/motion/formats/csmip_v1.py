"""CSMIP/CESMD Volume 1 (uncorrected): for each channel a header, then values at equal steps, "points at 200 pts/sec".

Older Volume 1 files hold pairs of time and acceleration in g/10 as they were digitized from film, at uneven times, and
Volume 3 files hold spectra: both are refused by name. Source: the files' own headers.
"""

import re

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.fixed_width import fixed_width
from slipwise.motion.formats.csmip_channel import channel_of, origin_of
from slipwise.motion.source_file import SourceFile, number, positive
from slipwise.motion.stated import Given, acceleration_factor, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, check_header_peak, half_last_digit

_START = re.compile(r"^\s*uncorrected accelerogram data", re.IGNORECASE)
_DATA = re.compile(
    r"^\s*(?P<count>\d{1,9})\s+accelerogram\s+points\s+at\s+(?P<rate>[\d.]+)\s*pts/sec\s+in\s+units\s+of\s+"
    r"(?P<unit>\S+?)\s*\.?\s+format:\s*\(\s*(?P<per_line>\d{1,2})f(?P<width>\d{1,2})\.\d+\s*\)",
    re.IGNORECASE,
)
_PEAK = re.compile(r"max\s*=\s*(-?[\d.]+)\s*(\S+?)\s*,\s*at\s+([\d.]+)\s*sec", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Tell whether the first line is that of an uncorrected CSMIP channel."""
    return head.lstrip().lower().startswith(b"uncorrected accelerogram data")


def recognise_spectra(head: bytes) -> bool:
    """Tell whether the first line is that of a Volume 3 file."""
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
    dt, dt_words = settle_step(1.0 / rate, given, source)
    factor, unit_words = settle_unit(match["unit"], given, source)
    per_line, width = int(match["per_line"]), int(match["width"])
    if not (0 < per_line <= 20 and 0 < width <= 30):
        raise InputError(f"{source.at(at)}: the format {per_line}f{width} is not possible")
    values = np.array(fixed_width(source, at + 1, int(match["count"]), per_line, width)) * factor
    peak = next((m for line in source.lines[start:at] if (m := _PEAK.search(line))), None)
    stated = None
    if peak:
        peak_factor = acceleration_factor(peak[2], source.at(start))
        size = number(peak[1], source.at(start)) * peak_factor
        stated = HeaderPeak(size, number(peak[3], source.at(start)), half_last_digit(peak[1]) * peak_factor)
        check_header_peak(values, dt, stated, source, chan.name)
    return Trace(
        source=source,
        name=chan.name,
        title=f"{source.lines[start + 5].strip()} {source.lines[start + 1].strip()}"[:80],
        dt=dt,
        acceleration=values,
        baseline="none",
        treatment=(
            f"read as CSMIP/CESMD V1 (uncorrected): {source.name}, channel {chan.name}",
            f"{unit_words}; {dt_words}",
        ),
        header_peak=stated,
        origin=origin_of(source, start, at, chan.place),
        aliases=chan.aliases,
    )
