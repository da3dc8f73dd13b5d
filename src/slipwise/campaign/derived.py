"""Channels computed from recorded ones: simple arithmetic in which units are carried along.

    expression = term {("+" | "-") term}      term = power {("*" | "/") power}      power = factor ["^" whole number]
    factor = number [unit] | channel | "abs(" expression ")" | "sqrt(" expression ")" | "(" expression ")" | "-" factor

A unit follows its number and holds no blanks: "490.87 mm^2", "9.81 m/s^2". "20 degC" is the temperature of 293.15 K; a
difference of temperatures is written in K. Nothing is evaluated as Python.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import channel
from slipwise.errors import InputError, UnitError, unknown_name
from slipwise.units import parse_unit, quantity

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?:\s*(?P<unit>[A-Za-zµ°%\u03bc][^\s()]*))?"
    r"|(?P<name>[A-Za-z_]\w*)|(?P<sign>\*\*|[-+*/^()]))"
)
#: Inside a product of units, pint would read these letters as gram and as nothing.
_ENGINEERS = {"g": "gee", "G": "gee", "t": "ton_metric", "%": "percent"}
_TEMPERATURES = {"degC": "degC", "°C": "degC", "C": "degC", "degF": "degF", "°F": "degF", "F": "degF"}
#: An expression has no more parts than these, no deeper brackets and signs, and no larger powers.
_PARTS, _DEEPEST, _LARGEST_POWER = 200, 20, 9
_FUNCTIONS = {"abs": np.abs, "sqrt": np.sqrt}


@dataclass(frozen=True)
class _Value:
    """Numbers in a unit that is written as a product of known units."""

    numbers: Array
    unit: str


def evaluate(expression: str, columns: Mapping[str, Array], target: str, what: str) -> Array:
    """Compute a channel.

    Args:
        expression: as written in [derived].
        columns: channels that are already known, each (n,), SI.
        target: the channel that is computed; its unit decides which dimension the result must have.
        what: where the expression stands, for messages.

    Returns:
        (n,) in the SI unit of the target.

    Raises:
        InputError: the expression cannot be read.
        UnitError: units that do not fit together, or a result of the wrong dimension.
        UnknownNameError: a channel that is not there.
    """
    parser = _Parser(expression, columns, what)
    value = parser.expression()
    parser.end()
    factor = _factor(value.unit, channel(target).unit, f"{what}: the result of {expression!r}")
    size = len(next(iter(columns.values()))) if columns else 1
    return np.broadcast_to(factor * value.numbers, (size,)).astype(float)


def _factor(unit: str, to: str, what: str) -> float:
    try:
        return parse_unit(unit, to, what)
    except UnitError:
        raise UnitError(
            f"{what} has the unit {unit}, which cannot be turned into '{to}'; check the units of its parts"
        ) from None


class _Parser:
    """Reads one expression from left to right."""

    def __init__(self, text: str, columns: Mapping[str, Array], what: str) -> None:
        self.text, self.columns, self.what = text, columns, what
        self.tokens: list[tuple[str, str, str]] = []
        position = 0
        while text[position:].strip():
            match = _TOKEN.match(text, position)
            if match is None:
                raise InputError(
                    f"{what}: {text[position:]!r} cannot be read; use channels, numbers with units, + - * / ^ ( )"
                )
            kind = match.lastgroup if match.lastgroup != "unit" else "number"
            self.tokens.append((str(kind), match[str(kind)], match["unit"] or ""))
            position = match.end()
            if len(self.tokens) > _PARTS:
                raise InputError(
                    f"{what}: the expression {text[:40]!r}... has more than {_PARTS} parts; compute it in channels of "
                    "its own, such as pad_A_N_raw"
                )
        self.depth = 0
        self.tokens.append(("end", "", ""))

    def _take(self, *signs: str) -> str:
        kind, text, _ = self.tokens[0]
        if kind == "sign" and text in signs:
            self.tokens.pop(0)
            return text
        return ""

    def end(self) -> None:
        if self.tokens[0][0] != "end":
            raise InputError(
                f"{self.what}: {self.tokens[0][1]!r} was not expected in {self.text!r}; is an operator missing?"
            )

    def expression(self) -> _Value:
        value = self.term()
        while sign := self._take("+", "-"):
            other = self.term()
            factor = _factor(
                other.unit, value.unit, f"{self.what}: {self.text!r} adds {value.unit} and {other.unit}; it"
            )
            value = _Value(value.numbers + (factor if sign == "+" else -factor) * other.numbers, value.unit)
        return value

    def term(self) -> _Value:
        value = self.power()
        while sign := self._take("*", "/"):
            other = self.power()
            if sign == "*":
                value = _Value(value.numbers * other.numbers, f"{value.unit}*{other.unit}")
            else:
                with np.errstate(divide="ignore", invalid="ignore"):
                    quotient = value.numbers / other.numbers
                if not np.isfinite(quotient).all():
                    raise InputError(f"{self.what}: {self.text!r} divides by zero in some rows")
                value = _Value(quotient, f"{value.unit}/{other.unit}")
        return value

    def power(self) -> _Value:
        value = self.factor()
        if self._take("^", "**"):
            negative = bool(self._take("-"))
            kind, text, unit = self.tokens.pop(0)
            if kind != "number" or unit or not text.isdigit():
                raise InputError(f"{self.what}: an exponent must be a whole number, not {text + unit!r}")
            if len(text) > 1:
                raise InputError(
                    f"{self.what}: the power {text[:20]} is too large; powers up to {_LARGEST_POWER} are read"
                )
            exponent = -int(text) if negative else int(text)
            return _Value(value.numbers ** float(exponent), f"({value.unit})**({exponent})")
        return value

    def factor(self) -> _Value:
        self.depth += 1
        if self.depth > _DEEPEST:
            raise InputError(f"{self.what}: {self.text[:40]!r} is nested deeper than {_DEEPEST} brackets and signs")
        value = self.innermost()
        self.depth -= 1
        return value

    def innermost(self) -> _Value:
        if self._take("-"):
            kind, text, unit = self.tokens[0]
            if kind == "number" and unit in _TEMPERATURES:
                self.tokens[0] = (kind, f"-{text}", unit)
                return self.factor()
            value = self.factor()
            return _Value(-value.numbers, value.unit)
        if self._take("("):
            return self._closed(self.expression())
        kind, text, unit = self.tokens.pop(0)
        if kind == "number":
            if degrees := _TEMPERATURES.get(unit):
                # A temperature on a scale with a zero of its own; inside a product pint would take it for a difference.
                return _Value(np.asarray(quantity(f"{text} {degrees}", "K", self.what)), "(K)")
            written = _ENGINEERS.get(unit, unit.replace("^", "**")) or "1"
            parsed = f"({written})"
            self._known(parsed, unit)
            return _Value(np.asarray(float(text)), parsed)
        if kind == "name" and text in _FUNCTIONS and self._take("("):
            inner = self._closed(self.expression())
            if text == "sqrt" and np.any(inner.numbers < 0.0):
                raise InputError(f"{self.what}: {self.text!r} takes the root of negative numbers")
            unit_of = inner.unit if text == "abs" else f"({inner.unit})**0.5"
            return _Value(_FUNCTIONS[text](inner.numbers), unit_of)
        if kind == "name":
            if text not in self.columns:
                raise unknown_name("channel in this campaign", text, self.columns, f"({self.what})")
            return _Value(self.columns[text], f"({channel(text).unit})")
        raise InputError(f"{self.what}: {self.text!r} ends too early or holds {text!r} where a value should stand")

    def _closed(self, value: _Value) -> _Value:
        if not self._take(")"):
            raise InputError(f"{self.what}: a closing bracket is missing in {self.text!r}")
        return value

    def _known(self, unit: str, written: str) -> None:
        """Refuse a unit that does not exist, by turning it into itself."""
        try:
            parse_unit(unit, unit, self.what)
        except UnitError:
            raise UnitError(
                f"{self.what}: the unit {written!r} is not known; write the unit right after its number, without "
                "blanks, and blanks around operators"
            ) from None
