"""The text of an MJCF file: every element with its file and line, so that a message can name it.

MuJoCo knows the lines of the file that it is given, of an included one it does not; and it reads "nan" as a number.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

from slipwise.errors import InputError, visible
from slipwise.input_file import read_input

#: Elements that write others: their names and lines are nowhere in the file, and one can stand for a million.
_MACROS = ("replicate", "composite", "flexcomp", "attach")
#: Free words, which may say "nan".
_WORDS = ("name", "class", "data", "file", "model", "prefix")
#: Tags of what goes by another name here.
_TAGS: Mapping[str, tuple[str, ...]] = {
    "tendon": ("fixed", "spatial"),
    "actuator": (
        *("general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle", "adhesion"),
        *("dcmotor", "plugin"),
    ),
}


@dataclass(frozen=True)
class Element:
    """An element of an MJCF file.

    Attributes:
        tag: e.g. "geom".
        attributes: as written.
        within: name of the element around it.
        place: its file and line, e.g. "mine.xml, line 12".
    """

    tag: str
    attributes: Mapping[str, str]
    within: str
    place: str


def read_elements(path: Path) -> tuple[Element, ...]:
    """Read all elements of an MJCF file and of those that it includes, in order.

    Raises:
        InputError: it is no XML or no MJCF, an included file is missing, or a number is not finite.
    """
    found: list[Element] = []
    _read(path, path.parent, "", found, set())
    return tuple(found)


def place_of(elements: tuple[Element, ...], kind: str, name: str, within: str = "", key: str = "") -> str:
    """Return the place of an element by its name, by what is around it or by what it says; "" where it is not written.

    Args:
        elements: of the file.
        kind: a tag, "tendon" or "actuator".
        name: its name; "" for an element that has none.
        within: name of the element around it.
        key: an attribute that it has. Of several without a name the last one counts.
    """
    if not (name or within or key):
        return ""
    tags = _TAGS.get(kind, (kind,))
    places = [
        element.place
        for element in elements
        if element.tag in tags
        and element.attributes.get("name", "") == name
        and within in ("", element.within)
        and (not key or key in element.attributes)
    ]
    return places[-1] if places else ""


def _read(path: Path, folder: Path, place: str, found: list[Element], seen: set[Path]) -> None:
    if path.resolve() in seen:
        raise InputError(f"{place}: {path.name} is included twice; include it once")
    seen.add(path.resolve())
    try:
        content = read_input(path)
    except OSError as error:
        raise InputError(f"{place or path.name}: {path.name} cannot be read ({error.strerror})") from None
    parser = expat.ParserCreate()
    around: list[str] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        place = f"{path.name}, line {parser.CurrentLineNumber}"
        if not around and tag not in ("mujoco", "mujocoinclude"):
            raise InputError(f"{place}: this is a <{visible(tag)}>; the file of a rig is an MJCF, which is a <mujoco>")
        if tag in _MACROS:
            raise InputError(f"{place}: <{tag}> is not read; write the elements that it stands for")
        _check_numbers(tag, attributes, place)
        found.append(Element(tag, attributes, around[-1] if around else "", place))
        around.append(attributes.get("name", ""))
        if tag == "include":
            _read(folder / attributes.get("file", ""), folder, place, found, seen)

    def end(tag: str) -> None:
        around.pop()

    parser.StartElementHandler, parser.EndElementHandler = start, end
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise InputError(f"{path.name} is no XML that can be read: {error}") from None


def _check_numbers(tag: str, attributes: Mapping[str, str], place: str) -> None:
    """Refuse what MuJoCo reads as infinite or as no number at all; a range may be open."""
    for key, text in attributes.items():
        if key in _WORDS and tag != "numeric" or key.endswith("range"):
            continue
        for word in text.split():
            try:
                fine = math.isfinite(float(word))
            except ValueError:
                continue
            if not fine:
                name = f" {visible(attributes['name'])!r}" if "name" in attributes else ""
                raise InputError(f"{place}: {key}={visible(text)!r} of the {tag}{name} must be finite numbers")
