"""Where a girder is held: its pads and its buffers, each with a place, a size and a stiffness of its own."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from slipwise.errors import SettingError
from slipwise.rig.bounds import out_of_bounds

#: What pads and buffers are called: a word of the channels' grammar.
_WORD = re.compile(r"[A-Za-z0-9]+")
#: Each pad meets its own plate only, by one bit of the 31 that MuJoCo has for it.
MOST_PADS = 31


@dataclass(frozen=True)
class Place:
    """A pad: a disc that slides, on a load cell.

    Attributes:
        name: a word of letters and digits; its channels are pad_<name>_N and so on.
        x: from the middle of the table, along the shaking direction [m].
        y: the same across [m].
        z: height above the sliding plane [m]; 0 where the girder lies evenly.
        radius: of the sliding disc [m].
        stiffness: vertical, of the pad with its cell [N/m].
        damping: vertical [N s/m].
        curvature: 1/R of its sliding face, above zero for a bowl: a pendulum; 0 for a flat plate [1/m].
    """

    name: str
    x: float
    y: float
    z: float
    radius: float
    stiffness: float
    damping: float
    curvature: float = 0.0


@dataclass(frozen=True)
class Buffer:
    """A spring between table and girder that carries no weight.

    Attributes:
        name: a word of letters and digits; its channels are buffer_<name>_Fx and _Fy.
        x: from the middle of the table, along the shaking direction [m].
        y: the same across [m].
        z: height of its force above the sliding plane [m].
        stiffness_x: along x [N/m].
        stiffness_y: along y [N/m].
        gap: way to either side before the girder touches it [m].
    """

    name: str
    x: float
    y: float
    z: float
    stiffness_x: float
    stiffness_y: float
    gap: float = 0.0


def mean(values: Iterable[float]) -> float:
    """Return the mean of values; of equal ones their value, to the last digit."""
    found = tuple(values)
    return found[0] if len(set(found)) == 1 else sum(found) / len(found)


def check_parts(rig: str, what: str, parts: Sequence[Place] | Sequence[Buffer]) -> None:
    """Refuse values that no pad or buffer has, names that no channel can have, and one that is given twice.

    Args:
        rig: its name, for the message.
        what: "pad" or "buffer".
        parts: of the rig.

    Raises:
        SettingError: the message gives the name.
    """
    seen: set[str] = set()
    for part in parts:
        if not _WORD.fullmatch(part.name):
            raise SettingError(
                f"{rig}: a {what} is called {part.name!r}; give it a word of letters and digits, as A or P12"
            )
        if part.name in seen:
            raise SettingError(f"{rig}: two {what}s are called {part.name!r}; give each a name of its own")
        seen.add(part.name)
        for name, value in values_of(part).items():
            if wrong := out_of_bounds(name, value):
                raise SettingError(f"{rig}, {what} {part.name}: {wrong}")


def values_of(part: Place | Buffer) -> dict[str, tuple[float, ...]]:
    """Return the values of a pad or a buffer under the names that their bounds have."""
    if isinstance(part, Place):
        return {
            "pad_places": (part.x, part.y),
            "seating": (part.z,),
            "pad_radius": (part.radius,),
            "pad_stiffness": (part.stiffness,),
            "pad_damping": (part.damping,),
            "pad_curvature": (part.curvature,),
        }
    return {
        "buffer_places": (part.x, part.y),
        "buffer_height": (part.z,),
        "buffer_stiffness": (part.stiffness_x, part.stiffness_y),
        "buffer_gap": (part.gap,),
    }
