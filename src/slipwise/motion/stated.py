"""What a file states and what the user gives must agree; what neither says is asked for, never guessed."""

import math
import re
from dataclasses import dataclass

from slipwise.errors import InputError, UnitError
from slipwise.motion.source_file import SourceFile
from slipwise.units import parse_unit

#: Beyond these a step is a slip of the pen.
_STEP_RANGE = (1e-6, 10.0)


@dataclass(frozen=True)
class Given:
    """What the user says about files that do not say it themselves.

    Attributes:
        dt: step [s].
        unit: of the acceleration, as written.
    """

    dt: float | None = None
    unit: str | None = None

    def __post_init__(self) -> None:
        """Refuse a step that is none.

        Raises:
            InputError: it is not positive and finite.
        """
        if self.dt is not None and not (math.isfinite(self.dt) and self.dt > 0):
            raise InputError(f"the step given, {self.dt!r} s, is not possible; give a positive one")


def acceleration_factor(unit: str, what: str) -> float:
    """Give the factor from a unit of acceleration, in any of the agencies' spellings, to m/s^2.

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
    # Agencies write CM/SEC/SEC, cm/sec2, cm/s2; only a lone G is standard gravity.
    if re.search(r"[a-z]/|^gal$", text, re.IGNORECASE):
        text = text.lower()
        text = re.sub(r"\bsec\b|\bsec(?=[2^])", "s", text)
        text = re.sub(r"(?<=/s)2\b", "^2", text)
    factor = parse_unit(text, "m/s^2", what)
    if not 0 < factor < 1e4:
        raise UnitError(f"{what}: the unit {unit!r} is no unit of acceleration; a unit like 'm/s^2' is needed")
    return factor


def settle_unit(stated: str | None, given: Given, source: SourceFile) -> tuple[float, str]:
    """Give the factor to m/s^2 and the words for the record.

    Args:
        stated: the unit that the file states, None if it states none.
        given: what the user says.
        source: the file.

    Raises:
        UnitError: nobody says it, it is unknown, or the file and the user disagree.
    """
    by_user = None if given.unit is None else acceleration_factor(given.unit, f"the unit given for {source.name}")
    if stated is None:
        if by_user is None:
            raise UnitError(
                f"{source.name}: the file does not state the unit of its acceleration; "
                "give it, for example --unit g or --unit cm/s^2"
            )
        return by_user, f"unit {given.unit}, as given"
    by_file = acceleration_factor(stated, f"the header of {source.name}")
    if by_user is not None and abs(by_user - by_file) > 1e-4 * by_file:
        raise UnitError(
            f"{source.name}: the file states {stated!r} as its unit, {given.unit!r} was given; "
            "leave --unit out, or correct the file's header"
        )
    return by_file, f"unit {stated}, as the file states"


def settle_step(stated: float | None, given: Given, source: SourceFile) -> tuple[float, str]:
    """Give the step [s] and the words for the record.

    Raises:
        InputError: nobody says it, it is beyond all reason, or the file and the user disagree.
    """
    if stated is not None:
        dt, words = stated, "as the file states"
    elif given.dt is not None:
        dt, words = given.dt, "as given"
    else:
        raise InputError(
            f"{source.name}: the file does not state its time step; give it, for example --motion-dt '0.005 s'"
        )
    if stated is not None and given.dt is not None and abs(given.dt - stated) > 1e-4 * abs(stated):
        raise InputError(
            f"{source.name}: the file states a step of {stated:g} s, {given.dt:g} s was given; "
            "leave --motion-dt out, or correct the file's header"
        )
    if not _STEP_RANGE[0] <= dt <= _STEP_RANGE[1]:
        raise InputError(
            f"{source.name}: a step of {dt:g} s is not possible; steps of {_STEP_RANGE[0]:g} s to "
            f"{_STEP_RANGE[1]:g} s are read, check the header or --motion-dt"
        )
    return dt, f"step {dt:g} s, {words}"


def agreed_step(stated: float | None, other: float | None, by: str, source: SourceFile) -> float | None:
    """Give the step [s] that two places of a file state, None if neither does.

    Args:
        stated: by the header.
        other: by another place.
        by: that place, in words.
        source: the file.

    Raises:
        InputError: they differ.
    """
    if stated is not None and other is not None and abs(stated - other) > 1e-3 * abs(other):
        raise InputError(
            f"{source.name}: the header states a step of {stated:g} s, {by} {other:g} s; correct one of them"
        )
    return stated if stated is not None else other


def agreed_unit(one: str | None, other: str | None, source: SourceFile) -> str | None:
    """Give the unit of acceleration that a column and the header above it state, None if neither does.

    Raises:
        UnitError: they differ, or one is none of acceleration.
    """
    if one is None or other is None:
        return one if one is not None else other
    first, second = (acceleration_factor(unit, f"the header of {source.name}") for unit in (one, other))
    if abs(first - second) > 1e-4 * second:
        raise UnitError(f"{source.name}: the header states {other!r}, the column {one!r}; correct one of them")
    return one
