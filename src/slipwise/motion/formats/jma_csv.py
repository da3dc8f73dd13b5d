"""JMA CSV (Japan Meteorological Agency): seven header lines in Shift-JIS, then NS,EW,UD in gal.

Source: the files' own header. JMA files state no number of values and no peak.
"""

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.trace import Trace

_HEADER_LINES = 7


def recognise(head: bytes) -> bool:
    """Return whether a file begins as JMA's do."""
    return head.lstrip().startswith(b"SITE CODE=") and b"SAMPLING RATE" in head


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the three components of a file.

    Raises:
        InputError: a header line is missing or odd, or a row has not one value for each component.
        UnitError: the unit is none of acceleration.
    """
    rate, i = header_field(source, r"^\s*SAMPLING RATE\s*=\s*([\d.]+)\s*Hz\s*$", 0, _HEADER_LINES, "SAMPLING RATE")
    per_second = positive(number(rate[1], source.at(i)), source.at(i), "the sampling rate")
    dt, dt_words = settle_step(1.0 / per_second, given, source)
    unit, _ = header_field(source, r"^\s*UNIT\s*=\s*(\S.*?)\s*$", 0, _HEADER_LINES, "UNIT")
    factor, unit_words = settle_unit(unit[1], given, source)
    order, i = header_field(source, r"^\s*(NS|EW|UD)\s*,\s*(NS|EW|UD)\s*,\s*(NS|EW|UD)\s*$", 0, 9, "NS,EW,UD")
    names = [name.upper() for name in order.groups()]
    if len(set(names)) < 3:
        raise InputError(f"{source.at(i)}: the components are {','.join(names)}; each of NS, EW, UD is needed once")
    site, _ = header_field(source, r"SITE CODE=\s*([^,]*)", 0, 1, "SITE CODE")
    started, _ = header_field(source, r"INITIAL TIME\s*=\s*(.*)", 0, _HEADER_LINES, "INITIAL TIME")
    rows = []
    for k in range(i + 1, len(source.lines)):
        fields = source.lines[k].split(",")
        if fields == [""]:
            continue
        if len(fields) != 3:
            raise InputError(
                f"{source.at(k)}: 3 values were expected, the line has {len(fields)}; "
                "the record is truncated or damaged, fetch the file again"
            )
        rows.append([number(field, source.at(k)) for field in fields])
    values = np.array(rows, dtype=float).reshape(-1, 3) * factor
    return [
        Trace(
            source=source,
            name=name,
            title=f"{site[1].strip()} {started[1].strip()}",
            dt=dt,
            acceleration=values[:, column],
            treatment=(f"read as JMA CSV: {source.name}, component {name}", f"{unit_words}; {dt_words}"),
            origin=MotionOrigin(station=site[1].strip(), start=time_in(started[1])),
        )
        for column, name in enumerate(names)
    ]
