"""Where a component points, told from its name as agencies and laboratories write them."""

import re
from typing import Literal

from slipwise.data_files.statements import Statements

Orientation = Literal["table x", "table y", "table z", "east-west", "horizontal", "up", "down", "unknown"]

_UP = {
    "UP", "U", "UD", "V", "VER", "VERT", "VERTICAL", "Z", "+Z", "+V", "+UP", "ZUP", "UPDOWN", "UP/DOWN", "U/D", "VT",
    "VRT", "DUSEY", "DÜŞEY", "上下", "上下向", "竖向", "竖直向", "垂直", "垂直向",
}  # fmt: skip
_DOWN = {"DWN", "DOWN", "DN", "D"}
#: Also este-oeste, est-ouest, Ost-West, Turkish dogu-bati and Japanese.
_EAST_WEST = {
    "EW", "E", "W", "WE", "EAST", "WEST", "EASTWEST", "E/W", "EO", "E/O", "OE", "O", "ESTE", "OESTE", "ESTEOESTE",
    "EST", "OUEST", "OVEST", "OW", "OST", "DB", "DOGUBATI", "東西", "东西", "東西向", "东西向",
}  # fmt: skip
_HORIZONTAL = {
    "NS", "N", "S", "SN", "NORTH", "SOUTH", "NORTHSOUTH", "N/S", "L", "T", "LONG", "LONGITUDINAL", "TRAN", "TRANS",
    "TRANSVERSE", "TRANSVERSAL", "TRV", "LAT", "LATERAL", "RADIAL", "RADL", "RAD", "R", "TANG", "TANGENTIAL", "H1",
    "H2", "NORTE", "SUR", "NORTESUR", "NORD", "SUD", "KG", "KUZEYGUNEY", "南北", "南北向", "FN", "FP", "FAULTNORMAL",
    "FAULTPARALLEL",
}  # fmt: skip
_TABLE: dict[str, Orientation] = {
    "TABLE_AX": "table x", "TABLE_AY": "table y", "TABLE_AZ": "table z", "X": "table x", "Y": "table y",
}  # fmt: skip
#: KiK-net: EW1 is in the borehole, EW2 at the surface.
_KIKNET = re.compile(r"(EW|NS|UD)([12])")
#: FDSN: band, instrument (H, L, G, N, M: seismometers and accelerometers), direction.
_SEED = re.compile(r"[FGDCESHBMLVU][HLGNM]([ENZ123RTUVW])")
#: "acc_NS", "ax", "Linear Acceleration x", "gFx": what is measured stands before the direction.
_MEASURED = re.compile(
    r"^(?:LINEAR[\s_])?(?:ACC|ACE|ACEL|ACCEL|ACCELERATION|ACCELEROMETER|ACELERACION|BESCHLEUNIGUNG|IVME|ACCELERAZIONE|USERACCELERATION"
    r"|A|CH|COMP|COMPONENT)(?:[\s_.:-]+(?=\S)|(?=[XYZ]$))|^GF(?=[XYZ]$)"
)


def plain(name: str) -> str:
    """Return a name without case, blanks, hyphens and "DEG": "E-W" is "EW", "90 Deg" is "90"."""
    text = re.sub(r"\([^()]*\)", "", name.strip().upper())
    text = re.sub(r"\s*\bDEG(REES?)?\b\.?", "", text.strip())
    return re.sub(r"[\s-]", "", text)


def orientation(name: str) -> Orientation:
    """Tell where a component points.

    Args:
        name: e.g. "EW", "U-D", "N28W", "90 DEG", "DWN", "HNE", "EW2", "090 (STATION)", "acc_NS", "table_ax".

    Returns:
        "east-west" also for 90 and 270 degrees; "unknown" for a name that is none of the agencies'.
    """
    text = plain(name)
    if text in _TABLE:
        return _TABLE[text]
    if re.fullmatch(r"\s*-\s*(?:V|Z|UP|VERT|VERTICAL)\s*", name, re.IGNORECASE):
        return "down"
    text = plain(_MEASURED.sub("", re.sub(r"\([^()]*\)", "", name.strip().upper())))
    numbered, seed = _KIKNET.fullmatch(text), _SEED.fullmatch(text)
    if numbered:
        text = numbered[1]
    elif seed:
        text = {"1": "H1", "2": "H2", "3": "Z", "V": "H1", "W": "H2", "U": "Z"}.get(seed[1], seed[1])
    if text in _TABLE:
        return _TABLE[text]
    if text in _UP:
        return "up"
    if text in _DOWN:
        return "down"
    bearing = re.fullmatch(r"[NS](\d{1,2})[EWO]", text)
    azimuth = re.fullmatch(r"\d{1,3}", text)
    if text in _EAST_WEST or text in ("90", "090", "270") or (bearing and bearing[1] == "90"):
        return "east-west"
    if text in _HORIZONTAL or (bearing and int(bearing[1]) <= 90) or (azimuth and int(text) <= 360):
        return "horizontal"
    return "unknown"


def sensor_of(name: str) -> str:
    """Tell which sensor of a KiK-net station a component's name means, "" for other names: "EW1" is the borehole's."""
    numbered = _KIKNET.fullmatch(plain(name))
    return {"1": "borehole", "2": "surface"}[numbered[2]] if numbered else ""


def component_of(stated: Statements) -> str:
    """Return the component that a header states, "" if it states none that is known."""
    return next((value for value in stated.texts.get("component", ()) if orientation(value) != "unknown"), "")


def name_from_stem(stem: str) -> str:
    """Return the component's name that a file name ends in, "" if it ends in none: "TCU065-E", "TAK-090", "ABBAR--L".

    The format of a file is never taken from its name; the component is, when the file itself does not say it.
    """
    last = re.split(r"[-_. ]", stem)[-1]
    if orientation(last) == "unknown" or (last.isdigit() and len(last) != 3):
        return ""
    return last
