"""A rig in ten lines: specimen.toml, with units, read into a specimen.

mass = "12 t"
box = ["4 m", "3 m", "0.5 m"]
centre_height = "0.4 m"
pad = { radius = "25 mm", stiffness = "200 kN/mm" }
[pads]
A = { x = "1.8 m", y = "1.3 m" }
...
[buffers]
1 = { x = "0 m", y = "0 m", stiffness = "1.5 kN/mm" }
"""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.errors import InputError, SettingError, unknown_name
from slipwise.input_file import read_input
from slipwise.rig.known import SPECIMEN_UNITS, SPECIMEN_WORDS
from slipwise.rig.places import Buffer, Place
from slipwise.rig.specimen import Specimen
from slipwise.rig.statics import at_rest
from slipwise.rig.storeys import Storey
from slipwise.units import quantity

_PAD = {
    "x": "m", "y": "m", "z": "m", "radius": "m", "stiffness": "N/m", "damping": "N*s/m", "radius_of_curvature": "m",
}  # fmt: skip
_BUFFER = {
    "x": "m", "y": "m", "z": "m", "stiffness": "N/m", "stiffness_x": "N/m", "stiffness_y": "N/m", "gap": "m",
}  # fmt: skip
_STOREY = {
    "mass": "kg", "z": "m", "stiffness": "N/m", "stiffness_x": "N/m", "stiffness_y": "N/m", "damping": "N*s/m",
    "damping_x": "N*s/m", "damping_y": "N*s/m",
}  # fmt: skip
#: Quantities of the girder; what is said of all pads or buffers stands in `pad`, [pads] and [buffers].
_GIRDER = {n: u for n, u in SPECIMEN_UNITS.items() if not n.startswith(("pad_", "buffer_"))} | {"edge_distance": "m"}
_TABLES = ("box", "inertia", "pad", "pads", "buffers", "storeys", "sources")
#: Damping of heave, and of a storey, where none is given: fraction of critical [1]. Assumed.
_CRITICAL = 0.05
_OF_A_STOREY = 0.02
_EXAMPLE = {"mass": "12 t", "centre_height": "0.4 m"}
#: What stands where nothing is given, and why.
_USUAL: Mapping[str, tuple[float, str]] = {
    "gravity": (9.80665, "assumed: standard gravity"),
    "plastic_pressure": (9.803921568627451e6, "assumed: that of bridge1"),
    "shear_strength": (1.108676e6, "assumed: that of bridge1"),
}


def read_specimen(path: Path) -> Specimen:
    """Read a specimen.toml.

    Raises:
        InputError: it cannot be read, a value is missing, or no rig can have it; the message names file and key.
        UnitError: a quantity without a unit, or with one of the wrong dimension.
        UnknownNameError: a key that is not known.
    """
    try:
        content = tomllib.loads(read_input(path).decode("utf-8-sig"))
    except (OSError, tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"{path.name} cannot be read: {error}") from None
    try:
        specimen = _specimen(path, content)
        at_rest(specimen)
    except SettingError as error:
        raise InputError(f"{path.name}: {error}") from None
    return specimen


def _specimen(path: Path, content: Mapping[str, Any]) -> Specimen:
    where = path.name
    _check_keys(content, (*_GIRDER, *_TABLES, *SPECIMEN_WORDS, "free"), where)
    given = {n: quantity(content[n], unit, f"{where}, {n!r}") for n, unit in _GIRDER.items() if n in content}
    for needed in ("mass", "centre_height"):
        if needed not in given:
            raise InputError(f'{where} lacks {needed}; write for example {needed} = "{_EXAMPLE[needed]}"')
    stated = ("inertia", "pad_places", "pad_radius", "pad_stiffness", "pad_damping")
    sources = dict.fromkeys((*given, *stated), where)
    if content.get("buffers"):
        sources |= {"buffer_stiffness": where, "buffer_place": where, "buffer_height": where}
    by_hand = tuple(given)
    for name, (value, why) in _USUAL.items():
        if name not in given:
            given[name], sources[name] = value, why
    free = content.get("free", True)
    if not isinstance(free, bool):
        raise InputError(f"{where}: free = {free!r}; write true, or false where the slip of one pad is prescribed")
    places = _places(content, where)
    if any(place.curvature for place in places):
        sources["pad_curvature"] = where
    if any(np.isnan(place.damping) for place in places):
        places, sources["pad_damping"] = _damped(places, given), f"assumed: {_CRITICAL:.0%} of critical in heave"
    given.setdefault("edge_distance", max((abs(place.x) for place in places), default=0.0) or 1.5)
    words: dict[str, Any] = {name: _word(content, name, where) for name in SPECIMEN_WORDS if name in content}
    return Specimen(
        name=path.parent.resolve().name if path.stem == "specimen" else path.stem,
        path=path,
        inertia=_inertia(content, given["mass"], where),
        places=places,
        buffers=_buffers(content, where),
        storeys=_storeys(content, where),
        free=free,
        sources=sources | {n: str(words) for n, words in _table(content, "sources", where).items()},
        stated=by_hand,
        **given,
        **words,
    )


def _check_keys(given: Iterable[str], possible: Iterable[str], where: str) -> None:
    for key in given:
        if key not in tuple(possible):
            raise unknown_name(f"key in {where}", key, tuple(possible))


def _table(content: Mapping[str, Any], name: str, where: str) -> Mapping[str, Any]:
    given = content.get(name, {})
    if not isinstance(given, dict):
        raise InputError(f"{where}: {name} = {given!r}; write it as a table, [{name}]")
    return given


