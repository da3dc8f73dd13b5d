"""Name and unit in a column's header: "Slip [mm]", "Zeit / s", "Time, s", "Weg in mm", "force_N", "posMm", "Time s"."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from slipwise.channels import channel, is_channel
from slipwise.data_files.column_words import meanings_of, words_of
from slipwise.errors import UnitError
from slipwise.units import parse_unit

#: Kind of a quantity -> its SI unit.
KINDS: tuple[tuple[str, str], ...] = (
    ("time", "s"), ("acceleration", "m/s^2"), ("force", "N"), ("length", "m"), ("speed", "m/s"), ("angle", "rad"),
    ("pressure", "Pa"), ("temperature", "K"), ("coefficient", "1"),
)  # fmt: skip
_BRACKETS = re.compile(r"^\s*(?P<name>.*?)[\s/]*[\[(](?P<unit>[^\])]*)[\])]\s*$")
#: "Zeit / s", "Time, s", "Weg in mm"; then, without a sign between them, "force_N" and "Time s".
_BETWEEN = re.compile(r"^\s*(?P<name>.*\S)(?:\s*[/,;]\s*|\s+(?:in|en)\s+)(?P<unit>\S+)\s*$")
_LAST = re.compile(r"^\s*(?P<name>.*[^\W_])[_\s]+(?P<unit>[^\W_]+[/^*-]?\w*)\s*$")
_CAMEL = re.compile(r"^\s*(?P<name>.*[a-z])(?P<unit>[A-Z][A-Za-z]*)\s*$")
_LAST_TWO = re.compile(r"^\s*(?P<name>.*[^\W_])[_\s]+(?P<over>[^\W_]+)[_\s](?P<under>s\d?)\s*$")
_CYRILLIC = {"с": "s", "мс": "ms", "м": "m", "мм": "mm", "см": "cm", "н": "N", "кн": "kN", "мпа": "MPa", "мм/с": "mm/s"}
#: What stands for a unit in names that can hold no sign, or in another script.
_SPELLED = {"ms2": "m/s^2", "mss": "m/s^2", "mps2": "m/s^2", "mps": "m/s", "mmps": "mm/s", "mms": "mm/s", **_CYRILLIC}
#: A column of a matrix that a single letter names, which says nothing of any of them: x(:,3).
_OF_MATRIX = re.compile(r"^\w\((?::,\d+|\d+,:)\)$")
#: Letters that are a quantity before a direction.
_SYMBOLS = {"v": "speed", "a": "acceleration", "f": "force", "u": "length", "d": "length", "s": "length"}
#: Words that are a unit of time themselves.
_CLOCKS = {"millis": "ms", "milis": "ms", "micros": "us", "mikros": "us"}


@dataclass(frozen=True)
class ColumnName:
    """A header taken apart.

    Attributes:
        name: without the unit.
        unit: as written, in a spelling that can be read; "?" where the header states none, "" for a pure number.
        kind: the quantity that the unit is of, or that the words mean; "" where neither says it.
    """

    name: str
    unit: str
    kind: str


def name_and_unit(header: str) -> ColumnName:
    """Take a header apart; a unit without brackets counts where it is of the quantity that the words mean."""
    if _OF_MATRIX.match(header):
        return ColumnName("", "?", "")
    if is_channel(header.strip()):
        return ColumnName(header.strip(), "?", kind_of(channel(header.strip()).unit) or "")
    found = _BRACKETS.match(header)
    if found and (unit := _readable(found["unit"])) is not None and found["name"]:
        return ColumnName(found["name"], unit, kind_of(unit) or "")
    for name, unit in _candidates(header):
        readable, meant = _readable(unit), meanings_of(words_of(name))
        kind = kind_of(readable) if readable else None
        if kind is None or readable is None or _is_symbol(header):
            continue
        quantities = {known for known, _ in KINDS} & (meant | ({"force"} if meant & {"loading", "load"} else set()))
        if kind in quantities or (not quantities and (is_channel(name) or len(readable) > 1 or meant)):
            return ColumnName(name, readable, kind)
    words = words_of(header)
    clock = next((unit for word in words for known, unit in _CLOCKS.items() if word.startswith(known)), None)
    if clock is not None:
        return ColumnName(header.strip(), clock, "time")
    unit = _readable(header) if len(header.strip()) > 1 and not meanings_of(words) else None
    if unit and (kind := kind_of(unit)) is not None:  # a column that only its unit names
        return ColumnName(header.strip(), unit, kind)
    return ColumnName(header.strip(), "?", _kind_of_words(header))


def _candidates(header: str) -> Iterator[tuple[str, str]]:
    """Yield name and unit for each way to write them, the surest first."""
    if found := _BETWEEN.match(header):
        yield found["name"], found["unit"]
    if found := _LAST_TWO.match(header):
        power = found["under"].replace("s", "s^") if found["under"] != "s" else "s"
        yield found["name"], f"{found['over']}/{power}"
    for pattern in (_LAST, _CAMEL):
        if found := pattern.match(header):
            yield found["name"], found["unit"]


def _is_symbol(header: str) -> bool:
    """Tell F_N, the normal force of every textbook, from a name and its unit."""
    return re.fullmatch(r"\s*[A-Za-z]_[A-Z]\s*", header) is not None


def _readable(text: str) -> str | None:
    """Return a unit as `units` reads it, None where the text is none."""
    text = text.strip().strip("()")
    for spelling in (_SPELLED.get(text.lower(), text), text.lower()):
        if spelling in ("", "-"):
            return ""
        if re.search(r"[:\d]", spelling[:1]):
            return None
        try:
            parse_unit(spelling, spelling, "")
        except UnitError:
            continue
        return spelling
    return None


def kind_of(unit: str) -> str | None:
    """Return the kind of quantity of a unit, None for others such as volts."""
    if unit in ("", "1", "-", "%"):
        return "coefficient"  # an angle has no dimension either
    for kind, si in KINDS:
        try:
            parse_unit(unit, si, "")
        except UnitError:
            continue
        return kind
    return None


def _kind_of_words(header: str) -> str:
    """Return the kind of quantity that the words of a name mean, "" where they mean none or several."""
    words = words_of(header)
    symbol = _SYMBOLS.get(words[0]) if len(words) == 2 and words[1] in ("x", "y", "z") else None
    if symbol is not None:  # v_x, a_x
        return symbol
    meant = meanings_of(words)
    if any(len(word) > 2 and "time" in meanings_of([word]) for word in (words or ("",))[:: max(1, len(words) - 1)]):
        return "time"  # "slip.Time" is a time, whatever it is of
    if "count" in meant and not meant & {"friction", "force"}:
        return ""
    if "coefficient" in meant:
        return "coefficient"
    # "normal" or "friction" alone is a force; "x" alone a displacement, though "Fx" and "acc x" are not.
    for kind in ("temperature", "acceleration", "pressure"):
        if kind in meant and not meant & {"force"}:
            return kind
    if meant & {"force", "loading"}:
        return "force"
    for kind in ("speed", "time"):
        if kind in meant and "length" not in meant:
            return kind
    if "length" in meant and not meant & {"friction"}:
        return "length"
    return "force" if meant & {"load", "friction"} else next((k for k in ("length", "speed", "time") if k in meant), "")
