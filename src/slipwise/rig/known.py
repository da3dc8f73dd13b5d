"""What is known of a specimen better than its rated values, as people write it: names and quantities with units."""

from collections.abc import Mapping
from typing import Any

from slipwise.errors import InputError, unknown_name
from slipwise.rig.places import mean
from slipwise.rig.specimen import Specimen
from slipwise.units import quantity

#: SI unit of every quantity of a specimen that may be given.
SPECIMEN_UNITS: Mapping[str, str] = {
    "mass": "kg",
    "centre_height": "m",
    "centre_x": "m",
    "centre_y": "m",
    "pad_radius": "m",
    "pad_stiffness": "N/m",
    "pad_damping": "N*s/m",
    "plastic_pressure": "Pa",
    "shear_strength": "Pa",
    "buffer_stiffness": "N/m",
    "buffer_height": "m",
    "bending_mass": "kg",
    "bending_frequency": "Hz",
    "bending_damping": "1",
    "gravity": "m/s^2",
}
#: What may be chosen by a word.
SPECIMEN_WORDS: tuple[str, ...] = ("pads_on", "stick_capacity", "friction")


def read_known(part: Mapping[str, Any], where: str) -> dict[str, float | str]:
    """Turn a table of quantities with units into SI.

    Args:
        part: e.g. {"mass": "10.02 t", "pads_on": "girder"}.
        where: what the table is, for messages, e.g. "[specimen] of campaign.toml".

    Raises:
        UnknownNameError: a specimen has no such value.
        UnitError: no unit, or one of the wrong dimension.
        InputError: a word is needed and something else was given.
    """
    known: dict[str, float | str] = {}
    for key, value in part.items():
        if key in SPECIMEN_WORDS:
            if not isinstance(value, str):
                raise InputError(f"{where}: {key} must be a text in quotes, not {value!r}")
            known[key] = str(value)
        elif key in SPECIMEN_UNITS:
            known[key] = quantity(value, SPECIMEN_UNITS[key], f"{where}, {key!r}")
        else:
            raise unknown_name(f"key in {where}", key, (*SPECIMEN_UNITS, *SPECIMEN_WORDS))
    return known


def better_known(specimen: Specimen, known: Mapping[str, float | str], source: str) -> Specimen:
    """Return a specimen with what is known better; a stiffness of buffers is that of each.

    Args:
        specimen: with its rated values.
        known: name -> value [SI].
        source: where the values come from.

    Raises:
        SettingError: a value that no rig can have.
    """
    sources = {**specimen.sources, **dict.fromkeys(known, source)}
    return specimen.changed(**known, sources=sources, stated=(*specimen.stated, *known))


def known_better(specimen: Specimen, rated: Specimen) -> dict[str, float | str]:
    """Return what a specimen has other than its rated values, name -> value [SI]; unequal buffers give their mean."""
    names = [n for n in (*SPECIMEN_UNITS, *SPECIMEN_WORDS) if getattr(specimen, n) != getattr(rated, n)]
    found: dict[str, float | str] = {n: getattr(specimen, n) for n in names if n != "buffer_stiffness"}
    if "buffer_stiffness" in names:
        found["buffer_stiffness"] = mean(specimen.buffer_stiffness)
    return found
