"""What hides in a specimen that the library shakes: effects of its catalogue, or of files of the same form.

Values are drawn round those that are typical: what can switch a law on is `scale` times as far from its neutral value,
other constants are within a factor of two, within their bounds.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from slipwise_benchmarks import unlisted
from slipwise_benchmarks.hidden_pad import Change
from slipwise_benchmarks.parts import Use
from slipwise_benchmarks.settings import Settings, pad_names

if TYPE_CHECKING:  # campaigns of the second simulator are made without the library
    from slipwise.effects import Effect
    from slipwise.params import Parameter

#: Laws outside the catalogue, in the form of the catalogue.
UNLISTED: dict[str, Path] = {path.stem: path for path in sorted(Path(str(unlisted.__file__)).parent.glob("[a-z]*.py"))}
#: Dirt of a usual size is this share of what is typical of an effect [1].
OF_DIRT = 0.1
#: Constants to which a law is only referred: another value is another size.
_REFERENCES = ("rated", "reference")
_SPREAD = float(np.log(2.0))


def draw_use(name: str, rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Draw the numbers of an effect.

    Args:
        name: of the catalogue, or "unknown:washboard" for a law outside it; "unknown": one of them.
        rng: generator.
        scale: size in multiples of what is typical [1].
        base: the specimen.
    """
    from slipwise.effects import find_effect

    family, _, kind = name.partition(":")
    if family == "unknown":
        kind = kind if kind in UNLISTED else str(rng.choice(list(UNLISTED)))
        found, effect = find_effect(str(UNLISTED[kind])), str(UNLISTED[kind])
    else:
        found, effect = find_effect(family), family
    values = _switches(found, rng, scale, base)
    for parameter in found.parameters:
        if parameter.neutral is None:
            values[parameter.name] = _constant(parameter, rng)
    return {"uses": (Use(effect, tuple(values.items())),)}, kind or "of the catalogue"


def _switches(effect: Effect, rng: np.random.Generator, scale: float, base: Settings) -> dict[str, float]:
    """Give values of what switches a law on; pads of another rig than four at the corners have values of their own."""
    switches = [p for p in effect.parameters if p.neutral is not None and not p.by_pad]
    by_pad = next((p for p in effect.parameters if p.by_pad), None)
    first = switches[0]
    typical = scale * (first.typical - _neutral(first))
    if by_pad is not None and base.pads:
        pads = pad_names(base)
        chosen = pads[1:] if by_pad.by_pad == "others" else (str(rng.choice(pads)),)
        values = {p.name: _neutral(p) for p in switches}
        steps = typical * (rng.normal(size=len(chosen)) if by_pad.by_pad == "others" else np.array([_sign(rng)]))
        own = {f"{by_pad.name}[{pad}]": _within(by_pad, float(step)) for pad, step in zip(chosen, steps, strict=True)}
        return values | own
    values: dict[str, float] = {}
    for parameter in switches:
        step = scale * (parameter.typical - _neutral(parameter))
        if step == 0.0 and parameter.unit == first.unit and rng.random() < 0.5:
            step = typical * rng.uniform(-1.0, 1.0)
        # a law that can act both ways does
        step *= _sign(rng) if parameter.low < _neutral(parameter) < parameter.high else 1.0
        values[parameter.name] = _within(parameter, step)
    return values


def _sign(rng: np.random.Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))


def _neutral(parameter: Parameter) -> float:
    return 0.0 if parameter.neutral is None else parameter.neutral


def _within(parameter: Parameter, step: float) -> float:
    return float(np.clip(_neutral(parameter) + step, parameter.low, parameter.high))


def _constant(parameter: Parameter, rng: np.random.Generator) -> float:
    typical = parameter.typical
    if parameter.whole or parameter.name in _REFERENCES or typical == 0.0:
        return typical
    drawn = typical * float(np.exp(rng.uniform(-_SPREAD, _SPREAD)))
    return float(np.clip(drawn, parameter.low, parameter.high))
