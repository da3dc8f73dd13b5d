"""MATLAB structures that tell name, unit and step of their channels in fields beside the data.

dSPACE keeps X and Y with Name, Unit and Data, Simulink signals with label and values, Test.Lab y_values with a
function_record, `importdata` a matrix with colheaders; catman and PULSE keep a header in a variable of its own.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import UnitError
from slipwise.units import quantity

#: Fields of a structure, in lower case; the first that is there counts.
_DATA = ("data", "values", "y_values.values", "samples")
_NAMES = ("name", "label", "function_record.name", "signalname", "channelname", "displayname", "title")
_UNITS = ("unit", "units", "y_values.quantity.label", "quantity.label", "datainfo.units", "unitstring", "eu")
_STEPS = ("x_values.increment", "dt", "delta_t", "sampletime", "sampleinterval")
_RATES = ("fs", "samplerate", "samplefrequency", "samplingrate", "samplingfrequency")
_HEADER = re.compile(r"^(?P<base>.+)_Header$", re.IGNORECASE)


@dataclass(frozen=True)
class ToldChannel:
    """A channel that its structure names: header "slip [mm]", values (n,), and the field that holds them."""

    header: str
    values: Array
    field: str


def told_channel(structure: Mapping[str, Any]) -> ToldChannel | None:
    """Return the channel of a structure that names it, None where it names none."""
    name, unit = _text(structure, _NAMES), _text(structure, _UNITS)
    for path in _DATA:
        values = _vector(field(structure, path))
        if name and values is not None:
            key = next(key for key in structure if key.lower() == path.partition(".")[0])
            return ToldChannel(_header(name, unit), values, key)
    return None


def told_matrix(structure: Mapping[str, Any]) -> tuple[str, tuple[str, ...]] | None:
    """Return the field that holds a matrix (n, k) and its k headers, where a list of k names stands beside it."""
    lists = {name: texts for name, value in structure.items() if (texts := _texts(value))}
    for name, value in structure.items():
        if not _is_matrix(value):
            continue
        fitting = {other: texts for other, texts in lists.items() if len(texts) == value.shape[1]}
        names = next((t for o, t in fitting.items() if "unit" not in o.lower() and len(set(t)) == len(t)), None)
        units = next((t for o, t in fitting.items() if "unit" in o.lower()), ("",) * value.shape[1])
        if names is not None:
            return name, tuple(_header(n, u) for n, u in zip(names, units, strict=True))
    return None


def stated_steps(structure: Mapping[str, Any]) -> Iterator[float]:
    """Yield the step [s] that a structure states, if it states one: x_values.increment, dt, fs."""
    unit = field(structure, "x_values.quantity.label")
    for paths, rate in ((_STEPS, False), (_RATES, True)):
        for path in paths:
            value = np.asarray(field(structure, path))
            if value.size != 1 or value.dtype.kind not in "fiu" or not float(value.ravel()[0]) > 0.0:
                continue
            number = float(value.ravel()[0])
            if rate:
                yield 1.0 / number
            elif not path.startswith("x_values"):
                yield number
            elif isinstance(unit, str):
                try:
                    yield quantity(f"{number!r} {unit}", "s", path)
                except UnitError:
                    continue


def joined_headers(content: Mapping[str, Any]) -> dict[str, Any]:
    """Put "Channel_1_Data" and "Channel_1_Header", two variables of one channel, into one structure."""
    out = dict(content)
    for name in content:
        found = _HEADER.match(name)
        data = next((other for other in content if found and other.lower() == f"{found['base']}_data".lower()), None)
        if found and data is not None and isinstance(content[name], dict):
            out[found["base"]] = {**out.pop(name), "Data": out.pop(data)}
    return out


def field(structure: Any, path: str) -> Any:
    """Return what stands at a path of fields such as "y_values.quantity.label", in any case; else None."""
    for key in path.split("."):
        if not isinstance(structure, Mapping):
            return None
        structure = next((value for name, value in structure.items() if name.lower() == key), None)
    return structure


def _text(structure: Mapping[str, Any], paths: tuple[str, ...]) -> str:
    for path in paths:
        value = field(structure, path)
        if isinstance(value, str) and value.strip():
            return value.strip()
    return ""


def _texts(value: Any) -> tuple[str, ...]:
    """Return a list of texts, empty for anything else."""
    items = value.ravel().tolist() if isinstance(value, np.ndarray) and value.dtype.kind in "OU" else value
    if isinstance(items, list) and items and all(isinstance(item, str) for item in items):
        return tuple(item.strip() for item in items)
    return ()


def _vector(value: Any) -> Array | None:
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size < 2 or np.squeeze(array).ndim != 1:
        return None
    return np.squeeze(array).astype(float)


def _is_matrix(value: Any) -> bool:
    return isinstance(value, np.ndarray) and value.dtype.kind in "fiu" and value.ndim == 2 and value.shape[0] > 1


def _header(name: str, unit: str) -> str:
    """Return a header; of a path through a model, "Model Root/slip", the last part names the signal."""
    short = name.replace('"', "").rpartition("/")[2].strip() or name
    short = name if re.search(r"[\[(]", name) else short
    return f"{short} [{unit}]" if unit and "[" not in short else short
