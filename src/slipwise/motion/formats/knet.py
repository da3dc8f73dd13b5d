"""K-NET and KiK-net ASCII (NIED): 17 header lines, then counts, eight to a line; one component a file.

Source: the files' own header; "Max. Acc." is the largest count from the mean, times "Scale Factor".
"""

import re

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, blank_separated, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_HEADER_LINES = 17
#: KiK-net numbers its directions: 1-3 in the borehole, 4-6 at the surface.
_NUMBERED = {"1": "NS", "2": "EW", "3": "UD", "4": "NS", "5": "EW", "6": "UD"}
_NAMED = {"N-S": "NS", "E-W": "EW", "U-D": "UD"}


def recognise(head: bytes) -> bool:
    """Return whether a file begins as K-NET and KiK-net files do."""
    return head.lstrip().startswith(b"Origin Time") and b"Scale Factor" in head


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the one component of a file.

    Raises:
        InputError: a header line is missing or odd, or there are not as many values as the header says.
        UnitError: the scale factor is not in gal.
    """

    def field(label: str, pattern: str) -> tuple[re.Match[str], str]:
        match, i = header_field(source, rf"^{re.escape(label)}\s*{pattern}\s*$", 0, _HEADER_LINES, repr(label))
        return match, source.at(i)

    direction = field("Dir.", r"(\S+)")[0][1]
    name = _NUMBERED.get(direction) or _NAMED.get(direction)
    if name is None:
        raise InputError(f"{source.name}: the direction {direction!r} is none of N-S, E-W, U-D or 1 to 6")
    rate, place = field("Sampling Freq(Hz)", r"([\d.]+)\s*Hz")
    stated_rate = positive(number(rate[1], place), place, "the sampling frequency")
    dt, dt_words = settle_step(1.0 / stated_rate, given, source)
    seconds, place = field("Duration Time(s)", r"([\d.]+)")
    count = round(number(seconds[1], place) * stated_rate)
    scale, place = field("Scale Factor", r"([\d.]+)\((\w+)\)/([\d.]+)")
    per_count = number(scale[1], place) / positive(number(scale[3], place), place, "the scale factor's divisor")
    factor, unit_words = settle_unit(scale[2], given, source)
    counts = np.array(blank_separated(source, _HEADER_LINES, count, "the header's duration", given.allow_short))
    acceleration = counts * (per_count * factor)
    peak, place = field("Max. Acc.", r"\((?:\w+)\)\s*([\d.]+)")
    stated = HeaderPeak(number(peak[1], place) * factor, None, half_last_digit(peak[1]) * factor)
    station = field("Station Code", r"(\S+)")[0][1]
    recorded = field("Record Time", r"(\S.*\S)")[0][1]
    return [
        Trace(
            source=source,
            name=name,
            title=f"{station} {recorded}",
            dt=dt,
            acceleration=acceleration,
            baseline="mean",
            treatment=(
                f"read as K-NET/KiK-net ASCII: {source.name}, Dir. {direction} ({name})",
                f"counts times {scale[1]} {scale[2]} / {scale[3]}, {unit_words}; {dt_words}",
            ),
            header_peak=stated,
            origin=MotionOrigin(
                station=station,
                sensor=_sensor(direction),
                event=field("Origin Time", r"(\S.*\S)")[0][1],
                start=time_in(recorded),
            ),
        )
    ]


def _sensor(direction: str) -> str:
    """Tell which sensor a direction of KiK-net means; K-NET stations have one."""
    return {"123": "borehole", "456": "surface"}.get(next((g for g in ("123", "456") if direction in g), ""), "")
