"""One [[effect]] of a model.toml: read into a use of an effect, and written from one.

[[effect]]
name = "shear_rate"
strength = "1.379 MPa"
held = ["strength"]              # what no fit changes
[effect.pads]                    # what a pad has of its own
A = { strength = "1.1 MPa" }
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import tomlkit
from tomlkit.items import InlineTable, Table

from slipwise.effects import Effect, Trust, check_trusted, find_effect, holding, load_effect
from slipwise.errors import InputError, unknown_name
from slipwise.model import EffectUse, use
from slipwise.params import Parameter, same_number
from slipwise.units import quantity

_PADS = "pads"
_HELD = "held"
_KEYS = ("name", "file", "target", _HELD, _PADS)
_Part = Table | InlineTable


def entry_use(entry: Table, path: Path, trust: Trust, *, slider: bool) -> EffectUse:
    """Read an entry.

    Args:
        entry: of the file.
        path: of the file.
        trust: effect files that may be run.
        slider: whether the rig is one slider: its sizes are of no reference rig.

    Raises:
        InputError: neither a name nor a file, values of pads that are no table, what is held is no list of names, or a
            file that is not trusted.
        UnknownNameError: an effect or a parameter that does not exist.
        UnitError: a value without a unit or of the wrong dimension.
        SettingError: a value out of bounds, or of a single pad where the effect has none.
    """
    file = _file_in(entry, path)
    if file is not None:
        check_trusted(file, path, trust)
    effect = find_effect(str(entry["name"])) if file is None else load_effect(file)
    values: dict[str, Any] = {key: entry[key] for key in entry if key not in _KEYS}
    where = f"{path.name}, effect {effect.name}"
    for name in values:
        if "[" in name:
            raise InputError(f"{where}: {name!r} is of one pad: write [effect.pads] below, with A = {{ ... }}")
    values |= _of_pads(entry, where)
    given = {name: (effect.parameter(name), value) for name, value in values.items()}
    si = {name: p.snapped(quantity(value, p.unit, f"{where}, {name}")) for name, (p, value) in given.items()}
    known = holding(effect, {**effect.typical(), **si}) if slider else effect
    return replace(use(known, str(entry.get("target", "")), **si), held=_held_in(entry, effect, where))


def _held_in(entry: Table, effect: Effect, where: str) -> tuple[str, ...]:
    """Return the names of the parameters that no fit is to change."""
    given = entry.get(_HELD, [])
    if not isinstance(given, list) or not all(isinstance(name, str) for name in given):
        raise InputError(
            f'{where}: parameters that no fit changes are written as held = ["exponent"]; held is {given!r}'
        )
    for name in given:
        if name not in effect.parameter_names:
            raise unknown_name(f"parameter of {effect.name}", name, effect.parameter_names, f"{where} holds it.")
    return tuple(str(name) for name in given)


def _of_pads(entry: Table, where: str) -> dict[str, Any]:
    """Return the values of single pads, strength[A] -> as written."""
    pads = entry.get(_PADS, {})
    right = f'{where}: values of single pads are written as [effect.pads] with A = {{ strength = "1.1 MPa" }}'
    if not isinstance(pads, Mapping):
        raise InputError(f"{right}; pads is {pads!r}")
    for pad, own in pads.items():
        if not isinstance(own, Mapping):
            raise InputError(f"{right}; pads.{pad} is {own!r}")
    return {f"{name}[{pad}]": value for pad, own in pads.items() for name, value in own.items()}


def label_of(entry: Table, path: Path) -> str:
    """Return an entry's label without running its file."""
    file = _file_in(entry, path)
    name = str(entry["name"]) if file is None else file.stem
    return f"{name}[{entry['target']}]" if entry.get("target") else name


def _file_in(entry: Table, path: Path) -> Path | None:
    """Return the effect file that an entry names, None for an effect of the catalogue."""
    if ("name" in entry) == ("file" in entry):
        raise InputError(f'{path}: each [[effect]] needs either name = "heating" or file = "mine.py"')
    given = str(entry["file"] if "file" in entry else entry["name"])
    return path.parent / given if "file" in entry or given.endswith(".py") else None


def new_entry(wanted: EffectUse, file: str) -> Table:
    """Write an entry, with what its numbers mean.

    Args:
        wanted: the effect with its values.
        file: of a user's effect as seen from the model file; "" for one of the catalogue.
    """
    entry = tomlkit.table()
    entry["file" if file else "name"] = file or wanted.effect.name
    if wanted.target:
        entry["target"] = wanted.target
    for parameter in wanted.effect.parameters:
        bounds = [parameter.shown(bound, short=True).partition(" ")[0] for bound in (parameter.low, parameter.high)]
        value = tomlkit.item(parameter.written(wanted.values[parameter.name]))
        entry.add(parameter.name, value.comment(f"{parameter.meaning}; {' to '.join(bounds)}"))
    _write_held(entry, wanted)
    _write_pads(entry, wanted)
    return entry


def write_values(entry: Table, wanted: EffectUse) -> None:
    """Put a model's values into an entry that is there; one that is not there and has its typical value stays away."""
    for parameter in wanted.effect.parameters:
        value = wanted.values[parameter.name]
        if parameter.name in entry or value != parameter.typical:
            _write(entry, parameter, value)
    _write_held(entry, wanted)
    _write_pads(entry, wanted)


def _write_held(entry: Table, wanted: EffectUse) -> None:
    """Put the names of what no fit changes into an entry, or take them out."""
    if not wanted.held:
        entry.pop(_HELD, None)
    elif _HELD not in entry:
        entry.add(_HELD, tomlkit.item(list(wanted.held)).comment("no fit changes these"))
    elif set(cast(list[str], entry[_HELD])) != set(wanted.held):
        entry[_HELD] = list(wanted.held)


def _write_pads(entry: Table, wanted: EffectUse) -> None:
    """Put the values of single pads into an entry, and take those out that the model has not."""
    there = cast(_Part, entry.get(_PADS, tomlkit.table()))
    if not wanted.own or not isinstance(there, _Part):  # pads.A = ... and pads.B = ... apart: no table to take from
        entry.pop(_PADS, None)
        there = tomlkit.table()
    for pad in [p for p in there if p not in wanted.own]:
        del there[pad]
    for pad, own in wanted.own.items():
        part = cast(_Part, there[pad]) if pad in there else tomlkit.inline_table()
        for name in [n for n in part if n not in own]:
            del part[name]
        for name, value in own.items():
            _write(part, wanted.effect.parameter(name), value)
        if pad not in there:
            there[pad] = part
    if wanted.own and _PADS not in entry:
        entry[_PADS] = there


def _write(part: _Part, parameter: Parameter, value: float) -> None:
    name = parameter.name
    if name not in part or not same_number(quantity(str(part[name]), parameter.unit, name), value):
        part[name] = parameter.written(value)
