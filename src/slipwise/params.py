"""A parameter: a value with its unit, its bounds and its source."""

from dataclasses import dataclass, replace
from typing import Any

from slipwise.errors import SettingError, UnitError
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class Parameter:
    """One number of a law or of the rig.

    Attributes:
        name: as in the equation's words, e.g. "rate".
        unit: SI unit, e.g. "s/m"; "1" for a pure number.
        typical: a first guess for this rig [unit].
        low: smallest meaningful value [unit].
        high: largest meaningful value [unit].
        neutral: value at which the law changes nothing [unit]; None for a shape constant that alone switches nothing.
        source: where the number comes from, or the word "assumed".
        meaning: what it is, in a few words.
        shown_in: unit in which people read it, e.g. "s/cm"; the SI unit when empty.
        whole: whether only whole numbers make sense.
        by_pad: for what only single pads have, `level[B]`, and nothing but a base law's own number if all had it: which
            pads may have it, "each" or the "others" than the first, with which they are compared.
    """

    name: str
    unit: str
    typical: float
    low: float
    high: float
    neutral: float | None
    source: str
    meaning: str
    shown_in: str = ""
    whole: bool = False
    by_pad: str = ""

    def __post_init__(self) -> None:
        """Refuse a parameter that cannot be used.

        Raises:
            SettingError: no unit, no source, a text for a number, or bounds that do not hold the values.
        """
        for what, text, example in (
            ("unit", self.unit, "'m' or '1' for a pure number"),
            ("source", self.source, "'assumed'"),
            ("meaning", self.meaning, "'s_c: distance'"),
        ):
            if not isinstance(text, str) or not text:  # pyright: ignore[reportUnnecessaryIsInstance] - of a user's file
                raise SettingError(
                    f"parameter {self.name!r}: its {what} is {text!r} and must be a text, such as {example}; the order "
                    "is name, unit, typical, low, high, neutral, source, meaning"
                )
        for kind in ("typical", "low", "high", "neutral"):
            value = getattr(self, kind)
            if not isinstance(value, int | float) and not (value is None and kind == "neutral"):
                raise SettingError(
                    f"parameter {self.name!r}: its {kind} value is {value!r} and must be a number; the order is name, "
                    "unit, typical, low, high, neutral, source, meaning"
                )
        if not self.low < self.high:
            raise SettingError(
                f"parameter {self.name!r}: bounds {self.low:g} to {self.high:g} [{self.unit}] are empty; the lower "
                "comes first"
            )
        for kind, value in (("typical", self.typical), ("neutral", self.neutral)):
            if value is not None and not self.low <= value <= self.high:
                raise SettingError(
                    f"parameter {self.name!r}: the {kind} value {value:g} is outside "
                    f"{self.low:g} to {self.high:g} [{self.unit}]"
                )

    def check(self, value: float, owner: str = "") -> float:
        """Return the value if it lies within the bounds.

        Args:
            value: in the parameter's SI unit.
            owner: whose it is, for the message.

        Raises:
            SettingError: it does not; the message gives the bounds.
        """
        if not self.low <= value <= self.high:
            prefix = f"{owner}." if owner else ""
            raise SettingError(
                f"{prefix}{self.name} = {value:g} {self.unit} is out of bounds: "
                f"{self.low:g} to {self.high:g} {self.unit}"
            )
        return value

    def read(self, given: Any, owner: str = "") -> float:
        """Turn what a person gives into SI: a number is SI already, a text has its unit ("5 %", "2 mm").

        Args:
            given: the value.
            owner: whose parameter it is, for the message.

        Raises:
            SettingError: neither a number nor a text.
            UnitError: a text without a number, or with a unit of another dimension.
        """
        name = f"{owner}.{self.name}" if owner else self.name
        possible = f"{self.low:g} to {self.high:g} {self.unit}"
        if isinstance(given, str):
            from slipwise.units import quantity  # pint takes a while to load: only where a text is given

            try:
                return self.snapped(quantity(given, self.unit, name))
            except UnitError as error:
                raise UnitError(f"{error}; possible are {possible}") from None
        if isinstance(given, int | float):
            return given
        try:
            return float(given)
        except (TypeError, ValueError):
            raise SettingError(
                f"{name} is a number in SI or a text with its unit, {possible}; got {type(given).__name__}"
            ) from None

    def of_pad(self, pad: str) -> "Parameter":
        """Return the parameter that one pad has of its own, e.g. strength[A].

        Args:
            pad: letter of the pad, "A".
        """
        return replace(self, name=f"{self.name}[{pad}]", meaning=f"{self.meaning}; of pad {pad}")

    def row(self) -> dict[str, str | float | None]:
        """Return what a table says of it, SI."""
        numbers = {"typical": self.typical, "low": self.low, "high": self.high, "neutral": self.neutral}
        return {"parameter": self.name, **numbers, "unit": self.unit, "meaning": self.meaning}

    def snapped(self, value: float) -> float:
        """Undo what the conversion from "300 mm" did to the last digit of a bound or of the neutral value.

        Args:
            value: in the parameter's SI unit.
        """
        for exact in (self.neutral, self.typical, self.low, self.high):
            if exact is not None and same_number(value, exact):
                return exact
        return value

    def shown(self, value: float, *, short: bool = False) -> str:
        """Write a value [SI] in the unit in which people read it, with as many digits as bring the same number back.

        Args:
            value: the value.
            short: four digits are enough.
        """
        from slipwise.units import parse_unit

        unit = self.shown_in or self.unit
        in_unit = value / parse_unit(unit, self.unit, self.name)
        digits = 4
        while not short and digits < 15 and not same_number(float(f"{in_unit:.{digits}g}"), in_unit):
            digits += 1
        return f"{in_unit:.{digits}g}{'' if unit == '1' else ' ' + unit}"

    def written(self, value: float) -> str | float:
        """Return a value [SI] as a file has it: a pure number bare, anything else with its unit.

        Args:
            value: in the parameter's SI unit.
        """
        text = self.shown(value)
        return text if " " in text else float(text)


def same_number(value: float, other: float) -> bool:
    """Return whether two numbers differ by no more than conversions of units do."""
    return abs(value - other) <= 1e-13 * abs(other)
