"""Objects in MATLAB files: tables, timetables, timeseries, datetimes hold what only MATLAB can read.

They are left out by name, with what to write in MATLAB instead.
"""

import struct
from collections.abc import Mapping

#: Class of an object -> what to write in MATLAB, for a variable called {0}.
_INSTEAD = {
    "timeseries": "t = {0}.Time; x = squeeze({0}.Data);",
    "timetable": "t = seconds({0}.Properties.RowTimes - {0}.Properties.RowTimes(1)); x = {0}.Variables;",
    "table": "x = {0}.Variables;",
    "datetime": "t = seconds({0} - {0}(1));",
    "duration": "t = seconds({0});",
}
#: An array's flags hold its class in their lowest byte; this one is that of objects.
_OPAQUE = 17
_FLAGS, _NAME = 16, 24


def object_of(head: bytes, order: str) -> tuple[str, str] | None:
    """Return name and class of the object that an element of a version 5 file holds, else None.

    Args:
        head: the beginning of the element, unpacked.
        order: of its bytes, "<" or ">".
    """
    try:
        if struct.unpack_from(f"{order}I", head, _FLAGS)[0] & 0xFF != _OPAQUE:
            return None
        at, texts = _NAME, []
        for _ in range(3):  # its name, the system of classes, its class
            kind, size = struct.unpack_from(f"{order}II", head, at)
            if kind >> 16:  # a short text stands in the tag itself
                size, at, step = kind >> 16, at + 4, 4
            else:
                at, step = at + 8, -(-size // 8) * 8
            texts.append(head[at : at + size].decode("ascii", "replace"))
            at += step
    except struct.error:
        return None
    return texts[0], texts[2]


def left_out(objects: Mapping[str, str]) -> str:
    """Say which objects are left out and what to do, "" where there are none.

    Args:
        objects: name -> class.
    """
    if not objects:
        return ""
    listed = " and ".join(f"{name} ({kind})" for name, kind in objects.items())
    what = "is an object of MATLAB" if len(objects) == 1 else "are objects of MATLAB"
    instead = " ".join(_INSTEAD[kind].format(name) for name, kind in objects.items() if kind in _INSTEAD)
    cure = f"save times and data as vectors: {instead}" if instead else "save their numbers as vectors"
    return f"{listed} {what} and left out; {cure}"