def _word(content: Mapping[str, Any], name: str, where: str) -> str:
    if not isinstance(content[name], str):
        raise InputError(f"{where}: {name} must be a text in quotes, not {content[name]!r}")
    return str(content[name])


def _three(content: Mapping[str, Any], name: str, unit: str, where: str) -> list[float]:
    given = content[name]
    if not isinstance(given, list) or len(given) != 3:
        raise InputError(f'{where}: {name} = {given!r}; give three, along x, y and z, as ["4 m", "3 m", "0.5 m"]')
    return [quantity(value, unit, f"{where}, {name!r}") for value in given]


def _inertia(content: Mapping[str, Any], mass: float, where: str) -> tuple[float, float, float]:
    """Return roll, pitch and yaw inertia [kg m^2]: as given, or of a box of even density, m (b^2 + c^2) / 12."""
    if ("box" in content) == ("inertia" in content):
        raise InputError(
            f'{where} needs one of box = ["4 m", "3 m", "0.5 m"], the girder along x, y and z, and inertia = '
            '["... kg m^2", ...] about x, y and z'
        )
    if "inertia" in content:
        roll, pitch, yaw = _three(content, "inertia", "kg*m^2", where)
        return roll, pitch, yaw
    x, y, z = (side**2 * mass / 12.0 for side in _three(content, "box", "m", where))
    return y + z, x + z, x + y


def _quantities(given: Any, units: Mapping[str, str], where: str) -> dict[str, float]:
    if not isinstance(given, dict):
        raise InputError(f'{where} = {given!r}; write it as {{ x = "1.8 m", y = "1.3 m" }}')
    _check_keys(given, units, where)
    return {key: quantity(value, units[key], f"{where}, {key!r}") for key, value in given.items()}


def _places(content: Mapping[str, Any], where: str) -> tuple[Place, ...]:
    """Collect the pads: what `pad` says of all, then what each says of itself; damping is NaN where nobody says it."""
    shared = _quantities(content.get("pad", {}), {k: u for k, u in _PAD.items() if k not in "xy"}, f"{where}, pad")
    out = []
    for name, given in _table(content, "pads", where).items():
        here = f"{where}, pad {name}"
        values = {"z": 0.0, "damping": float("nan")} | shared | _quantities(given, _PAD, here)
        for needed in ("x", "y", "radius", "stiffness"):
            if needed not in values:
                raise InputError(f"{here} lacks {needed}; give it there, or for every pad in pad = {{ ... }}")
        if not (bend := values.pop("radius_of_curvature", float("inf"))):
            raise InputError(f"{here}: radius_of_curvature = 0 m cannot be; leave it out where the plate is flat")
        values["curvature"] = 1.0 / bend
        out.append(Place(name, **values))
    return tuple(out)


def _damped(places: tuple[Place, ...], given: Mapping[str, float]) -> tuple[Place, ...]:
    """Return pads the damping that is assumed where none is given: each in proportion to its stiffness."""
    total = sum(place.stiffness for place in places)
    share = 2.0 * _CRITICAL * (given["mass"] / total) ** 0.5 if total > 0.0 and given["mass"] > 0.0 else 0.0
    return tuple(replace(p, damping=share * p.stiffness) if np.isnan(p.damping) else p for p in places)


def _buffers(content: Mapping[str, Any], where: str) -> tuple[Buffer, ...]:
    out = []
    for name, given in _table(content, "buffers", where).items():
        here = f"{where}, buffer {name}"
        values = {"z": 0.0, "gap": 0.0} | _quantities(given, _BUFFER, here)
        _both_ways(values, "stiffness")
        for needed in ("x", "y", "stiffness_x", "stiffness_y"):
            if needed not in values:
                raise InputError(f"{here} lacks {needed}; a buffer has x, y and stiffness, or stiffness_x and _y")
        out.append(Buffer(name, **values))
    return tuple(out)


def _both_ways(values: dict[str, float], name: str) -> None:
    """Take what is said of both directions for each of which nothing is said, in place."""
    both = values.pop(name, None)
    for axis in "xy":
        if both is not None:
            values.setdefault(f"{name}_{axis}", both)


def _storeys(content: Mapping[str, Any], where: str) -> tuple[Storey, ...]:
    """Collect the storeys, from below; one without damping has 2 % of critical as if its floor stood alone on it."""
    given = content.get("storeys", [])
    if not isinstance(given, list):
        raise InputError(f'{where}: storeys = {given!r}; write each as a table [[storeys]] with mass = "2 t"')
    out = []
    for number, table in enumerate(given, 1):
        here = f"{where}, storey {number}"
        values = _quantities(table, _STOREY, here)
        _both_ways(values, "stiffness")
        _both_ways(values, "damping")
        for needed in ("mass", "z", "stiffness_x", "stiffness_y"):
            if needed not in values:
                unknown = (
                    "; motions tell no mass: where no drawing does, write that of the girder"
                    if needed == "mass"
                    else ""
                )
                raise InputError(
                    f"{here} lacks {needed}; a storey has mass, z and stiffness, or stiffness_x and _y{unknown}"
                )
        for axis in "xy":
            alone = 2.0 * _OF_A_STOREY * (abs(values["mass"] * values[f"stiffness_{axis}"])) ** 0.5
            values.setdefault(f"damping_{axis}", alone)
        out.append(Storey(**values))
    return tuple(out)
