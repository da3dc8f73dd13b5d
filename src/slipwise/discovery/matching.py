"""Forms matched to the curve of a residual: which of them could be the curve, and with which constants they begin."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.optimize import minimize

from slipwise.arrays import Array
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.form import Constant, Form
from slipwise.residual_map.states import DrivingState
from slipwise.short_repr import short_repr

#: Shares of the samples between which a place must lie: beyond, nothing is known of it [1].
_CENTRAL = (0.02, 0.98)
#: Periods that are tried, from two of them within the data to so many [1].
_PERIODS, _MOST_PERIODS = 40, 40.0
#: Narrowest and widest width, as shares of the range [1].
_WIDTHS = (1e-3, 3.0)
#: A reference is that quantile of the size of the state, in two digits [1].
_REFERENCE = 0.9
#: Begins the names of the constants of a second factor.
_SECOND = "second_"
#: Forms of which products are made.
_FACTORS = ("linear", "saturation", "decay", "square")


@short_repr
@dataclass(frozen=True)
class Match:
    """A form for a candidate's curve.

    Attributes:
        candidate: whose curve it is.
        forms: one per state.
        constants: name -> value; of a second state with "second_" before it.
        gain: drop of the squared residual of the screen [1].
        strength: with which it drops so.
    """

    candidate: CurveCandidate
    forms: tuple[Form, ...]
    constants: dict[str, float]
    gain: float
    strength: float

    @property
    def name(self) -> str:
        """Name of the form, or of the product."""
        return " x ".join(f.name for f in self.forms)

    @property
    def free(self) -> tuple[str, ...]:
        """Names of the constants that a fit may change."""
        return tuple(name for name, c in constants_of(self.forms).items() if c.kind != "reference")


def constants_of(forms: Sequence[Form]) -> dict[str, Constant]:
    """Return the constants of one form, or of the factors of a product, by the names that they have together."""
    return {name_of(c.name, place): c for place, form in enumerate(forms) for c in form.constants}


def name_of(constant: str, place: int) -> str:
    """Return the name that a constant of a form has as the factor at a place."""
    return constant if place == 0 else f"{_SECOND}{constant}"


def place_of(name: str) -> int:
    """Return the place of the factor, and of its state, to which a name of `name_of` belongs."""
    return int(name.startswith(_SECOND))


def own(constants: Mapping[str, float], place: int, form: Form) -> dict[str, float]:
    """Return a factor's constants under its own names."""
    return {c.name: constants[name_of(c.name, place)] for c in form.constants}


def product_at(forms: Sequence[Form], states: Sequence[Array], constants: Mapping[str, float]) -> Array:
    """Evaluate the product of forms, each at its own state."""
    out = np.ones_like(states[0])
    for place, (form, state) in enumerate(zip(forms, states, strict=True)):
        out = out * form.at(state, own(constants, place, form))
    return out


def matched(candidate: CurveCandidate, known: Mapping[str, Form]) -> list[Match]:
    """Return every form that makes sense for a candidate, with constants that fit its curve; best first."""
    if len(candidate.states) == 1:
        choices = [(f,) for f in known.values() if _makes_sense(f, candidate.states[0])]
    else:
        one, other = candidate.states
        factors = [known[name] for name in _FACTORS]
        choices = [(f, g) for f in factors for g in factors if _makes_sense(f, one) and _makes_sense(g, other)]
    found = [m for forms in choices if (m := _match(candidate, forms)) is not None]
    return sorted(found, key=lambda m: -m.gain)


def _makes_sense(form: Form, state: DrivingState) -> bool:
    if state.name == "outward":  # it takes two values
        return form.name == "linear"
    return not (form.sized and state.signed) and not (form.signed and not state.signed)


def limits(constant: Constant, state: DrivingState) -> tuple[float, float]:
    """Return the limits between which a constant makes sense, in the unit of the state."""
    low, high = _range(state)
    if constant.kind == "place":
        return low, high
    if constant.kind == "width":
        return _WIDTHS[0] * (high - low), _WIDTHS[1] * (high - low)
    if constant.kind == "period":
        return (high - low) / _MOST_PERIODS, 0.5 * (high - low)
    return constant.low, constant.high


def _range(state: DrivingState) -> tuple[float, float]:
    whole = np.concatenate([v.ravel()[:: max(1, v.size // 20000)] for v in state.values])
    low, high = np.quantile(whole, _CENTRAL)
    return float(low), float(high)


def _starts(constant: Constant, state: DrivingState) -> list[float]:
    low, high = _range(state)
    if constant.kind == "reference":
        sizes = np.concatenate([np.abs(v.ravel()[:: max(1, v.size // 20000)]) for v in state.values])
        return [float(f"{np.quantile(sizes, _REFERENCE):.2g}")]
    if constant.kind == "period":
        shortest, longest = limits(constant, state)
        return [1.0 / x for x in np.linspace(1.0 / longest, 1.0 / shortest, _PERIODS)]
    if constant.kind == "place":
        return [low + share * (high - low) for share in constant.starts]
    if constant.kind == "width":
        return [share * (high - low) for share in constant.starts]
    return list(constant.starts)


def _match(candidate: CurveCandidate, forms: tuple[Form, ...]) -> Match | None:
    named = constants_of(forms)
    state_of = {name_of(c.name, i): candidate.states[i] for i, f in enumerate(forms) for c in f.constants}
    grid = [
        dict(zip(named, point, strict=True)) for point in product(*(_starts(c, state_of[n]) for n, c in named.items()))
    ]
    gains = candidate.curve.gain_of(np.stack([heights(candidate, forms, point) for point in grid]))[0]
    if not np.isfinite(gains).any():
        return None
    best = grid[int(np.nanargmax(gains))]
    free = [n for n, c in named.items() if c.kind != "reference"]
    if free:
        bounds = {n: limits(named[n], state_of[n]) for n in free}
        scales = np.array([bounds[n][1] - bounds[n][0] for n in free]) / 20.0

        def loss(x: Array) -> float:
            point = {**best, **{n: float(np.clip(v, *bounds[n])) for n, v in zip(free, x * scales, strict=True)}}
            gain = candidate.curve.gain_of(heights(candidate, forms, point)[None])[0][0]
            return -float(gain) if np.isfinite(gain) else 0.0

        start = np.array([best[n] for n in free]) / scales
        found = minimize(loss, start, method="Nelder-Mead", options={"maxfev": 60 * len(free), "xatol": 1e-2})
        if -found.fun >= float(np.nanmax(gains)):
            values = zip(free, found.x * scales, strict=True)
            best = {**best, **{n: float(np.clip(v, *bounds[n])) for n, v in values}}
    gain, strength = candidate.curve.gain_of(heights(candidate, forms, best)[None])
    return Match(candidate, forms, best, float(gain[0]), float(strength[0]))


def heights(candidate: CurveCandidate, forms: Sequence[Form], constants: Mapping[str, float]) -> Array:
    """Return what the curve would be at the knots (K,)."""
    knots = candidate.curve.knots
    if len(forms) == 1:
        out = forms[0].at(knots[0], own(constants, 0, forms[0]))
    else:
        one, other = (f.at(k, own(constants, i, f)) for i, (f, k) in enumerate(zip(forms, knots, strict=True)))
        out = np.outer(one, other).ravel()
    return np.where(np.isfinite(out), out, 0.0)
