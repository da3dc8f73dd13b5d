"""A small grid over the constants of a candidate that give it its shape but do not switch it on."""

from itertools import product

import numpy as np

from slipwise.effects import Effect
from slipwise.params import Parameter

#: Constants that only say where a law is neutral: free, they are one with its strength; a grid puts that at a bound.
REFERENCES: frozenset[str] = frozenset({"rated", "reference"})
#: Most points of the grid over shape constants.
_MOST_POINTS = 5
#: Multiples of a constant's typical value that are tried: a fit that begins a decade off ends in another local minimum.
_NEARBY = (0.33, 1.0, 3.0)
#: The same where its bounds are far apart.
_FAR = (0.035, 0.2, 1.0, 5.0, 28.0)
#: A constant that is usually absent is tried at this share of its largest value too [1].
_SOME = 0.1
#: A constant whose bounds are this far apart may be far from typical [1].
_WIDE = 100.0
#: Frequencies at which a resonance is tried [Hz], and how many of them at least and at most.
_LEAST_HERTZ, _MOST_HERTZ, _RESONANCES = 5.0, 30.0, (5, 14)
#: A resonance is tried with this many times its typical damping, so that it is seen from a neighbouring frequency.
_BROAD = 3.0


def strengths(effect: Effect) -> list[Parameter]:
    """Return the parameters that are zero when the effect is absent."""
    return [p for p in effect.parameters if p.neutral is not None]


def two_sided(strength: Parameter) -> bool:
    """Return whether a strength may lie on either side of its absence."""
    return strength.low < float(strength.neutral or 0.0) < strength.high


def is_lag(effect: Effect) -> bool:
    """Return whether a fault shifts gauges in time."""
    return effect.port == "gauge" and any(p.unit == "s" for p in strengths(effect))


def is_placed(effect: Effect) -> bool:
    """Return whether a law acts at a place or a frequency: a fit that begins beside it does not find it."""
    constants = [p for p in effect.parameters if p.neutral is None and not p.whole]
    return any(p.unit == "Hz" or p.low < 0.0 < p.high for p in constants)


def is_resonance(effect: Effect) -> bool:
    """Return whether a law acts at a frequency."""
    return any(p.unit == "Hz" and p.neutral is None for p in effect.parameters)


def shapes(effect: Effect) -> list[dict[str, float]]:
    """Return a small grid over the constants that switch nothing: typical, and some multiples of it.

    Where that has more than `_MOST_POINTS`, one constant after the other is moved from its typical value.
    """
    if effect.port == "gauge":  # the form of a gauge's fault hardly changes its column, and the refit frees it
        constants = [p for p in effect.parameters if p.neutral is None]
        typical = {p.name: p.typical for p in constants}
        # but a fit changes no sign, and a gauge that was zeroed shows another column than one that was not
        either = [(p, -p.typical) for p in constants if p.low < 0.0 < p.high and p.typical != 0.0]
        either += [(p, p.low + p.high - p.typical) for p in constants if _is_either(p)]
        return [typical, *({**typical, p.name: x} for p, x in either)]
    axes = []
    for p in effect.parameters:
        if p.neutral is not None or p.name in REFERENCES:
            continue
        if p.whole:
            points = sorted({p.low, p.typical, p.high})
        elif p.typical == 0.0:  # usually absent
            points = [0.0, _SOME * p.high] if p.low == 0.0 else [0.0]
        elif p.unit == "Hz":  # a resonance is found only from nearby
            points = _resonances(effect, p)
        elif p.low < 0.0 < p.high:
            points = [p.typical * f for f in (1.0, -1.0, 0.3, -0.3)]
        else:
            factors = _FAR if p.low > 0.0 and p.high > _WIDE * p.low else _NEARBY
            points = sorted({float(np.clip(p.typical * f, p.low, p.high)) for f in factors})
        axes.append((p.name, points, p.typical))
    if not axes:
        return [{}]
    whole = [dict(zip([a[0] for a in axes], c, strict=True)) for c in product(*(a[1] for a in axes))]
    if len(whole) <= _MOST_POINTS:
        return whole
    broad = _BROAD if is_resonance(effect) else 1.0
    highest = {p.name: p.high for p in effect.parameters}
    centre = {a[0]: min(broad * a[2], highest[a[0]]) if a[2] > 0.0 else a[2] for a in axes}
    return [centre, *({**centre, name: x} for name, points, middle in axes for x in points if x != middle)]


def _is_either(constant: Parameter) -> bool:
    """Return whether a constant is usually none of something and may be all of it."""
    return (constant.low, constant.high) == (0.0, 1.0) and constant.typical in (0.0, 1.0)


def _resonances(effect: Effect, frequency: Parameter) -> list[float]:
    """Return frequencies as far apart as the resonance is wide where it is tried [Hz]."""
    low, high = max(frequency.low, _LEAST_HERTZ), min(frequency.high, _MOST_HERTZ)
    width = 2.0 * _BROAD * min((p.typical for p in effect.parameters if p.name == "damping"), default=0.0)
    count = int(np.clip(np.log(high / low) / max(width, 1e-3), *_RESONANCES))
    return [float(x) for x in np.geomspace(low, high, count)]


def variants(effect: Effect, values: dict[str, float]) -> list[dict[str, float]]:
    """Return the values again, and with a smaller whole number, or the other of two, which no fit changes."""
    whole = [p for p in effect.parameters if p.whole]
    others = {p.name: p.low + p.high - values[p.name] for p in whole if _is_either(p)}
    others |= {p.name: float(values[p.name] // 2) for p in whole if not _is_either(p) and values[p.name] > p.low}
    return [values, *({**values, name: value} for name, value in others.items())]
