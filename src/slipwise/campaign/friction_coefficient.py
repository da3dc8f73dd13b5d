"""Friction that was recorded as a coefficient: the force is the coefficient times the pad's load."""

from collections.abc import Mapping

from slipwise.arrays import Array
from slipwise.channels import part_of
from slipwise.errors import InputError, UnitError
from slipwise.units import parse_unit


def is_coefficient(channel: str, unit: str) -> bool:
    """Return whether a column is a coefficient of friction: a pad's friction whose unit is a plain number."""
    if part_of(channel)[0] != "pad" or not channel.endswith(("_Fx", "_Fy")):
        return False
    try:
        parse_unit(unit, "1", channel)
    except UnitError:
        return False
    return True


def forces_of(
    coefficients: Mapping[str, Array], channels: Mapping[str, Array], areas: Mapping[str, float], file: str
) -> dict[str, Array]:
    """Turn coefficients of friction into forces.

    Args:
        coefficients: channel of friction -> coefficient (n,) [1].
        channels: all others, each (n,): of each pad its load, or its pressure.
        areas: pad -> its area [m^2], for those of which only the pressure is known.
        file: for messages.

    Returns:
        Channel of friction -> force (n,) [N].

    Raises:
        InputError: neither load nor pressure of a pad is known.
    """
    out = {}
    for name, coefficient in coefficients.items():
        pad = name.rsplit("_", 1)[0]
        if f"{pad}_N" in channels:
            load = channels[f"{pad}_N"]
        elif f"{pad}_P" in channels:
            load = channels[f"{pad}_P"] * areas[part_of(name)[1]]
        else:
            raise InputError(
                f"{file}: {name} is given as a coefficient of friction (unit 1), so its load must be known: give "
                f'{pad}_N or {pad}_P as a column, or under [constants], for example {pad}_N = "10 kN"'
            )
        out[name] = coefficient * load
    return out
