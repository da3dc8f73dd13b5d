"""The table of channels: name, unit, sign and place of everything that is measured or simulated.

File name of a column = channel name. Pads: A (+x,+y), B (-x,+y), C (+x,-y), D (-x,-y).
"""

import fnmatch
import re
from dataclasses import dataclass
from functools import cache

from slipwise.errors import UnknownNameError, unknown_name

PADS: tuple[str, ...] = ("A", "B", "C", "D")
#: Signs of the pads' places, in units of half the pad spacing: (x, y).
PAD_SIGNS: tuple[tuple[int, int], ...] = ((1, 1), (-1, 1), (1, -1), (-1, -1))
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
    rows.append(("yaw", "rad", "mrad", "girder minus table", "counter-clockwise seen from above"))
    rows.append(("pitch", "rad", "mrad", "girder minus table", "about +y: nose down at +x"))
    rows.append(("roll", "rad", "mrad", "girder minus table", "about +x"))
    rows.append(("heave", "m", "mm", "girder minus table at the centre of gravity", "up from the unloaded pads"))
    rows.append(("table_pitch", "rad", "mrad", "table top", "about +y: nose down at +x"))
    for pad in PADS:
        rows.append((f"pad_{pad}_N", "N", "kN", f"load cell of pad {pad}", "compression"))
        for axis in ("x", "y"):
            rows.append(
                (
                    f"pad_{pad}_F{axis}",
                    "N",
                    "kN",
                    f"load cell of pad {pad}",
                    f"force of the girder on the pad: positive when sliding to +{axis}",
                )
            )
        rows.append((f"pad_{pad}_P", "Pa", "MPa", f"pad {pad}", "compression"))
        rows.append((f"pad_{pad}_T", "K", "degC", f"sliding face of pad {pad}", "temperature"))
    for buffer in BUFFERS:
        for axis in ("x", "y"):
            rows.append(
                (
                    f"buffer_{buffer}_F{axis}",
                    "N",
                    "kN",
                    f"shear key of buffer {buffer}",
                    f"force of the girder on the buffer: positive when the girder is at +{axis}",
                )
            )
    return {row[0]: Channel(*row) for row in rows}


CHANNELS: dict[str, Channel] = _table()
#: A channel that only serves to compute others in a campaign: "<channel>_raw".
_RAW = re.compile(r"^(?P<name>.+)_raw$")


def channel(name: str) -> Channel:
    """Look a channel up; "pad_A_Fx_raw" has the unit of "pad_A_Fx".

    Raises:
        UnknownNameError: no such channel; the message offers the nearest ones.
    """
    match = _RAW.match(name)
    known = CHANNELS.get(match["name"] if match else name)
    if known is None:
        raise unknown_channel(name)
    return Channel(name, known.unit, known.shown_in, known.place, known.sign) if match else known


@cache
def channels_like(pattern: str) -> tuple[str, ...]:
    """Give the names that a pattern such as "pad_*_N" means; "all" means every channel.

    Raises:
        UnknownNameError: none; the message offers the nearest ones.
    """
    found = tuple(n for n in CHANNELS if pattern == "all" or fnmatch.fnmatchcase(n, pattern))
    if not found:
        raise unknown_channel(pattern)
    return found


def unknown_channel(name: str) -> UnknownNameError:
    """Make the error for a channel that does not exist."""
    return unknown_name("channel", name, CHANNELS, "`slipwise channels` lists them.")
