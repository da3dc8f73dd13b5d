"""Units of the numbers that people write: pint, in one place.

Inside Slipwise everything is SI (m, s, kg, N, Pa, rad, K); this file is the only door.
"""

import re
import sys
from functools import cache
from hashlib import sha256
from math import isfinite
from pathlib import Path

import pint

from slipwise.errors import UnitError
from slipwise.jobs.atomic_write import written_beside
from slipwise.jobs.cache import code_folders, own_file, remove


@cache
def _registry() -> pint.UnitRegistry:
    registry = _as_kept() or pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    registry.define("gal = cm/s^2 = Gal")
    # "g" of an engineer at a shaking table is never a gram.
    registry.define("gee = 9.80665 m/s^2")
    registry.define("ton_metric = 1000 kg")
    registry.define("tonf_metric = 1000 kgf")
    return registry


def _as_kept() -> pint.UnitRegistry | None:
    """Let pint keep its own list of units as it has read it: that takes half a second, reading it back a twentieth.

    Pint trusts its files, which are code: their folder is private, and its content must agree with a checksum.
    """
    name = f"units-{pint.__version__}-{sys.implementation.cache_tag}"
    for folder in code_folders():
        files, total = folder / name, folder / f"{name}.sum"
        try:
            if own_file(total) != _checksum(files):
                remove(files)
            registry = pint.UnitRegistry(autoconvert_offset_to_baseunit=True, cache_folder=files)
            if own_file(total) != (found := _checksum(files)):
                with written_beside(total) as stream:
                    stream.write(found)
        except Exception:  # of the disk; or another process writes there, and half a pickle raises nearly anything
            continue
        return registry
    return None


def _checksum(folder: Path) -> bytes:
    """Return a hash of what is in a folder; of nothing where it is not there."""
    found = sorted(folder.iterdir()) if folder.is_dir() else []
    contents = [path.name.encode() + (path.read_bytes() if path.is_file() else b"") for path in found]
    return sha256(b"".join(sha256(content).digest() for content in contents)).digest()


#: Units as laboratories and agencies write them -> as pint reads them.
_SPELLINGS: dict[str, str] = {
    "g's": "gee", "g": "gee", "G": "gee", "GRAV": "gee", "mG": "milligee", "mg": "milligee",
    "t": "ton_metric", "tonf": "tonf_metric", "TONF": "tonf_metric", "TF": "tonf_metric",
    "KN": "kN", "KGF": "kgf", "Kgf": "kgf", "LBF": "lbf", "KIP": "kip", "KIPS": "kip", "Kips": "kip",
    "GAL": "gal", "GALS": "gal", "Gals": "gal", "gals": "gal",
    "Sec": "s", "SEC": "s", "S": "s", "secs": "s", "MSEC": "ms", "Hours": "hour", "HZ": "Hz", "hz": "Hz",
    "M": "m", "CM": "cm", "Cm": "cm", "MM": "mm", "Mm": "mm", "IN": "in", "Inch": "in", "INCH": "in", "Inches": "in",
    "KG": "kg", "Kg": "kg", "MPA": "MPa", "Mpa": "MPa", "KPA": "kPa", "Kpa": "kPa", "PSI": "psi", "DEG": "deg",
    "C": "degC", "F": "degF", "-": "1", "": "1", "%": "percent",
}  # fmt: skip
#: What stands between two units: spaces, or the point of ISO 80000-1, as in N.m and m.s-2.
_BETWEEN = re.compile(r"(?<=[A-Za-z0-9]) +(?=[A-Za-z])|(?<=[A-Za-z])\.(?=[A-Za-z])|(?<=[A-Za-z-][0-9])\.(?=[A-Za-z])")
#: A moment without a sign between force and lever: kNm. Pint knows none, or takes the N for a number of things.
_MOMENT = re.compile(r"([kM]?N)([cm]?m)")
_TON = re.compile(r"\btons?\b", re.IGNORECASE)
#: A name of letters, perhaps with a power behind it: mm2, s-2, s^-2.
_NAMED = re.compile(r"([A-Za-z_°'%]+)(?:(?:\^|\*\*)?(-?\d+))?")
#: A unit is no longer than this, holds nothing else than these, and has no power of a power and none beyond 9.
_LONGEST = 400
_ALLOWED = re.compile(r"[\w\s*/^().+%°'·−-]*")
_TOWER = re.compile(r"(?:\*\*|\^)\s*\(?\s*[+-]?\s*(?:\d{2,}|[\d.]*\s*\)?\s*(?:\*\*|\^))|(?:\*\*|\^)\s*\([^)]*[*/^]")
#: A whole number by itself; as a float it overflows at once where pint would compute all its digits.
_WHOLE = re.compile(r"(?<![\w.])\d+(?![\w.])")
_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def _clean(text: str) -> str:
    """Rewrite what engineers write into what pint reads: KN, N/mm2, cm/sec2, m·s⁻², g."""
    text = text.strip().translate(_SUPERSCRIPTS).replace("µ", "u").replace("μ", "u").replace("·", "*")
    text = text.replace("−", "-").replace("°C", "degC").replace("°F", "degF")
    if text in _SPELLINGS:
        return _SPELLINGS[text]

    def named(found: re.Match[str]) -> str:
        name, power = found.groups()
        if power is None and (moment := _MOMENT.fullmatch(name)):
            return f"({moment[1]}*{moment[2]})"
        return _SPELLINGS.get(name, name) + (f"**{power}" if power else "")

    powers = _NAMED.sub(named, _BETWEEN.sub("*", text))
    return _WHOLE.sub(lambda found: f"{found[0]}.0", powers)


