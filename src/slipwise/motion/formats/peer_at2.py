"""PEER AT2: a few lines of text with NPTS, DT and the unit, then values between blanks; one component a file.

Dialects: "NPTS= 2676, DT= .0200 SEC" in either order, with and without a comma after SEC or the unit behind, the older
"4000 .0050 NPTS, DT", five or eight values to a line, exponents with D, CR CR LF line ends, a free-text header, an end
mark below the values. Source: the files' own headers.
"""

import re

import numpy as np

from slipwise.errors import InputError, UnitError
from slipwise.motion.orientation import name_from_stem, orientation, sensor_of
from slipwise.motion.origin import Origin
from slipwise.motion.source_file import SourceFile, blank_separated, number
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.trace import Trace

#: The line with NPTS stands among the first ones.
_LOOK_AT = 10
_COUNT = re.compile(r"\bNPTS\s*[=:]\s*(?P<count>\d{1,9})\b", re.I)
_STEP = re.compile(r"\bDT\s*[=:]\s*(?P<dt>[\d.]+(?:[ED][+-]?\d+)?)\s*(?P<unit>[A-Z]*)", re.I)
_OLD = re.compile(r"^\s*(?P<count>\d{1,9})\s+(?P<dt>[\d.]+(?:[ED][+-]?\d+)?)\s+NPTS\s*,\s*DT(?P<unit>)\s*$", re.I)
_UNIT = re.compile(r"\bUNITS?\s*(?:OF|ARE|IN|:|=)\s*(\([^)]*\)|[^\s,]+)", re.I)


def recognise(head: bytes) -> bool:
    """Tell whether NPTS stands in one of the first lines."""
    return any(b"NPTS" in line.upper() for line in re.split(rb"[\r\n]+", head)[:_LOOK_AT])


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the one component of a file.

    Raises:
        InputError: NPTS or DT is missing or odd, or there are not as many values as NPTS says.
        UnitError: no unit, an unknown one, or one of velocity or displacement (VT2, DT2).
    """
    at = next((i for i, line in enumerate(source.lines[:_LOOK_AT]) if "NPTS" in line.upper()), None)
    match = None if at is None else _OLD.search(source.lines[at])
    count_found = match or (None if at is None else _COUNT.search(source.lines[at]))
    match = match or (None if at is None else _STEP.search(source.lines[at]))
    if at is None or match is None or count_found is None:
        place = source.name if at is None else source.at(at)
        raise InputError(f"{place}: the number of points and the step cannot be read; 'NPTS= 2000, DT= .0200 SEC' is")
    if match["unit"].upper() not in ("", "S", "SEC", "SECONDS"):
        raise UnitError(f"{source.at(at)}: the step is in {match['unit']!r}; AT2 files give it in SEC")
    dt, dt_words = settle_step(number(match["dt"], source.at(at)), given, source)
    units = {found[1].strip("()., ") for line in source.lines[: at + 1] for found in _UNIT.finditer(line)}
    if len(units) > 1:
        raise UnitError(
            f"{source.name}: the header states several units, {', '.join(sorted(units))}; leave the true one"
        )
    factor, unit_words = settle_unit(next(iter(units), None), given, source)
    count = int(count_found["count"])
    values = blank_separated(source, at + 1, count, f"NPTS= {count}")
    title, name = _title(source, at)
    parts = [part.strip() for part in title.split(",")]
    return [
        Trace(
            source=source,
            name=name,
            title=title,
            dt=dt,
            acceleration=np.array(values) * factor,
            baseline="none",
            treatment=(f"read as PEER AT2: {source.name}, component {name}", f"{unit_words}; {dt_words}"),
            # "Manjil Iran, 6/20/1990, Abbar": event and station stand around the date.
            origin=Origin(
                station=parts[-1] if len(parts) > 2 else "",
                sensor=sensor_of(name),
                event=" ".join(parts[:-1]) if len(parts) > 2 else "",
            ),
        )
    ]


def _title(source: SourceFile, at: int) -> tuple[str, str]:
    """Give title and component: the second line's last part names it, as in "Manjil Iran, 6/20/1990, Abbar, L"."""
    for line in source.lines[:at]:
        event, comma, last = line.strip().rpartition(",")
        if comma and orientation(last) != "unknown":
            return event.strip(), last.strip()
    title = source.lines[0].strip() if at > 0 else source.stem
    return title, name_from_stem(source.stem) or source.stem
