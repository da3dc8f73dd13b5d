"""GeoNet V2A and V1A (corrected and uncorrected, New Zealand): three components, each a 26-line header and its blocks.

Header: 16 lines of text, 4 lines of ten integers (10I8), 6 lines of ten numbers (10F8.0); then acceleration, velocity
and displacement, ten to a line in columns of eight that touch; V1A holds acceleration alone. Times in the header count
from the end of the samples that the processing put before the record.
Source: GNS Accelerogram Data Files, Standard Format (W. J. Cousins, 2008).
"""

import re
from datetime import datetime

import numpy as np

from slipwise.errors import InputError, UnitError
from slipwise.motion.fixed_width import fixed_width, lines_of
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, header_field, is_number, number, positive
from slipwise.motion.stated import Given, acceleration_factor, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_TEXT, _INTEGERS, _NUMBERS = 16, 4, 6
_PER_LINE, _WIDTH = 10, 8
_COMPONENTS = 3
_FIRST = re.compile(rb"(un)?corrected accelerogram")


def recognise(head: bytes) -> bool:
    """Return whether the first two lines are those of GeoNet."""
    lines = head.lstrip().lower().splitlines()[:2]
    return len(lines) == 2 and bool(_FIRST.match(lines[0])) and lines[1].startswith(b"site ")


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the acceleration of the three components of a file.

    Raises:
        InputError: a header line is missing or odd, a block or a component is incomplete.
        UnitError: the unit is none of acceleration.
    """
    traces, start = [], 0
    for _ in range(_COMPONENTS):
        trace, start = _component(source, given, start)
        traces.append(trace)
    return traces


def _component(source: SourceFile, given: Given, start: int) -> tuple[Trace, int]:
    """Read the component whose header starts at a line; give it and the line after its last block."""
    text_end = start + _TEXT
    if text_end + _INTEGERS + _NUMBERS > len(source.lines):
        raise InputError(
            f"{source.name}: the record is truncated: a header should begin at line {start + 1}, "
            f"the file ends at line {len(source.lines)}; fetch it again"
        )
    named, _ = header_field(source, r"^\s*Component\s+(\S+)", start, text_end, "the name of a component")
    name = named[1]
    pattern = r"(?:data at|at intervals of)\s+(-?[\d.]+)\s*s"
    step, i = header_field(source, pattern, start, text_end, "the step of its samples")
    dt, dt_words = settle_step(positive(number(step[1], source.at(i)), source.at(i), "the step"), given, source)
    pattern = r"^\s*Acceleration:\s*peak\s+(-?[\d.]+)\s+(\S+)\s+at\s+(-?[\d.]+)\s*s"
    peak, i = header_field(source, pattern, start, text_end, "the peak of its acceleration")
    factor, unit_words = settle_unit(peak[2], given, source)
    _check_raw_unit(source, start, text_end, factor)
    integers = fixed_width(source, text_end, _INTEGERS * 10, 10, _WIDTH)
    numbers = fixed_width(source, text_end + _INTEGERS, _NUMBERS * 10, 10, _WIDTH)
    prepended = numbers[21]
    counts = [round(value) for value in integers[33:36]]
    if min(counts) < 0:
        raise InputError(f"{source.at(text_end + 3)}: a number of samples is negative; the header is damaged")
    data = text_end + _INTEGERS + _NUMBERS
    values = np.array(fixed_width(source, data, counts[0], _PER_LINE, _WIDTH)) * factor
    end = data + sum(lines_of(count, _PER_LINE) for count in counts)
    if end > len(source.lines):
        raise InputError(
            f"{source.name}: the record is truncated: the blocks of component {name} end at line {end}, "
            f"the file at line {len(source.lines)}; fetch it again"
        )
    stated = HeaderPeak(
        number(peak[1], source.at(i)) * factor,
        number(peak[3], source.at(i)) + prepended,
        half_last_digit(peak[1]) * factor,
    )
    site, event = (source.lines[start + k].strip() for k in (2, 7))
    trace = Trace(
        source=source,
        name=name,
        title=f"{site} {event}",
        dt=dt,
        acceleration=values,
        treatment=(
            f"read as GeoNet {_volume(source, start)}: {source.name}, component {name}",
            f"{unit_words}; {dt_words}; {prepended:g} s before the record were put there by the agency",
        ),
        header_peak=stated,
        origin=MotionOrigin(station=source.lines[start + 1].split()[1], event=event, start=_record_time(source, start)),
    )
    return trace, end


def _volume(source: SourceFile, start: int) -> str:
    return "V1A (uncorrected)" if source.lines[start].lower().startswith("un") else "V2A"


def _check_raw_unit(source: SourceFile, start: int, end: int, factor: float) -> None:
    """Hold the unit of raw readings ("in units of 1.00 mm/s/s") against that of the stated peak.

    Raises:
        UnitError: they differ.
    """
    for line in source.lines[start:end]:
        found = re.search(r"in units of\s+([\d.]+)\s+(\S+)", line, re.IGNORECASE)
        if found and is_number(found[1]):
            raw = float(found[1]) * acceleration_factor(found[2], f"the header of {source.name}")
            if abs(raw - factor) > 1e-4 * factor:
                raise UnitError(
                    f"{source.name}: the readings are in units of {found[1]} {found[2]}, the peak above them is not; "
                    "fetch the file again"
                )


def _record_time(source: SourceFile, start: int) -> datetime | None:
    """Return the time in the record's own name, "20161113_110259_WTMC_20"."""
    found = re.search(r"\d{8}_\d{6}", source.lines[start])
    return time_in(found[0]) if found else None
