"""The grammar of channels: name, unit, sign and place of everything that is measured or simulated.

File name of a column = channel name. What a pad or a buffer measures is named after it: `pad_<name>_N`,
`buffer_<name>_Fx`, where the name is a word of letters and digits that the rig gives it.
"""

import fnmatch
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache

from slipwise.errors import UnknownNameError, unknown_name

#: Pads and buffers of the reference rig, after which the channels that are listed are named.
PADS: tuple[str, ...] = ("A", "B", "C", "D")
BUFFERS: tuple[str, ...] = ("1", "2")
#: Gauges that the slip velocity is made of.
VELOCITY_CHANNELS: tuple[str, ...] = ("slip_x", "girder_ax", "table_ax")


@dataclass(frozen=True)
class Channel:
    """One column of a record.

    Attributes:
        name: the column's name.
        unit: SI unit.
        shown_in: unit at the edges (files, pictures, tables).
        place: where it is measured.
        sign: what a positive value means.
    """

    name: str
    unit: str
    shown_in: str
    place: str
    sign: str


def _table() -> dict[str, Channel]:
    rows: list[tuple[str, str, str, str, str]] = [("time", "s", "s", "logger", "since the start of the run")]
    axis_words = {"x": "+x (shaking direction)", "y": "+y (across)", "z": "up"}
    for axis, word in axis_words.items():
        rows.append((f"table_a{axis}", "m/s^2", "m/s^2", "table top, absolute", word))
        rows.append((f"girder_a{axis}", "m/s^2", "m/s^2", "girder's centre of gravity, absolute", word))
        rows.append((f"table_d{axis}", "m", "mm", "table top, absolute", word))
    for edge, side in (("1", "+x"), ("2", "-x")):
        rows.append((f"girder_az_{edge}", "m/s^2", "m/s^2", f"girder's {side} edge, absolute", "up"))
    for axis in ("x", "y"):
        rows.append((f"slip_{axis}", "m", "mm", "girder minus table at the sliding plane", axis_words[axis]))
        rows.append((f"slip_v{axis}", "m/s", "mm/s", "girder minus table at the sliding plane", axis_words[axis]))
    for axis in ("x", "y"):
        rows.append((f"storey_1_a{axis}", "m/s^2", "m/s^2", "floor of storey 1, absolute", axis_words[axis]))
        rows.append((f"storey_1_d{axis}", "m", "mm", "floor of storey 1 minus table", axis_words[axis]))
    rows.append(("yaw", "rad", "mrad", "girder minus table", "counter-clockwise seen from above"))
    rows.append(("pitch", "rad", "mrad", "girder minus table", "about +y: nose down at +x"))
    rows.append(("roll", "rad", "mrad", "girder minus table", "about +x"))
    rows.append(("heave", "m", "mm", "girder minus table at the centre of gravity", "up from the unloaded pads"))
    rows.append(("table_pitch", "rad", "mrad", "table top", "about +y: nose down at +x"))
    return {row[0]: Channel(*row) for row in rows}


def _of_pad(pad: str) -> tuple[Channel, ...]:
    cell = f"load cell of pad {pad}"
    forces = [
        Channel(f"pad_{pad}_F{a}", "N", "kN", cell, f"force of the girder on the pad: positive when sliding to +{a}")
        for a in ("x", "y")
    ]
    return (
        Channel(f"pad_{pad}_N", "N", "kN", cell, "compression"),
        *forces,
        Channel(f"pad_{pad}_P", "Pa", "MPa", f"pad {pad}", "compression"),
        Channel(f"pad_{pad}_T", "K", "degC", f"sliding face of pad {pad}", "temperature"),
    )


def _of_buffer(buffer: str) -> tuple[Channel, ...]:
    sign = "force of the girder on the buffer: positive when the girder is at +{}"
    return tuple(
        Channel(f"buffer_{buffer}_F{a}", "N", "kN", f"shear key of buffer {buffer}", sign.format(a)) for a in ("x", "y")
    )


def channels_of(pads: Iterable[str], buffers: Iterable[str]) -> dict[str, Channel]:
    """Return every channel that a rig with these pads and buffers can have, by name."""
    named = [*(c for pad in pads for c in _of_pad(pad)), *(c for buffer in buffers for c in _of_buffer(buffer))]
    return _table() | {c.name: c for c in named}


#: The channels of the reference rig: those that are listed and offered; the grammar knows more.
CHANNELS: dict[str, Channel] = channels_of(PADS, BUFFERS)
#: A channel that only serves to compute others in a campaign: "<channel>_raw".
_RAW = re.compile(r"^(?P<name>.+)_raw$")
_STOREY = re.compile(r"^storey_(?P<number>[1-9][0-9]*)_(?P<kind>[ad][xy])$")
_PART = re.compile(r"^(?P<part>pad|buffer)_(?P<name>[A-Za-z0-9]+)_(?P<kind>[A-Za-z]+)$")


def _known(name: str) -> Channel | None:
    """Look a channel up in the list, then in the grammar."""
    if name in CHANNELS:
        return CHANNELS[name]
    if (storey := _STOREY.match(name)) is not None:
        first = CHANNELS[f"storey_1_{storey['kind']}"]
        return replace(first, name=name, place=first.place.replace("storey 1", f"storey {storey['number']}"))
    match = _PART.match(name)
    if not match:
        return None
    possible = _of_pad(match["name"]) if match["part"] == "pad" else _of_buffer(match["name"])
    return next((c for c in possible if c.name == name), None)


def is_channel(name: str) -> bool:
    """Return whether the grammar knows a name; "pad_A_Fx_raw" too."""
    match = _RAW.match(name)
    return _known(match["name"] if match else name) is not None


def channel(name: str) -> Channel:
    """Look a channel up; "pad_A_Fx_raw" has the unit of "pad_A_Fx".

    Raises:
        UnknownNameError: no such channel; the message offers the nearest ones.
    """
    match = _RAW.match(name)
    known = _known(match["name"] if match else name)
    if known is None:
        raise unknown_channel(name)
    return replace(known, name=name) if match else known


def part_of(name: str) -> tuple[str, str]:
    """Return what a channel belongs to: ("pad", "A") of "pad_A_N", ("buffer", "1") of "buffer_1_Fx", else ("", "")."""
    match = _PART.match(name)
    return (match["part"], match["name"]) if match else ("", "")


def pads_in(names: Iterable[str]) -> tuple[str, ...]:
    """Return the pads that channels with these names belong to: shorter names first, then by the alphabet."""
    found = {part_of(name)[1] for name in names if part_of(name)[0] == "pad"}
    return tuple(sorted(found, key=lambda pad: (len(pad), pad)))


def channels_like(pattern: str, among: Iterable[str]) -> tuple[str, ...]:
    """Return the channels that a pattern such as "pad_*_N" means, in their order; "all" means every channel."""
    return tuple(n for n in among if pattern == "all" or fnmatch.fnmatchcase(n, pattern))


@cache
def check_pattern(pattern: str) -> None:
    """Refuse a pattern that no channel of any rig has.

    Raises:
        UnknownNameError: none; the message offers the nearest ones.
    """
    if not channels_like(pattern, CHANNELS) and not is_channel(pattern.replace("*", "1").replace("?", "1")):
        raise unknown_channel(pattern)


def unknown_channel(name: str) -> UnknownNameError:
    """Make the error for a channel that does not exist."""
    return unknown_name("channel", name, CHANNELS, "`slipwise channels` lists them.")
