"""PEER AT2: a few lines of text with NPTS, DT and the unit, then values between blanks; one component a file.

Dialects: "NPTS= 2676, DT= .0200 SEC" in either order, in one line or two, with the unit behind or above, the older
"4000 .0050 NPTS, DT", five or eight values to a line, neighbours that touch, exponents with D, CR CR LF line ends, a
free-text header, an end mark below the values. Source: the files' own headers.
"""

import re

import numpy as np

from slipwise.data_files.statements import NUMBER, read_statements
from slipwise.errors import InputError
from slipwise.motion.orientation import name_from_stem, orientation, sensor_of
from slipwise.motion.origin import MotionOrigin
from slipwise.motion.source_file import SourceFile, blank_separated
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.trace import Trace

#: The line with NPTS stands among the first ones.
_LOOK_AT = 10
#: Values, neighbours may touch.
_DATA = re.compile(r"[\s,]*[+-]?[\d.][\d\s.,+eEdD-]*")
_OLD = re.compile(rf"^\s*(?P<count>\d{{1,9}})\s+(?P<dt>{NUMBER})\s*,?\s+NPTS\s*,\s*DT\b", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether NPTS stands in one of the first lines."""
    return any(b"NPTS" in line.upper() for line in re.split(rb"[\r\n]+", head)[:_LOOK_AT])


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the one component of a file.

    Raises:
        InputError: NPTS or DT is missing or odd, or there are not as many values as NPTS says.
        UnitError: no unit, an unknown one, or one of velocity or displacement (VT2, DT2).
    """
    at = next(i for i, line in enumerate(source.lines) if "NPTS" in line.upper())
    below = enumerate(source.lines[at + 1 : at + _LOOK_AT], at + 1)
    start = next((i for i, line in below if _DATA.fullmatch(line)), at + 1)
    header = [_OLD.sub(r"NPTS= \g<count>, DT= \g<dt>", line) for line in source.lines[:start]]
    stated = read_statements(header, source.name)
    if stated.count is None or stated.step is None:
        raise InputError(
            f"{source.at(at)}: the number of points and the step cannot be read; 'NPTS= 2000, DT= .0200 SEC' is"
        )
    dt, dt_words = settle_step(stated.step, given, source, stated.lines["step"])
    factor, unit_words = settle_unit(stated.unit, given, source, stated.lines.get("unit", ""))
    values = blank_separated(source, start, stated.count, f"NPTS= {stated.count}", given.allow_short)
    title, name, letter = _title(source, at)
    parts = [part.strip() for part in title.split(",")]
    return [
        Trace(
            source=source,
            name=name,
            title=title,
            dt=dt,
            acceleration=np.array(values) * factor,
            treatment=(f"read as PEER AT2: {source.name}, component {name}", f"{unit_words}; {dt_words}"),
            # "Manjil Iran, 6/20/1990, Abbar": event and station stand around the date.
            origin=MotionOrigin(
                station=parts[-1] if len(parts) > 2 else "",
                sensor=sensor_of(name),
                event=" ".join(parts[:-1]) if len(parts) > 2 else "",
            ),
            letter_of_file=letter,
        )
    ]


def _title(source: SourceFile, at: int) -> tuple[str, str, bool]:
    """Return title, component and whether that is but a letter of the file's name.

    The second line's last part names the component, as in "Manjil Iran, 6/20/1990, Abbar, L".
    """
    for line in source.lines[:at]:
        event, comma, last = line.strip().rpartition(",")
        if comma and orientation(last) != "unknown":
            return event.strip(), last.strip(), False
    title = source.lines[0].strip() if at > 0 else source.stem
    name = name_from_stem(source.stem)
    return title, name or source.stem, len(name) == 1
