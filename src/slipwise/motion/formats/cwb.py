"""CWB/TSMIP (Taiwan): comment lines with "#Key: value", then time and three components; the sequence is in the header.

Source: the files' own headers: "#DataSequence: Time U(+); N(+); E(+)", "#AmplitudeMAX. U: 1.196~ -1.017".
"""

import re

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.number_rows import table_of_numbers
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, check_count, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_LOOK_AT = 60


def recognise(head: bytes) -> bool:
    """Return whether the header names a sequence of data as CWB does."""
    return head.lstrip().startswith(b"#") and b"#DataSequence:" in head


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the three components of a file.

    Raises:
        InputError: a header line is missing or odd, the rows are not as many as it says, or the times do not fit.
        UnitError: the unit is none of acceleration.
    """

    def field(key: str, pattern: str) -> tuple[re.Match[str], str]:
        match, i = header_field(source, rf"^\s*#\s*{re.escape(key)}\s*:?\s*{pattern}", 0, _LOOK_AT, repr(key))
        return match, source.at(i)

    rate, place = field("SampleRate(Hz)", r"([\d.]+)")
    per_second = positive(number(rate[1], place), place, "the sampling rate")
    dt, dt_words = settle_step(1.0 / per_second, given, source)
    factor, unit_words = settle_unit(field("AmplitudeUnit", r"([^\s.]+)")[0][1], given, source)
    sequence, place = field("DataSequence", r"(.*\S)")
    names = re.findall(r"([A-Z])\(([+-])\)", sequence[1])
    if not re.match(r"\s*time\b", sequence[1], re.IGNORECASE) or len(names) < 1:
        raise InputError(f"{place}: the sequence {sequence[1]!r} cannot be read; 'Time U(+); N(+); E(+)' is")
    length, place = field("RecordLength(sec)", r"([\d.]+)")
    count = round(number(length[1], place) * per_second)
    table = table_of_numbers(source, _rows(source), len(names) + 1)
    check_count(len(table), count, source, "the header's record length", given.allow_short)
    if np.abs(table[:, 0] - table[0, 0] - np.arange(len(table)) * dt).max() > 0.5 * dt:
        raise InputError(
            f"{source.name}: the times do not advance by {dt:g} s, as the header's rate says; fetch it again"
        )
    station = field("StationCode", r"(\S+)")[0][1]
    origin = MotionOrigin(
        station=station,
        event=field("Origin Time(GMT+08)", r"(.*\S)")[0][1],
        start=time_in(field("StartTime(GMT+08)", r"(.*\S)")[0][1]),
    )
    traces = []
    for column, (name, sign) in enumerate(names, 1):
        values = table[:, column] * (factor if sign == "+" else -factor)
        peak = _peak(source, name, factor)
        traces.append(
            Trace(
                source=source,
                name=name,
                title=f"{station} {origin.event}",
                dt=dt,
                acceleration=values,
                treatment=(f"read as CWB/TSMIP: {source.name}, component {name}", f"{unit_words}; {dt_words}"),
                header_peak=peak,
                origin=origin,
            )
        )
    return traces


def _rows(source: SourceFile) -> list[int]:
    return [i for i, line in enumerate(source.lines) if not line.lstrip().startswith("#")]


def _peak(source: SourceFile, name: str, factor: float) -> HeaderPeak | None:
    """Return the larger of the two extremes that the header states, None if it states none."""
    for i, line in enumerate(source.lines[:_LOOK_AT]):
        found = re.search(rf"AmplitudeMAX\.\s*{name}:\s*(-?[\d.]+)\s*~\s*(-?[\d.]+)", line, re.IGNORECASE)
        if found:
            text = max(found.groups(), key=lambda value: abs(number(value, source.at(i))))
            return HeaderPeak(number(text, source.at(i)) * factor, None, half_last_digit(text) * factor)
    return None
