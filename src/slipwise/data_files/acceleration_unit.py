"""Units of acceleration in the spellings of agencies: CM/SEC/SEC, cm/sec2, gal(cm/s/s), G."""

import re

from slipwise.errors import UnitError
from slipwise.units import parse_unit

#: What other languages write for gal and second.
_SPELLINGS = {"伽": "gal", "ガル": "gal", "秒": "s", "gales": "gal", "milli-g": "mg"}


def acceleration_factor(unit: str, what: str) -> float:
    """Return the factor from a unit of acceleration, in any of the agencies' spellings, to m/s^2.

    Args:
        unit: as written.
        what: what the unit belongs to, for the message.

    Raises:
        UnitError: unknown unit or another dimension.
    """
    text = unit.strip()
    # JMA writes the unit twice, "gal(cm/s/s)": both must mean the same.
    twice = re.fullmatch(r"(\w+)\s*\(([^()]+)\)", text)
    if twice:
        first, second = (acceleration_factor(part, what) for part in twice.groups())
        if abs(first - second) > 1e-9 * abs(second):
            raise UnitError(f"{what}: the unit {unit!r} contradicts itself; give the file's true unit in its header")
        return first
    for written, plain in _SPELLINGS.items():
        text = text.replace(written, plain)
    # Agencies write CM/SEC/SEC, cm/sec2, cm/s2, m/sn2; only a lone G is standard gravity.
    if re.search(r"[a-z]/|^gal$", text, re.IGNORECASE):
        text = text.lower()
        text = re.sub(r"\b(?:sec|seg|sn)\b|\b(?:sec|seg|sn)(?=[2^*²])", "s", text)
        text = re.sub(r"(?<=/s)2\b", "^2", text)
    factor = parse_unit(text, "m/s^2", what)
    if not 0 < factor < 1e4:
        raise UnitError(f"{what}: the unit {unit!r} is no unit of acceleration; a unit like 'm/s^2' is needed")
    return factor


def is_acceleration(unit: str) -> bool:
    """Return whether a text is a unit of acceleration."""
    try:
        acceleration_factor(unit, "")
    except UnitError:
        return False
    return True


def is_velocity_or_displacement(unit: str) -> bool:
    """Return whether a text is a unit of what an acceleration may be taken for."""
    for si in ("m/s", "m"):
        try:
            parse_unit(re.sub(r"\bsec\b", "s", unit.lower()), si, "")
            return True
        except UnitError:
            continue
    return False
