"""Where and when a component was recorded: components that are joined must agree."""

import re
from dataclasses import dataclass
from datetime import datetime, timedelta

from slipwise.data_files.statements import Statements

_TIME = re.compile(r"(\d{4})\D?(\d{1,2})\D?(\d{1,2})[\sT_-]+(\d{1,2})\D?(\d{1,2})(?:\D?(\d{1,2}(?:\.\d{1,6})?))?")


@dataclass(frozen=True)
class MotionOrigin:
    """What a file states of a component's origin; "" and None where it states nothing.

    Attributes:
        station: name or code.
        sensor: which of the station's sensors: "borehole", "surface", "12 m deep".
        place: in a structure, "Pier Cap 2".
        event: the earthquake.
        start: time of the first sample, in the file's own clock.
        exact_start: whether the start is stated to the sample, as packets of data loggers do.
    """

    station: str = ""
    sensor: str = ""
    place: str = ""
    event: str = ""
    start: datetime | None = None
    exact_start: bool = False


def origin_of(stated: Statements) -> MotionOrigin:
    """Return what the header of a text file states of its origin."""

    def first(fact: str) -> str:
        return next(iter(stated.texts.get(fact, ())), "")

    depth = first("sensor")
    return MotionOrigin(
        station=first("station"),
        sensor=("" if not depth else f"{float(depth):g} m deep" if float(depth) else "surface"),
        event=first("event"),
        start=time_in(first("start")),
    )


def time_in(text: str) -> datetime | None:
    """Return the time that stands in a text with the year first, None if there is none: "20190728_160919.870"."""
    found = _TIME.search(text)
    if found is None:
        return None
    year, month, day, hour, minute = (int(part) for part in found.groups()[:5])
    try:
        return datetime(year, month, day, hour, minute) + timedelta(seconds=float(found[6] or 0.0))
    except (ValueError, OverflowError):
        return None
