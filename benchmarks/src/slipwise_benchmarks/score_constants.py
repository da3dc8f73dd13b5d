"""Constants of a discovered law held against the true ones, whatever names and usual conventions an answer has."""

from collections.abc import Mapping, Sequence
from math import pi, sqrt
from typing import Any

from slipwise_benchmarks.settings import PAD_AREA

#: A constant counts as right within this share of the true one [1]; a phase within this [rad].
WITHIN, PHASE = 0.1, 0.3
#: Constant of the bench -> other names that it may have.
ALSO: dict[str, set[str]] = {
    "size": {"amplitude", "coefficient", "gain", "rise", "strength", "c"},
    "place": {"centre", "center", "middle", "onset", "threshold"},
    "width": {"scale", "sigma", "half width"},
    "scale": {"width", "decay", "decay time", "decay length", "reference", "length", "speed"},
    "period": {"wavelength", "period forth", "length"},
    "period back": {"wavelength back"},
    "exponent": {"power"},
    "phase": set(),
    "time": {"time constant", "lag", "cooling", "memory"},
}
#: (form, constant) -> factors that turn usual conventions into the bench's: a standard deviation, a logistic curve.
CONVENTIONS: dict[tuple[str, str], tuple[float, ...]] = {
    ("bump", "width"): (1.0, sqrt(2.0)),
    ("step", "width"): (1.0, 2.0),
}
#: Unit -> unit that the bench has, and how many of it one of the first is; a pressure is a load over the pad's area.
UNITS: dict[str, tuple[str, float]] = {
    "mm": ("m", 1.0e-3),
    "ms": ("s", 1.0e-3),
    "mm/s": ("m/s", 1.0e-3),
    "kN": ("N", 1.0e3),
    "Pa": ("N", PAD_AREA),
    "MPa": ("N", 1.0e6 * PAD_AREA),
    "1/Pa": ("1/(N)", 1.0 / PAD_AREA),
    "1/MPa": ("1/(N)", 1.0e-6 / PAD_AREA),
    "kN/s": ("N/s", 1.0e3),
    "Pa/s": ("N/s", PAD_AREA),
    "MPa/s": ("N/s", 1.0e6 * PAD_AREA),
}
#: Of a power law a size means nothing without the scale at which it is stated, and that is a choice.
_CHOSEN = {"power": {"size", "scale"}}

Given = Mapping[str, Any]


def constant_rows(results: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Hold every constant that an answer gives against the truth; its first law must have the right form.

    Returns:
        one row per constant: campaign, constant, unit, true, value, low, high, within, inside.
    """
    rows = []
    for result in results:
        law, given = result["truth"]["law"], result["said"]["laws"][0]["constants"]
        found = matched(law["constants"], given)
        for name in law["constants"]:
            if name in found and name not in _CHOSEN.get(law["form"], ()):
                unit = law["constants"][name]["unit"]
                rows.append({"campaign": result["name"], "constant": name, "unit": unit, **_held(name, law, found)})
    return rows


def matched(true: Mapping[str, Given], given: Mapping[str, Given]) -> dict[str, dict[str, float]]:
    """Give value, low and high of the constants of an answer that are meant, in the bench's names and units.

    They are told by name and unit, or as the only ones of a unit that are left over on either side. The unit of a size
    is not looked at, for it may be written in many ways.
    """
    keys: dict[str, str] = {}
    for alike in (lambda called, name: called == name, lambda called, name: called in ALSO[name]):
        for name in true:
            here = [key for key in given if alike(key.lower().replace("_", " "), name) and key not in keys.values()]
            fits = [key for key in here if name == "size" or _unit(given[key])[0] == true[name]["unit"]]
            if fits and name not in keys:
                keys[name] = fits[0]
    for name in [name for name in true if name not in keys]:
        unit = true[name]["unit"]
        rivals = [other for other in true if other not in keys and true[other]["unit"] == unit]
        left = [key for key in given if key not in keys.values() and _unit(given[key])[0] == unit]
        if len(left) == len(rivals) == 1:
            keys[name] = left[0]
    return {name: _in_unit(given[key]) for name, key in keys.items()}


def _in_unit(one: Given) -> dict[str, float]:
    return {key: _unit(one)[1] * one[key] for key in ("value", "low", "high") if one.get(key) is not None}


def _unit(one: Given) -> tuple[str, float]:
    return UNITS.get(one["unit"], (one["unit"], 1.0))


def _held(name: str, law: Given, found: Mapping[str, dict[str, float]]) -> dict[str, Any]:
    true, said = law["constants"][name]["value"], found[name]
    if law["form"] == "sine" and name in ("size", "phase"):
        return _wave(name, law, found)
    factor = min(CONVENTIONS.get((law["form"], name), (1.0,)), key=lambda f: abs(f * said["value"] - true))
    # a place near zero is as sure as the width round it, not as a share of next to nothing
    whole = max(abs(true), law["constants"].get("width", {"value": 0.0})["value"] if name == "place" else 0.0)
    return _row(true, {key: factor * value for key, value in said.items()}, WITHIN * whole)


def _wave(name: str, law: Given, found: Mapping[str, dict[str, float]]) -> dict[str, Any]:
    """Hold a sine's size or phase against the truth; half a turn more is a size of the other sign."""
    true, said = law["constants"][name]["value"], found[name]
    turned = "size" in found and found["size"]["value"] * law["constants"]["size"]["value"] < 0.0
    if name == "size":
        return _row(true, {key: -value if turned else value for key, value in said.items()}, WITHIN * abs(true))
    shift = pi if turned else 0.0
    shift += 2.0 * pi * round((true - said["value"] - shift) / (2.0 * pi))
    return _row(true, {key: value + shift for key, value in said.items()}, PHASE)


def _row(true: float, said: Mapping[str, float], tolerance: float) -> dict[str, Any]:
    low, high = sorted((said.get("low", said["value"]), said.get("high", said["value"])))
    inside = "low" in said and "high" in said and bool(low <= true <= high)
    within = bool(abs(said["value"] - true) <= tolerance)
    return {"true": true, "value": said["value"], "low": low, "high": high, "within": within, "inside": inside}
