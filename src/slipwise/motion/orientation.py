"""Where a component points, told from its name as agencies write them."""

import re
from typing import Literal

Orientation = Literal["table x", "table y", "table z", "east-west", "horizontal", "up", "down", "unknown"]

_UP = {"UP", "U", "UD", "V", "VER", "VERT", "VERTICAL", "Z", "+Z"}
_DOWN = {"DWN", "DOWN", "DN", "D"}
_EAST_WEST = {"EW", "E", "W", "WE", "EAST", "WEST"}
_HORIZONTAL = {"NS", "N", "S", "SN", "NORTH", "SOUTH", "L", "T", "LONG", "TRAN", "TRANS", "H1", "H2", "X", "Y"}
_TABLE: dict[str, Orientation] = {"TABLE_AX": "table x", "TABLE_AY": "table y", "TABLE_AZ": "table z"}


def plain(name: str) -> str:
    """Give a name without case, blanks, hyphens and "DEG": "E-W" is "EW", "90 Deg" is "90"."""
    text = re.sub(r"\s*\bDEG\b\.?", "", name.strip().upper())
    return re.sub(r"[\s-]", "", text)


def orientation(name: str) -> Orientation:
    """Tell where a component points.

    Args:
        name: e.g. "EW", "U-D", "N28W", "90 DEG", "DWN", "table_ax".

    Returns:
        "east-west" also for 90 and 270 degrees; "unknown" for a name that is none of the agencies'.
    """
    text = plain(name)
    if text in _TABLE:
        return _TABLE[text]
    if text in _UP:
        return "up"
    if text in _DOWN:
        return "down"
    bearing = re.fullmatch(r"[NS](\d{1,2})[EW]", text)
    azimuth = re.fullmatch(r"\d{1,3}", text)
    if text in _EAST_WEST or text in ("90", "090", "270") or (bearing and bearing[1] == "90"):
        return "east-west"
    if text in _HORIZONTAL or (bearing and int(bearing[1]) <= 90) or (azimuth and int(text) <= 360):
        return "horizontal"
    return "unknown"


def name_from_stem(stem: str) -> str:
    """Give the component's name that a file name ends in, "" if it ends in none: "TCU065-E", "TAK-090", "ABBAR--L".

    The format of a file is never taken from its name; the component is, when the file itself does not say it.
    """
    last = re.split(r"[-_. ]", stem)[-1]
    if orientation(last) == "unknown" or (last.isdigit() and len(last) != 3):
        return ""
    return last
