"""CSMNC (China Strong Motion Networks Center): lines of text, then values between blanks; one component a file.

Source: the files' own headers: "NO. OF POINTS: 12000 EQUALLY SPACED INTERVALS OF: 0.005 SEC", "PEAK VALUE: -1005.350 AT
26.35 SEC", "UNIT: CM/SEC/SEC", "COMP. EW".
"""

import re

import numpy as np

from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, blank_separated, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_LOOK_AT = 40


def recognise(head: bytes) -> bool:
    """Return whether the header states points and interval as CSMNC does."""
    text = head.upper()
    return b"NO. OF POINTS:" in text and b"EQUALLY SPACED INTERVALS OF:" in text and b"COMP." in text


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the one component of a file.

    Raises:
        InputError: a header line is missing or odd, or there are not as many values as it says.
        UnitError: the unit is none of acceleration.
    """

    def field(pattern: str, what: str) -> tuple[re.Match[str], int, str]:
        match, i = header_field(source, pattern, 0, _LOOK_AT, what)
        return match, i, source.at(i)

    points, _, place = field(
        r"NO\. OF POINTS:\s*(\d+)\s+EQUALLY SPACED INTERVALS OF:\s*([\d.]+)\s*SEC", "NO. OF POINTS"
    )
    dt, dt_words = settle_step(positive(number(points[2], place), place, "the step"), given, source)
    kind, _, _ = field(r"^\s*(.*ACCELERATION.*?)\s+UNIT:\s*(\S+)", "the unit of its acceleration")
    factor, unit_words = settle_unit(kind[2], given, source)
    name = field(r"^\s*COMP\.?\s*(\S+)", "the component")[0][1]
    peak, at, place = field(r"PEAK VALUE:\s*(-?[\d.]+)\s+AT\s+([\d.]+)\s*SEC", "the peak")
    start = next(i for i in range(at + 1, len(source.lines) + 1) if i == len(source.lines) or _is_data(source.lines[i]))
    values = np.array(blank_separated(source, start, int(points[1]), "NO. OF POINTS", given.allow_short)) * factor
    stated = HeaderPeak(
        number(peak[1], place) * factor, number(peak[2], place), half_last_digit(peak[1]) * factor
    )  # fmt: skip
    station = field(r"STATION:\s*(\S+)", "the station")[0][1]
    return [
        Trace(
            source=source,
            name=name,
            title=f"{source.lines[2].strip()} {station}",
            dt=dt,
            acceleration=values,
            treatment=(
                f"read as CSMNC: {source.name}, {kind[1].lower()}, component {name}",
                f"{unit_words}; {dt_words}",
            ),
            header_peak=stated,
            origin=MotionOrigin(station=station, event=source.lines[2].strip(), start=time_in(source.lines[1])),
        )
    ]


def _is_data(line: str) -> bool:
    """Return whether a line below the header holds values: nothing of a word but exponents."""
    fields = line.split()
    return bool(fields) and all(field[0] in "+-.0123456789" and field[-1].isdigit() for field in fields)
