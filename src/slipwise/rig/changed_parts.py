"""Other values for all pads, or for all buffers, of a specimen at once."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from slipwise.errors import SettingError
from slipwise.rig.places import Buffer, Place, mean

Part = TypeVar("Part", Place, Buffer)
#: What a specimen tells of its pads and buffers -> the fields of each that it is.
PART_VALUES: Mapping[str, tuple[str, ...]] = {
    "pad_places": ("x", "y"),
    "pad_radius": ("radius",),
    "pad_stiffness": ("stiffness",),
    "pad_damping": ("damping",),
    "seating": ("z",),
    "buffer_places": ("x", "y"),
    "buffer_stiffness": ("stiffness_x", "stiffness_y"),
    "buffer_height": ("z",),
}
#: Where one number for all keeps the ratios in which they differ.
_SCALED = ("pad_radius", "pad_stiffness", "pad_damping", "buffer_stiffness")


def changed_parts(rig: str, name: str, parts: Sequence[Part], given: Any) -> tuple[Part, ...]:
    """Return pads or buffers with other values.

    Args:
        rig: its name, for the message.
        name: of `PART_VALUES`.
        parts: to change.
        given: one number for all, or a value for each; `pad_places` and `buffer_places` are (n, 2).

    Raises:
        SettingError: there is not one for each.
    """
    if np.ndim(given) and len(given) != len(parts):
        what = "buffer" if name.startswith("buffer") else "pad"
        raise SettingError(f"{rig}: {len(given)} values of {name} and {len(parts)} {what}s; give one for each")
    if not parts:
        return ()
    fields = PART_VALUES[name]
    if fields == ("x", "y"):
        return tuple(replace(p, x=float(x), y=float(y)) for p, (x, y) in zip(parts, given, strict=True))
    first = [getattr(part, fields[0]) for part in parts]
    if np.ndim(given):
        wanted = [float(value) for value in given]
    elif name in _SCALED and mean(first) != 0.0:
        wanted = [old / mean(first) * given for old in first]
    else:
        wanted = [float(given)] * len(parts)
    return tuple(
        replace(part, **_fields(part, fields, new, old)) for part, new, old in zip(parts, wanted, first, strict=True)
    )


def _fields(part: Place | Buffer, fields: Sequence[str], new: float, old: float) -> dict[str, float]:
    """Return the new value of each field: those behind the first keep their ratio to it."""
    further = {f: getattr(part, f) / old * new if old else new for f in fields[1:]}
    return {fields[0]: new, **further}
