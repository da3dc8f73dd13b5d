"""GeoNet V2A (corrected accelerograms, New Zealand): three components, each a 26-line header and three blocks.

Header: 16 lines of text, 4 lines of ten integers (10I8), 6 lines of ten numbers (10F8.0); then acceleration, velocity
and displacement, ten to a line in columns of eight that touch. Times in the header count from the end of the samples
that the processing put before the record.
Source: GNS Accelerogram Data Files, Standard Format (W. J. Cousins, 2008).
"""

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.fixed_width import fixed_width, lines_of
from slipwise.motion.source_file import SourceFile, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, check_header_peak, half_last_digit

_TEXT, _INTEGERS, _NUMBERS = 16, 4, 6
_PER_LINE, _WIDTH = 10, 8
_COMPONENTS = 3


def recognise(head: bytes) -> bool:
    """Tell whether the first two lines are those of GeoNet."""
    lines = head.lstrip().lower().splitlines()[:2]
    return len(lines) == 2 and lines[0].startswith(b"corrected accelerogram") and lines[1].startswith(b"site ")


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
    step, i = header_field(source, r"data at\s+(-?[\d.]+)\s*sec", start, text_end, "the step of its samples")
    dt, dt_words = settle_step(positive(number(step[1], source.at(i)), source.at(i), "the step"), given, source)
    pattern = r"^\s*Acceleration:\s*peak\s+(-?[\d.]+)\s+(\S+)\s+at\s+(-?[\d.]+)\s*sec"
    peak, i = header_field(source, pattern, start, text_end, "the peak of its acceleration")
    factor, unit_words = settle_unit(peak[2], given, source)
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
    check_header_peak(values, dt, stated, source, name)
    site, event = (source.lines[start + k].strip() for k in (2, 7))
    trace = Trace(
        source=source,
        name=name,
        title=f"{site} {event}",
        dt=dt,
        acceleration=values,
        baseline="none",
        treatment=(
            f"read as GeoNet V2A: {source.name}, component {name}",
            f"{unit_words}; {dt_words}; {prepended:g} s before the record were put there by the agency",
        ),
        header_peak=stated,
    )
    return trace, end
