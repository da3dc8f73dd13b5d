"""The syntax of synthetic motions: "sine:2Hz,0.3g,cycles=30,vertical=5Hz,0.2g".

A part with "=" begins an option; the parts without "=" after it are further values of the same option: vertical above
has two values, 5Hz and 0.2g. What stands before the first option are the motion's own values.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError, UnitError, unknown_name
from slipwise.short_repr import short_repr
from slipwise.units import quantity

#: A motion is sampled at this step [s]: the step of a replay, so that nothing is resampled by default.
STEP = 0.0005
#: Above this a sine has fewer than twenty samples a cycle [Hz].
HIGHEST_FREQUENCY = 100.0
_LONGEST = 3600.0
_LARGEST = 1000.0


@short_repr
@dataclass(frozen=True)
class Spec:
    """A synthetic motion as written.

    Attributes:
        text: the whole of it.
        kind: "sine", "multisine", ...
        values: the parts before the first option.
        options: name -> values.
    """

    text: str
    kind: str
    values: tuple[str, ...]
    options: Mapping[str, tuple[str, ...]]

    def quantity(self, text: str, what: str, dimension_of: str) -> float:
        """Return a value of the motion in SI; it must be positive.

        Raises:
            UnitError: no unit, an unknown one, or one of another dimension.
            InputError: not positive or not finite.
        """
        # pint calls rad/s a unit of frequency and forgets the 2 pi.
        if dimension_of == "Hz" and ("rad" in text or "rpm" in text or "deg" in text):
            raise UnitError(f"{self.text}: {what} is {text!r}; give it in Hz")
        value = quantity(text, dimension_of, f"{self.text}: {what}")
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{self.text}: {what} is {text!r}; it must be positive")
        return value

    def frequency(self, text: str, what: str) -> float:
        """Return a frequency [Hz]."""
        value = self.quantity(text, what, "Hz")
        if value > HIGHEST_FREQUENCY:
            raise InputError(f"{self.text}: {what} is {text!r}; frequencies up to {HIGHEST_FREQUENCY:g} Hz are made")
        return value

    def acceleration(self, text: str, what: str) -> float:
        """Return an acceleration [m/s^2]."""
        value = self.quantity(text, what, "m/s^2")
        if value > _LARGEST:
            raise InputError(f"{self.text}: {what} is {text!r}; no table reaches {_LARGEST:g} m/s^2")
        return value

    def whole(self, name: str, default: int, least: int, most: int, why: str = "") -> int:
        """Return an option that is a whole number.

        Args:
            name: of the option.
            default: where it is not given.
            least: smallest that is possible.
            most: largest.
            why: reason for the smallest, for the message.

        Raises:
            InputError: it is not one, or out of its range.
        """
        if name not in self.options:
            return default
        (text,) = self.take(name, ("a whole number",))
        if not text.isascii() or not text.isdigit() or not least <= int(text[:12]) <= most or len(text) > 12:
            reason = f" ({why})" if why else ""
            raise InputError(
                f"{self.text}: {name} is {text!r}; it must be a whole number from {least}{reason} to {most}"
            )
        return int(text)

    def take(self, name: str, meaning: Sequence[str], optional: int = 0) -> tuple[str, ...]:
        """Return the values of an option.

        Args:
            name: of the option.
            meaning: what its values are, for the message.
            optional: how many of them may be left out at the end.

        Raises:
            InputError: too few or too many.
        """
        values = self.options[name]
        if not len(meaning) - optional <= len(values) <= len(meaning):
            raise InputError(
                f"{self.text}: {name} takes {', '.join(meaning)}; it was given {', '.join(values) or 'nothing'} "
                "(a part without '=' belongs to the option before it)"
            )
        return values

    def lasting(self, duration: float) -> float:
        """Refuse motions of more than an hour."""
        if not duration <= _LONGEST:
            raise InputError(f"{self.text}: it would last {duration:.4g} s; motions up to {_LONGEST:g} s are made")
        return duration


def parse_spec(text: str, known: Sequence[str]) -> Spec:
    """Cut a synthetic motion into its parts.

    Args:
        text: as written.
        known: the names of its options.

    Raises:
        InputError: an option given twice, or an empty part.
        UnknownNameError: an option that does not exist; the nearest one is named.
    """
    kind, _, rest = text.strip().partition(":")
    values: list[str] = []
    options: dict[str, list[str]] = {}
    current = values
    for part in (part.strip() for part in rest.split(",")) if rest.strip() else ():
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not part or (equals and not value):
            raise InputError(f"{text}: there is an empty part in it; write for example {kind}:...,{name or 'name'}=...")
        if not equals:
            current.append(part)
            continue
        if name not in known:
            raise unknown_name(f"option of {kind}:", name, known, "`slipwise motions` lists them.")
        if name in options:
            raise InputError(f"{text}: {name} is given twice; leave one of them")
        current = options[name] = [value]
    return Spec(text.strip(), kind.strip(), tuple(values), {name: tuple(given) for name, given in options.items()})


def sample_times(duration: float) -> NDArray[np.float64]:
    """Return the times of a synthetic motion (n,), from 0 to its duration or just beyond [s]."""
    return np.arange(int(np.ceil(duration / STEP - 1e-9)) + 1, dtype=np.float64) * STEP
