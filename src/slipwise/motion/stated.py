"""What a file states and what the user gives must agree; what neither says is asked for, never guessed."""

import math
import re
from dataclasses import dataclass

from slipwise.data_files.acceleration_unit import acceleration_factor
from slipwise.errors import InputError, UnitError
from slipwise.motion.source_file import SourceFile
from slipwise.units import quantity

#: Beyond these a step is a slip of the pen.
_STEP_RANGE = (1e-6, 10.0)


@dataclass(frozen=True)
class Given:
    """What the user says about files that do not say it themselves.

    Attributes:
        dt: step [s].
        unit: of the acceleration, as written; a number before it, "2 mm/s^2", is a factor.
        count: acceleration of one count of a digitizer, "2.4e-6 m/s^2".
        allow_short: take a record that is a few values shorter than its header promises.
    """

    dt: float | None = None
    unit: str | None = None
    count: str | None = None
    allow_short: bool = False

    def __post_init__(self) -> None:
        """Refuse a step that is none.

        Raises:
            InputError: it is not positive and finite.
        """
        if self.dt is not None and not (math.isfinite(self.dt) and self.dt > 0):
            raise InputError(f"the step given, {self.dt!r} s, is not possible; give a positive one")

    def factor(self, source: SourceFile) -> tuple[float, str] | None:
        """Return the factor from what the values are in to m/s^2 and what was given, None if nothing is.

        Raises:
            UnitError: it is none of acceleration, or a unit and a count are given.
        """
        if self.count is not None and self.unit is not None:
            raise UnitError(f"{source.name}: --count {self.count} and --unit {self.unit} say the same; leave one out")
        if self.count is not None:
            return quantity(self.count, "m/s^2", "--count"), self.count
        if self.unit is None:
            return None
        what = f"the unit given for {source.name}"
        factor = quantity(self.unit, "m/s^2", what) if self.has_number else acceleration_factor(self.unit, what)
        return factor, self.unit

    @property
    def has_number(self) -> bool:
        """Whether a number stands before the unit."""
        return self.unit is not None and bool(re.match(r"[\d.]", self.unit.strip()))


def settle_unit(stated: str | None, given: Given, source: SourceFile, line: str = "") -> tuple[float, str]:
    """Return the factor to m/s^2 and the words for the record.

    Args:
        stated: the unit that the file states, None if it states none.
        given: what the user says.
        source: the file.
        line: the file's line that states it, for the message.

    Raises:
        UnitError: nobody says it, it is unknown, or the file and the user disagree.
    """
    by_user = given.factor(source)
    if stated is None:
        if by_user is None:
            raise UnitError(
                f"{source.name}: the file does not state the unit of its acceleration; "
                "give it, for example --unit g or --unit cm/s^2"
            )
        return by_user[0], f"unit {by_user[1]}, as given"
    by_file = acceleration_factor(stated, f"the header of {source.name}")
    if by_user is not None and abs(by_user[0] - by_file) > 1e-4 * by_file:
        option = "--unit" if given.count is None else "--count"
        raise UnitError(
            f"{source.name}: the file states {stated!r} as its unit, {by_user[1]!r} was given; "
            f"leave {option} out, or correct {_header_line(line)}"
        )
    return by_file, f"unit {stated}, as the file states"


def _header_line(line: str) -> str:
    return f"its line {line!r}" if line else "the file's header"


def settle_step(stated: float | None, given: Given, source: SourceFile, line: str = "") -> tuple[float, str]:
    """Return the step [s] and the words for the record.

    Args:
        stated: what the file states [s], None if it states none.
        given: what the user says.
        source: the file.
        line: the file's line that states it, for the message.

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
            f"leave --motion-dt out, or correct {_header_line(line)}"
        )
    if not _STEP_RANGE[0] <= dt <= _STEP_RANGE[1]:
        raise InputError(
            f"{source.name}: a step of {dt:g} s is not possible; steps of {_STEP_RANGE[0]:g} s to "
            f"{_STEP_RANGE[1]:g} s are read, check the header or --motion-dt"
        )
    return dt, f"step {dt:g} s, {words}"


def agreed_step(stated: float | None, other: float | None, by: str, source: SourceFile) -> float | None:
    """Return the step [s] that two places of a file state, None if neither does.

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
    """Return the unit of acceleration that a column and the header above it state, None if neither does.

    Raises:
        UnitError: they differ, or one is none of acceleration.
    """
    if one is None or other is None:
        return one if one is not None else other
    first, second = (acceleration_factor(unit, f"the header of {source.name}") for unit in (one, other))
    if abs(first - second) > 1e-4 * second:
        raise UnitError(f"{source.name}: the header states {other!r}, the column {one!r}; correct one of them")
    return one
