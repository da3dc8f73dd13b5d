"""A channel of a CSMIP file of any volume: number, direction, place in the structure, station, start, values, peak."""

import re
from dataclasses import dataclass

import numpy as np

from slipwise.motion.fixed_width import fixed_width
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, header_field, number
from slipwise.motion.stated import Given, acceleration_factor, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_CHANNEL = re.compile(r"^\s*chan\s*(?P<number>\d+):\s*(?P<name>.*?)\s*(?:\(.*|\s{2,}.*|location:.*)?$", re.IGNORECASE)
_PLACE = re.compile(r"location:\s*(.*?)\s*$", re.IGNORECASE)
_STATION = re.compile(r"^\s*station no\.?\s*(\S+)", re.IGNORECASE)
_STATION_CHANNEL = re.compile(r"\(\s*sta\s+chn:?\s*(\d+)\s*\)", re.IGNORECASE)
_START = re.compile(r"start time:\s*(\d+)/(\d+)/(\d+),\s*([\d:.]+)", re.IGNORECASE)


@dataclass(frozen=True)
class CsmipChannel:
    """A channel of a structure or a site.

    Attributes:
        name: its direction: "Long", "360 Deg", "Up".
        place: "Pier Cap 2", "" for a site.
        aliases: by which it may be chosen: "3", "Chan 3".
    """

    name: str
    place: str
    aliases: tuple[str, ...]


@dataclass(frozen=True)
class Values:
    """The line above a channel's values: how many, at which step, in which unit and format.

    Attributes:
        at: index of that line.
        count: number of values.
        step: between them [s].
        unit: as written.
        per_line: values a line.
        width: of their columns [characters].
    """

    at: int
    count: int
    step: float
    unit: str
    per_line: int
    width: int


def channel_of(source: SourceFile, start: int, end: int) -> CsmipChannel:
    """Read the channel of a header.

    Raises:
        InputError: no line 'Chan 1: 360 Deg'.
    """
    _, at = header_field(source, _CHANNEL.pattern, start + 1, end, "the channel's direction")
    found = re.match(_CHANNEL.pattern, source.lines[at], re.IGNORECASE)
    assert found is not None  # header_field searched for the same
    place = _PLACE.search(source.lines[at])
    numbers = [found["number"], *_STATION_CHANNEL.findall(source.lines[at])]
    aliases = tuple(dict.fromkeys(alias for n in numbers for alias in (n, f"Chan {n}")))
    return CsmipChannel(found["name"], place[1] if place else "", aliases)


def origin_of(source: SourceFile, start: int, end: int, place: str) -> MotionOrigin:
    """Read station and start of a header's lines."""
    lines = source.lines[start:end]
    station = next((m[1] for line in lines if (m := _STATION.match(line))), "")
    begun = next((m for line in lines if (m := _START.search(line))), None)
    if begun is None:
        return MotionOrigin(station, "", place)
    month, day, year, clock = begun.groups()
    # Years of two digits: a record of 1971 is as old as they come.
    full = int(year) if len(year) > 2 else int(year) + (2000 if int(year) < 70 else 1900)
    return MotionOrigin(station, "", place, "", time_in(f"{full}-{month}-{day} {clock}"))


def stated_peak(size: str, unit: str, time: str, place: str) -> HeaderPeak:
    """Return the peak as a header writes it: size, unit, time in seconds."""
    factor = acceleration_factor(unit, place)
    return HeaderPeak(number(size, place) * factor, number(time, place), half_last_digit(size) * factor)


def channel_trace(
    source: SourceFile,
    given: Given,
    start: int,
    channel: CsmipChannel,
    values: Values,
    peak: HeaderPeak | None,
    title: str,
    volume: str,
) -> Trace:
    """Read the values of a channel and hold them against its stated peak.

    Args:
        source: the file.
        given: what the user says of step and unit.
        start: index of the first line of the channel's header.
        channel: what the header says of it.
        values: where and how they stand.
        peak: that the header states, None if it states none.
        title: of the record.
        volume: as what the file is read, "V2".

    Raises:
        InputError: values that are missing or no numbers, or a step or peak that contradicts the header.
        UnitError: the unit is none of acceleration.
    """
    dt, dt_words = settle_step(values.step, given, source)
    factor, unit_words = settle_unit(values.unit, given, source)
    read = fixed_width(source, values.at + 1, values.count, values.per_line, values.width)
    acceleration = np.array(read) * factor
    where = f" at {channel.place}" if channel.place else ""
    return Trace(
        source=source,
        name=channel.name,
        title=title[:80].strip(),
        dt=dt,
        acceleration=acceleration,
        treatment=(
            f"read as CSMIP/CESMD {volume}: {source.name}, channel {channel.name}{where}",
            f"{unit_words}; {dt_words}",
        ),
        header_peak=peak,
        origin=origin_of(source, start, values.at, channel.place),
        aliases=channel.aliases,
    )
