"""A law outside the catalogue: over which states, at which port, of which form, with which constants."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from slipwise_benchmarks.law_drivers import DRIVERS
from slipwise_benchmarks.law_force import PORTS
from slipwise_benchmarks.law_shape import FORMS
from slipwise_benchmarks.law_states import LAGGED, STATES, UNITS
from slipwise_benchmarks.settings import PAD_SIGN_X, PAD_SIGN_Y, PADS, Settings

Range = tuple[float, float]
#: Form -> its constants beside the size, and the settings that hold them.
_CONSTANTS: dict[str, dict[str, str]] = {
    "power": {"scale": "law_scale", "exponent": "law_exponent"},
    "tanh": {"scale": "law_scale"},
    "step": {"place": "law_place", "width": "law_scale"},
    "bump": {"place": "law_place", "width": "law_scale"},
    "lorentz": {"place": "law_place", "width": "law_scale"},
    "exp": {"scale": "law_scale"},
    "sine": {"period": "law_scale", "phase": "law_phase"},
    "hinge": {"place": "law_place"},
}
#: How often the unit of its state divides that of a size [1].
_ORDER = {"linear": 1, "square": 2, "hinge": 1}


@dataclass(frozen=True)
class Law:
    """A family of laws whose constants are drawn.

    Attributes:
        states: one, or two whose product drives it; names of `STATES` or one of `DRIVERS`.
        port: "adds to mu", "multiplies mu", "one pad", "girder", "buffer" or "load".
        form: one of `FORMS`.
        size: typical, SI; of `EQUATIONS`.
        ranges: setting of the law without "law_" -> range that it is drawn from, by its logarithm where it is positive.
        parity: of the force, when the slip velocity changes its sign and nothing else does.
        where: places that are drawn from: "all", "pad A" to "pad D", "side x+", "side x-", "side y+", "side y-".
        signs: of the size.
        signed: whether a force on the girder or a buffer is directed against the slip velocity.
    """

    states: tuple[str, ...]
    port: str
    form: str
    size: float
    ranges: Mapping[str, Range] = field(default_factory=dict)
    parity: str = "odd"
    where: tuple[str, ...] = ("all",)
    signs: tuple[float, ...] = (1.0, -1.0)
    signed: bool = True

    @property
    def absent(self) -> bool:
        """Whether no state of the library drives it."""
        return self.states[0] in DRIVERS

    def change(self, rng: np.random.Generator, scale: float) -> dict[str, Any]:
        """Draw constants and give the settings that they change.

        Args:
            rng: generator.
            scale: of the size, in multiples of what is typical.
        """
        names = (*STATES, *DRIVERS)
        place = str(rng.choice(self.where))
        port = "multiplies mu" if self.port == "one pad" else self.port
        size = float(rng.choice(self.signs)) * self.size * scale
        drawn = {f"law_{name}": _drawn(rng, *limits) for name, limits in self.ranges.items()}
        return drawn | {
            "law_port": PORTS.index(port) + 1,
            "law_form": FORMS.index(self.form) + 1,
            "law_state": names.index(self.states[0]) + 1,
            "law_other": names.index(self.states[1]) + 1 if len(self.states) > 1 else 0,
            "law_signed": self.signed,
            "law_pads": pads_at(place),
            "law_size": size,
        }

    def constants(self, settings: Settings) -> dict[str, dict[str, Any]]:
        """Give name -> {"value": SI, "unit"} of the constants that a specimen's law has."""
        unit = UNITS.get(self.states[0], "1")
        out = {"size": {"value": settings.law_size, "unit": self._size_unit()}}
        for name, setting in _CONSTANTS.get(self.form, {}).items():
            of = {"exponent": "1", "phase": "rad"}.get(name, "s" if self.absent else unit)
            out[name] = {"value": getattr(settings, setting), "unit": of}
        if settings.law_back > 0.0:
            out["period back"] = {"value": settings.law_back, "unit": unit}
        if set(self.states) & {*LAGGED, "separate_body", "swinging_body"}:
            out["time"] = {"value": settings.law_time, "unit": "s"}
        return out

    def truth(self, settings: Settings) -> dict[str, Any]:
        """Give the law of a specimen as a scorer reads it."""
        return {
            "state": list(self.states),
            "port": self.port,
            "where": place_of(settings.law_pads),
            "parity": self.parity,
            "form": "product" if len(self.states) > 1 else self.form,
            "by direction": settings.law_back > 0.0,
            "constants": self.constants(settings),
            "driver": "absent" if self.absent else "in library",
        }

    def _size_unit(self) -> str:
        own = "N" if self.port in ("girder", "buffer", "load") else "1"
        units = [UNITS.get(name, "1") for name in self.states for _ in range(_ORDER.get(self.form, 0))]
        return "/".join([own, *(f"({unit})" for unit in units if unit != "1")])


def _drawn(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))) if low > 0.0 else rng.uniform(low, high))


def pads_at(where: str) -> tuple[float, ...]:
    """Give the share (4,) of a law that each pad has."""
    if where == "all":
        return (1.0,) * len(PADS)
    kind, _, which = where.partition(" ")
    if kind == "pad":
        return tuple(float(pad == which) for pad in PADS)
    signs = PAD_SIGN_X if which[0] == "x" else PAD_SIGN_Y
    return tuple(float((sign > 0.0) == (which[1] == "+")) for sign in signs)


def place_of(shares: tuple[float, ...]) -> str:
    """Give the place of `pads_at` that has these shares."""
    places = ("all", *(f"pad {pad}" for pad in PADS), "side x+", "side x-", "side y+", "side y-")
    return next(place for place in places if pads_at(place) == tuple(shares))
