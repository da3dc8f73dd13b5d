"""USGS SMC: 11 text lines, 48 integers, 50 numbers, comments, then values in columns that touch; one component a file.

Values: eight to a line in columns of ten (8(1PE10.4E1)), cm/s^2. Integer 16 is the number of comment lines, integer 17
that of the values; number 2 is the rate; numbers 29 to 32 are time and value of the largest and the smallest sample.
Integer 1 and number 1 are what stands for "not known".
Source: SMC-format data files, USGS National Strong-Motion Project.
"""

import math
import re

import numpy as np

from slipwise.errors import InputError, UnitError
from slipwise.motion.fixed_width import fixed_width
from slipwise.motion.origin import MotionOrigin
from slipwise.motion.source_file import SourceFile, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace

_TEXT, _INTEGER_LINES, _NUMBER_LINES = 11, 6, 10
_KIND = re.compile(rb"^\s*\d\s+[A-Z][A-Z ]*?\s*\r*\n\*", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether a kind of SMC stands in the first line and a star in the second."""
    return bool(_KIND.match(head))


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the one component of a file.

    Raises:
        InputError: the header is incomplete or odd, or there are not as many values as it says.
        UnitError: the file holds velocity, displacement or spectra.
    """
    kind = source.lines[0].strip()
    if not re.fullmatch(r"2 +CORRECTED ACCELEROGRAM", kind, re.IGNORECASE):
        raise UnitError(f"{source.at(0)}: this file holds {kind!r}; a table needs a '2 CORRECTED ACCELEROGRAM'")
    found, _ = header_field(source, r"component\s*=\s*(\S+)", 0, _TEXT, "'component='")
    name = found[1]
    integers = fixed_width(source, _TEXT, 48, 8, 10)
    first_number = _TEXT + _INTEGER_LINES
    numbers = _numbers(source, first_number)
    place = source.at(first_number)
    dt, dt_words = settle_step(1.0 / positive(numbers[1], place, "the sampling rate"), given, source)
    factor, unit_words = settle_unit("cm/s^2", given, source)
    comments, count = round(integers[15]), round(integers[16])
    data = first_number + _NUMBER_LINES + comments
    if (
        comments < 0
        or count < 0
        or any(not line.startswith("|") for line in source.lines[first_number + _NUMBER_LINES : data])
    ):
        raise InputError(f"{source.at(_TEXT + 1)}: the numbers of comments ({comments}) and values ({count}) are wrong")
    values = np.array(fixed_width(source, data, count, 8, 10)) * factor
    if any(line.strip() for line in source.lines[data + -(-count // 8) :]):
        raise InputError(f"{source.name}: more values follow than the {count} that the header states")
    stated = _peak(numbers, factor)
    return [
        Trace(
            source=source,
            name=name,
            title=f"{source.lines[3].strip()} {source.lines[5].partition('component')[0].strip()}",
            dt=dt,
            acceleration=values,
            treatment=(
                f"read as USGS SMC: {source.name}, component {name}",
                f"{unit_words.replace('the file states', 'the format says')}; {dt_words}",
            ),
            header_peak=stated,
            origin=MotionOrigin(
                station=source.lines[5].partition("component")[0].replace("station =", "").strip(),
                event=" ".join(source.lines[3].split()),
            ),
        )
    ]


def _numbers(source: SourceFile, start: int) -> list[float]:
    """Read the 50 numbers of the header; what stands for "not known" (1.7e38) becomes NaN."""
    values: list[float] = []
    for i in range(start, start + _NUMBER_LINES):
        line = source.lines[i].rstrip() if i < len(source.lines) else ""
        if len(line) != 75:
            raise InputError(f"{source.at(i)}: five numbers in columns of 15 were expected; the header is damaged")
        for field in (line[k : k + 15] for k in range(0, 75, 15)):
            values.append(np.nan if field.strip() == "0.1700000E+39" else number(field, source.at(i)))
    return values


def _peak(numbers: list[float], factor: float) -> HeaderPeak | None:
    """Return the larger of the stated extremes, None if they are not known."""
    candidates = [(numbers[i + 1], numbers[i]) for i in (28, 30) if np.isfinite(numbers[i : i + 2]).all()]
    if len(candidates) < 2:
        return None
    value, time = max(candidates, key=lambda pair: abs(pair[0]))
    # The data carry five digits.
    last_digit = 10.0 ** (math.floor(math.log10(max(abs(value), 1e-9))) - 4)
    return HeaderPeak(value * factor, time, 0.5 * last_digit * factor)
