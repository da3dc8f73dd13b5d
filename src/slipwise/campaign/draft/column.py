"""One column of a laboratory's file as its header tells it: unit, kind, meaning, and the pad it counts or names."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import PADS, is_channel
from slipwise.data_files.column_names import KINDS, ColumnName, name_and_unit
from slipwise.data_files.column_words import meanings_of, words_of
from slipwise.units import affine

#: What pads are called that files only count: of a girder on three to twelve.
LETTERS = "ABCDEFGHIJKL"
_PAD = {"pad", "bearing", "slider", "cell", "lc", "lager", "support"}


@dataclass(frozen=True)
class Column:
    """A column of a file that is not named as we do.

    Attributes:
        header: as it stands there.
        unit: as written; "?" where the header states none.
        kind: of `column_names.KINDS`, from the unit, or from the name where there is none; "" where neither says it.
        meanings: of the words of its name.
        number: that its name holds, 1 for "LC1" and "pad A"; None without one.
        values: (n,) SI; as written where the unit is not known.
        channel: that it is named after, "" where it is not.
        no_channel: why no channel can be in it, "" where one can.
    """

    header: str
    unit: str
    kind: str
    meanings: frozenset[str]
    number: int | None
    values: Array
    channel: str = ""
    no_channel: str = ""


@dataclass(frozen=True)
class Mapped:
    """A column that was recognised.

    Attributes:
        channel: that it holds; with "_raw" behind it where another one is computed from it.
        unit: as written.
        sign: +1 or -1.
        why: on what that rests.
        sure: "sure", "likely" or "guess".
        derived: expression that gives the channel without "_raw"; "" where the column is the channel.
    """

    channel: str
    unit: str
    sign: int
    why: str
    sure: str
    derived: str = ""


def column_of(header: str, values: Array) -> Column:
    """Look at one column; values as written (n,)."""
    found = name_and_unit(header)
    known = dict(KINDS)
    si = values
    if found.kind and found.unit != "?":
        factor, offset = affine(found.unit, known[found.kind], header)
        si = factor * values + offset
    words = words_of(found.name)
    numbers = [int(word) for word in words if word.isdigit()]
    letters = [LETTERS.index(w.upper()) + 1 for before, w in pairwise(["", *words]) if _is_letter(w, before)]
    number = numbers[0] if numbers else letters[0] if letters else None
    channel = found.name if is_channel(found.name) else ""
    still = found.kind == "length" and len(values) > 1 and np.ptp(values) == 0.0
    why = (
        "it does not move"
        if still
        else ""
        if channel
        else _no_channel(found, meanings_of(words), meanings_of(w for w in words if len(w) > 2))
    )
    return Column(header, found.unit, found.kind, meanings_of(words), number, si, channel, why)


def _no_channel(found: ColumnName, meanings: frozenset[str], spelled: frozenset[str]) -> str:
    """Say why no channel can be in a column; spelled: what its words mean that are no symbols of one or two letters."""
    if "command" in meanings:
        return "what was commanded, not what was measured"
    if "surroundings" in meanings:
        return "measured in the surroundings"
    if "count" in meanings and found.unit in ("?", ""):
        return "it counts"
    if found.kind == "length" and "wear" in meanings and "table" not in meanings:
        return "a displacement across the sliding plane"
    if found.kind == "pressure" and "friction" in meanings:
        return "a shear stress; [derived] can make a force of it with the pad's area"
    quantities = {kind for kind, _ in KINDS} & spelled
    quantities |= {"force"} if spelled & {"load", "loading", "friction"} and not quantities else set()
    if found.unit != "?" and quantities and found.kind not in quantities:
        return f"its name says {' or '.join(sorted(quantities))}, and its unit {found.unit!r} is of something else"
    return ""


def _is_letter(word: str, before: str) -> bool:
    """Tell a pad's letter: A to D alone, others behind the word for a pad; "h" or "g" alone mean something else."""
    return word.upper() in PADS or (len(word) == 1 and word.upper() in LETTERS and before in _PAD)
