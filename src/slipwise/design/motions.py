"""Table motions that laboratories make, and what of them a table can do."""

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from slipwise.errors import SettingError, UnitError
from slipwise.motion import displacement_peak, parse_motion, velocity_peak
from slipwise.units import quantity

#: Motions that laboratories make: slow and fast, small and large, with and without vertical part.
LIBRARY: tuple[str, ...] = (
    "sine:0.5Hz,0.03g,cycles=9",
    "triangle:0.25Hz,3cm/s,cycles=4",
    "sine:1.6Hz,0.2g,cycles=12",
    "sine:1.6Hz,0.2g,cycles=12,vertical=5Hz,0.25g",
    "sine:4.2Hz,0.5g,cycles=24",
    "sine:4.2Hz,0.5g,cycles=24,vertical=6.5Hz,0.3g",
    "quake:seed=1,peak=0.4g,f=4Hz,strong=4s",
    "quake:seed=2,peak=0.7g,f=4Hz,strong=4s,vertical=0.3g",
    "quake:seed=3,peak=0.7g,f=3Hz,strong=5s,vertical=0.6g",
)
#: A smaller motion is made smaller by this share more, so that three figures do not round it beyond the limits [1].
_ROUNDING = 0.005
_NUMBER_AND_UNIT = re.compile(r"([\d.]+(?:[eE][-+]?\d+)?)(\s*[A-Za-z].*)")


@dataclass(frozen=True)
class Limits:
    """What the table can do. Source of the defaults: DPRI, Kyoto University, the paper's table.

    Attributes:
        stroke: from the middle [m].
        speed: [m/s].
        acceleration: [m/s^2].
    """

    stroke: float = 0.3
    speed: float = 1.5
    acceleration: float = 9.8

    def __post_init__(self) -> None:
        """Refuse what no table is limited to."""
        for name, unit in (("stroke", "m"), ("speed", "m/s"), ("acceleration", "m/s^2")):
            value = getattr(self, name)
            if not 0.0 < value < np.inf:
                raise SettingError(f"a table with a {name} of {value:g} {unit} cannot be; give a value above zero")


def motions_for(library: Sequence[str], limits: Limits) -> dict[str, str]:
    """Return motion -> why the table cannot make it; where it cannot, also the motion as far as it can."""
    out: dict[str, str] = {}
    for text in library:
        refused, share = _beyond(text, limits)
        if refused:
            smaller = ",".join(_times(part, (1.0 - _ROUNDING) * share) for part in text.split(","))
            if not _beyond(smaller, limits)[0]:
                out[smaller] = ""
        out[text] = refused
    return out


def _beyond(text: str, limits: Limits) -> tuple[str, float]:
    """Return where a motion exceeds the limits, in words, and the share of it that the table can do [1]."""
    motion = parse_motion(text)
    reached = {
        "stroke": (float(displacement_peak(motion, "none").max()), limits.stroke, "m"),
        "speed": (float(velocity_peak(motion, "none").max()), limits.speed, "m/s"),
        "acceleration": (float(motion.peaks.max()), limits.acceleration, "m/s^2"),
    }
    over = {name: each for name, each in reached.items() if each[0] > each[1]}
    words = [f"{name} {have:.2g} of {can:.2g} {unit}" for name, (have, can, unit) in over.items()]
    return ", ".join(words), min((can / have for have, can, _ in over.values()), default=1.0)


def _times(part: str, share: float) -> str:
    """Return a part of a motion's text, "vertical=5Hz" or "0.25g", with its acceleration or speed times a share."""
    start = max(part.rfind(":"), part.rfind("=")) + 1
    found = _NUMBER_AND_UNIT.fullmatch(part[start:].strip())
    if found is None:
        return part
    for dimension in ("m/s^2", "m/s"):
        with suppress(UnitError):
            quantity(found[0], dimension, part)
            return f"{part[:start]}{share * float(found[1]):.3g}{found[2]}"
    return part