def parse_unit(unit: str, dimension_of: str, what: str) -> float:
    """Return the factor from a unit to SI.

    Args:
        unit: as written, e.g. "kN", "cm/s^2", "g" (standard gravity).
        dimension_of: an SI unit of the dimension that is required, e.g. "N".
        what: what the unit belongs to, for the message, e.g. "column 'force' of run.csv".

    Returns:
        Factor: value [SI] = factor * value [unit]. For units with an offset (degC) see `affine`.

    Raises:
        UnitError: unknown unit or another dimension.
    """
    return quantity(f"1 {unit}", dimension_of, what, plain_unit=unit)


def affine(unit: str, dimension_of: str, what: str) -> tuple[float, float]:
    """Return (factor, offset) from a unit to SI: value [SI] = factor * value [unit] + offset.

    Raises:
        UnitError: unknown unit or another dimension.
    """
    offset = quantity(f"0 {unit}", dimension_of, what, plain_unit=unit)
    return parse_unit(unit, dimension_of, what) - offset, offset


def quantity(text: str | float | int, dimension_of: str, what: str, *, plain_unit: str | None = None) -> float:
    """Turn "10.02 t", "30 min" or "0.3 g" into SI.

    Args:
        text: number and unit. A bare number is accepted only where the dimension is a pure number.
        dimension_of: an SI unit of the dimension that is required, e.g. "kg"; "1" for a pure number.
        what: what the value belongs to, for the message.
        plain_unit: the unit as it was written, when `text` was put together by the caller.

    Returns:
        The value in the SI unit given by `dimension_of`.

    Raises:
        UnitError: no number, no unit, an unknown unit or another dimension.
    """
    registry = _registry()
    given = str(text).strip()
    number, _, unit = given.partition(" ")
    if not unit:
        split = next(
            (i for i, c in enumerate(given) if c.isalpha() and not _exponent(given, i) or c in "%°"), len(given)
        )
        number, unit = given[:split], given[split:]
    shown = plain_unit if plain_unit is not None else unit
    if _TON.search(unit):
        raise UnitError(
            f"{what}: {shown!r} may be of 1000, 907 or 1016 kg; write t for 1000 kg, tonf for the force of 1000 kg"
        )
    try:
        value = float(number)
    except ValueError:
        raise UnitError(
            f"{what}: {given!r} is not a number with a unit; write for example '1.5 {dimension_of}'"
        ) from None
    if not isfinite(value):
        raise UnitError(f"{what}: {given[:60]!r} is not a finite number; write for example '1.5 {dimension_of}'")
    if not unit.strip() and dimension_of != "1":
        raise UnitError(f"{what}: {given!r} has no unit; write for example '{number} {dimension_of}'")
    cleaned = _clean(unit[: _LONGEST + 1])
    if len(unit) > _LONGEST or not _ALLOWED.fullmatch(unit.translate(_SUPERSCRIPTS)) or _TOWER.search(cleaned):
        raise UnitError(
            f"{what}: {shown[:60]!r} is no unit; a unit like '{dimension_of}' is needed, of at most {_LONGEST} "
            "characters, with powers up to 9 and no powers of powers"
        )
    try:
        parsed = registry.Quantity(value, cleaned)
        si = float(parsed.to(_clean(dimension_of)).magnitude)
    except pint.DimensionalityError:
        raise UnitError(
            f"{what}: the unit {shown!r} has the wrong dimension; a unit like '{dimension_of}' is needed"
        ) from None
    except (pint.UndefinedUnitError, pint.errors.DefinitionSyntaxError, AttributeError, ValueError, TypeError):
        raise UnitError(f"{what}: the unit {shown!r} is not known; a unit like '{dimension_of}' is needed") from None
    except Exception as error:  # pint's parser raises tokenize and assertion errors on odd text
        raise UnitError(
            f"{what}: {shown!r} cannot be read as a unit ({type(error).__name__}); write for example '{dimension_of}'"
        ) from None
    if not isfinite(si):
        raise UnitError(f"{what}: {given[:60]!r} is beyond every number; write for example '1.5 {dimension_of}'")
    return si


def _exponent(text: str, i: int) -> bool:
    """Return whether the letter at i is the e of 1e-3."""
    return (
        text[i] in "eE"
        and i > 0
        and (text[i - 1].isdigit() or text[i - 1] == ".")
        and text[i + 1 : i + 2].strip("+-0123456789") == ""
        and i + 1 < len(text)
    )


def convert(value: float, unit: str, to: str) -> float:
    """Convert a number from one unit to another, e.g. from SI to mm for a table."""
    return value * parse_unit(unit, to, "conversion")


@cache
def powers_of(unit: str) -> dict[str, float]:
    """Return the units of which an SI unit is a product, in full, with their powers: {"newton": 1, "meter": -1}."""
    return {name: float(str(power)) for name, power in _registry().Quantity(1.0, _clean(unit)).unit_items()}
