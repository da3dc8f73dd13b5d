"""What is kept of every member: names, units, and what they mean."""

import re
from dataclasses import dataclass

from slipwise.errors import SettingError, unknown_name
from slipwise.short_repr import short_repr
from slipwise.units import quantity


@dataclass(frozen=True)
class Response:
    """One number of a replay.

    Attributes:
        name: column of members.parquet.
        unit: SI unit.
        shown_in: unit in which tables show it.
        meaning: in a few words.
    """

    name: str
    unit: str
    shown_in: str
    meaning: str


RESPONSES: tuple[Response, ...] = (
    Response("slip", "m", "mm", "largest slip, along both directions together"),
    Response("slip_x", "m", "mm", "largest slip along x"),
    Response("residual_slip", "m", "mm", "slip at the end of the motion"),
    Response("pad_load", "N", "kN", "largest load of a pad"),
    Response("buffer_force", "N", "kN", "largest force of a buffer"),
    Response("uplift", "s", "s", "time with a pad lifted off"),
    Response("uplifts", "1", "1", "times that a pad lifted off, as the record shows them"),
    Response("energy", "J", "kN*cm", "energy dissipated by the pads"),
)


@short_repr
@dataclass(frozen=True)
class Limit:
    """A value that a response may exceed.

    Attributes:
        response: which.
        value: [SI].
        words: as it was given, "slip_x=30mm".
    """

    response: Response
    value: float
    words: str


def read_limit(text: str) -> Limit:
    """Read "RESPONSE=VALUE" with a unit.

    Raises:
        SettingError: there is no "=".
        UnknownNameError: no such response.
        UnitError: no unit, or one of the wrong dimension.
    """
    name, equals, value = (part.strip() for part in text.partition("="))
    if not equals:
        raise SettingError(f"--limit {text!r}: write RESPONSE=VALUE with a unit, for example slip_x=30mm")
    known = {response.name: response for response in RESPONSES}
    if name not in known:
        raise unknown_name("response", name, known)
    return Limit(known[name], quantity(value, known[name].unit, f"--limit {name}"), re.sub(r"\s", "", text))
