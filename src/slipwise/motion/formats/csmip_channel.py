"""What the header of a CSMIP channel says of it: number, direction, place in the structure, station, start."""

import re
from dataclasses import dataclass

from slipwise.motion.origin import Origin, time_in
from slipwise.motion.source_file import SourceFile, header_field

_CHANNEL = re.compile(r"^\s*chan\s*(?P<number>\d+):\s*(?P<name>.*?)\s*(?:\(.*|\s{2,}.*|location:.*)?$", re.IGNORECASE)
_PLACE = re.compile(r"location:\s*(.*?)\s*$", re.IGNORECASE)
_STATION = re.compile(r"^\s*station no\.?\s*(\S+)", re.IGNORECASE)
_STATION_CHANNEL = re.compile(r"\(\s*sta\s+chn:?\s*(\d+)\s*\)", re.IGNORECASE)
_START = re.compile(r"start time:\s*(\d+)/(\d+)/(\d+),\s*([\d:.]+)", re.IGNORECASE)


@dataclass(frozen=True)
class Channel:
    """A channel of a structure or a site.

    Attributes:
        name: its direction: "Long", "360 Deg", "Up".
        place: "Pier Cap 2", "" for a site.
        aliases: by which it may be chosen: "3", "Chan 3".
    """

    name: str
    place: str
    aliases: tuple[str, ...]


def channel_of(source: SourceFile, start: int, end: int) -> Channel:
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
    return Channel(found["name"], place[1] if place else "", aliases)


def origin_of(source: SourceFile, start: int, end: int, place: str) -> Origin:
    """Read station and start of a header's lines."""
    lines = source.lines[start:end]
    station = next((m[1] for line in lines if (m := _STATION.match(line))), "")
    begun = next((m for line in lines if (m := _START.search(line))), None)
    if begun is None:
        return Origin(station, "", place)
    month, day, year, clock = begun.groups()
    # Years of two digits: a record of 1971 is as old as they come.
    full = int(year) if len(year) > 2 else int(year) + (2000 if int(year) < 70 else 1900)
    return Origin(station, "", place, "", time_in(f"{full}-{month}-{day} {clock}"))
