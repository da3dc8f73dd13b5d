"""An MJCF file as text, as it is written and as MuJoCo compiles it."""

import warnings
from dataclasses import dataclass
from pathlib import Path

import mujoco

from slipwise.errors import InputError, visible
from slipwise.rig.bounds import out_of_bounds
from slipwise.rig.mjcf.text import Element, place_of, read_elements

#: What MuJoCo says of an element that an included file holds.
_INCLUDED = "line 0"


@dataclass(frozen=True)
class Mjcf:
    """The file of a rig.

    Attributes:
        path: of the file.
        elements: all that is written in it and in what it includes.
        spec: every element with its attributes, defaults in their places.
        model: what MuJoCo makes of it: frames, angles and inertias resolved.
    """

    path: Path
    elements: tuple[Element, ...]
    spec: mujoco.MjSpec
    model: mujoco.MjModel

    def refused(
        self, words: str, kind: str = "", name: str = "", within: str = "", key: str = "", info: str = ""
    ) -> InputError:
        """Make the error that names the element, with its file and line where it is written.

        Args:
            words: what is wrong, what is possible and what to do.
            kind: of the element: a tag, "tendon" or "actuator"; "" for the file as a whole.
            name: of the element.
            within: name of the element around it.
            key: an attribute of an element without a name.
            info: where MuJoCo says that it stands, for elements that the text does not tell apart.
        """
        place = place_of(self.elements, kind, name, within, key)
        if not place and info.startswith("line") and info != _INCLUDED:
            place = f"{self.path.name}, {info}"
        return InputError(f"{place or self.path.name}: {visible(words)}")


def read_mjcf(path: Path) -> Mjcf:
    """Read and compile an MJCF file.

    Raises:
        InputError: it is no MJCF, or no model that MuJoCo can build.
    """
    elements = read_elements(path)
    _check_inertia(elements)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of what MuJoCo warns, all is judged later
            spec = mujoco.MjSpec.from_file(str(path))
            model = spec.compile()
    except (ValueError, OSError, mujoco.FatalError) as error:
        words = "; ".join(line.strip() for line in visible(str(error)).splitlines() if line.strip())
        raise InputError(f"{path.name} cannot be read by MuJoCo: {words}") from None
    return Mjcf(path, elements, spec, model)


def _check_inertia(elements: tuple[Element, ...]) -> None:
    """Refuse a mass or inertia that no girder has, before MuJoCo computes with it."""
    for element in elements:
        if element.tag != "inertial" or element.within != "girder":
            continue
        for key, quantity in (("mass", "mass"), ("diaginertia", "inertia")):
            try:
                given = [float(word) for word in element.attributes.get(key, "").split()]
            except ValueError:
                continue  # MuJoCo names what is no number
            if wrong := out_of_bounds(quantity, given):
                raise InputError(f"{element.place}: {wrong}")
