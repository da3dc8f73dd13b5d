"""One column of a laboratory's file as its header tells it: unit, kind, words, and the pad that it counts or names."""

import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import PADS
from slipwise.errors import UnitError
from slipwise.units import affine

Array = NDArray[np.float64]
_HEADER = re.compile(r"^\s*(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*$")
_KINDS = (("time", "s"), ("acceleration", "m/s^2"), ("force", "N"), ("length", "m"), ("speed", "m/s"), ("angle", "rad"))
#: What pads are called that files only count: of a girder on three to twelve.
LETTERS = "ABCDEFGHIJKL"
_PAD = {"pad", "bearing", "slider", "cell", "lc", "lager", "support"}


@dataclass(frozen=True)
class Column:
    """A column of a file that is not named as we do.

    Attributes:
        header: as it stands there.
        unit: as written.
        kind: "time", "acceleration", "force", "length", "speed", "angle", or "" where the unit says nothing.
        words: of its name, in lower case.
        number: that its name holds, 1 for "LC1" and "pad A"; None without one.
        values: (n,) SI.
    """

    header: str
    unit: str
    kind: str
    words: frozenset[str]
    number: int | None
    values: Array


@dataclass(frozen=True)
class Mapped:
    """A column that was recognised: its channel, its sign, why, and how sure that is."""

    channel: str
    unit: str
    sign: int
    why: str
    sure: str


def column_of(header: str, values: Array) -> Column:
    """Look at one column; values as written (n,)."""
    found = _HEADER.match(header)
    name, unit = (found["name"], found["unit"]) if found else (header, "")
    kind, si = "", values
    for known, si_unit in _KINDS:
        try:
            factor, offset = affine(unit, si_unit, header)
        except UnitError:
            continue
        kind, si = known, factor * values + offset
        break
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=\d)(?=[A-Za-z])|(?<=[A-Za-z])(?=\d)", " ", name)
    words = [word for word in re.split(r"[^A-Za-z0-9]+", spaced.lower()) if word]
    numbers = [int(word) for word in words if word.isdigit()]
    letters = [LETTERS.index(w.upper()) + 1 for before, w in pairwise(["", *words]) if _is_letter(w, before)]
    number = numbers[0] if numbers else letters[0] if letters else None
    return Column(header, unit, kind, frozenset(words), number, si)


def _is_letter(word: str, before: str) -> bool:
    """Tell a pad's letter: A to D alone, others behind the word for a pad; "h" or "g" alone mean something else."""
    return word.upper() in PADS or (len(word) == 1 and word.upper() in LETTERS and before in _PAD)
