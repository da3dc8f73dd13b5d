"""A curve described before any form is put over it: which way it goes, how it ends, and its values there.

That is often all that an engineer needs, and it holds whichever form is chosen afterwards.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import isotonic_regression

from slipwise.arrays import Array
from slipwise.estimation.intervals import compute_halfwidth
from slipwise.residual_map.curve import ResidualCurve
from slipwise.residual_map.states import UNITS, DrivingState
from slipwise.short_repr import short_repr

#: A height is off a description when it is by this many standard errors, and by this share of the curve's range [1].
_OFF, _OF_RANGE = 2.5, 0.08
#: A part of a curve is flat where it changes by less than this share of its range [1], and such a part is so long [1].
_FLAT, _PART = 0.15, 0.3
#: Points of equal distance at which a curve is looked at, and how often it crosses its middle at least if it repeats.
_POINTS, _CROSSINGS = 61, 4
#: Share of a curve about its middle that one period explains where it repeats [1].
_PERIODIC = 0.6
#: The mean of a curve is open where its heights are so many times less sure than their differences [1].
_OPEN = 2.0


@short_repr
@dataclass(frozen=True)
class CurveShape:
    """What a curve over one state does.

    Attributes:
        state: over which.
        direction: "rises", "falls", "neither" or "flat".
        parity: "even" or "odd" in a state that takes both signs, "neither", or "" where it takes one only.
        saturates: whether it goes over into a constant.
        begins_flat: whether it begins flat and goes off from some place on, as with a threshold, or as a square does.
        periodic: whether it repeats.
        ends: per end of the data: state, value, lower and upper end of its 95 % band [SI].
        extremes: state and value where it is lowest, and where it is highest [SI].
        about_mean: whether all values are counted from the curve's mean, since base numbers can make up for that.
    """

    state: str
    direction: str
    parity: str
    saturates: bool
    begins_flat: bool
    periodic: bool
    ends: tuple[tuple[float, float, float, float], tuple[float, float, float, float]]
    extremes: tuple[tuple[float, float], tuple[float, float]]
    about_mean: bool

    @property
    def words(self) -> str:
        """The description in a sentence."""
        unit = UNITS.get(self.state, "")
        ends = [f"{y:.3g} ({low:.3g} to {high:.3g}) at {x:.3g} {unit}".rstrip() for x, y, low, high in self.ends]
        first = {"rises": "it rises", "falls": "it falls", "flat": "it hardly changes"}.get(
            self.direction, "it goes up and down"
        )
        more = [word for word, there in (
            (f"{self.parity} in its state", self.parity in ("even", "odd")),
            ("it levels off", self.saturates), ("it hardly changes at first", self.begins_flat),
            ("it repeats", self.periodic),
        ) if there]  # fmt: skip
        if self.direction == "neither":
            low, high = (f"{y:.3g} at {x:.3g} {unit}".rstrip() for x, y in self.extremes)
            more.insert(0, f"lowest {low}, highest {high}")
        if self.about_mean:
            more.append("counted from its mean, which numbers of the base model can make up for")
        return "; ".join([f"{first}, from {ends[0]} to {ends[1]}", *more])

    def as_json(self) -> dict[str, Any]:
        """Return the description for a program to read."""
        names = ("state", "value", "low", "high")
        return {
            "state": self.state,
            "direction": self.direction,
            "parity": self.parity or None,
            "saturates": self.saturates,
            "begins_flat": self.begins_flat,
            "periodic": self.periodic,
            "ends": [dict(zip(names, end, strict=True)) for end in self.ends],
            "extremes": [dict(zip(names, one, strict=False)) for one in self.extremes],
            "about_mean": self.about_mean,
            "words": self.words,
        }


def describe_curve(curve: ResidualCurve, state: DrivingState) -> CurveShape | None:
    """Describe a curve over one state; None for a curve over two, or one that has too few knots.

    Args:
        curve: with its errors.
        state: over which.
    """
    if len(curve.knots) != 1 or len(curve.knots[0]) < 4:
        return None
    knots, heights, wide = curve.knots[0], curve.heights(), curve.errors()
    errors = np.maximum(curve.errors_about_mean(), 1e-12)
    told = (curve.count > 0) & (errors < 3.0 * np.median(errors))  # where hardly a sample lies nothing is said
    if np.count_nonzero(told) < 4:
        return None
    knots, heights, errors, wide = knots[told], heights[told], errors[told], wide[told]
    span = float(np.ptp(heights))
    periodic = _repeats(knots, heights, errors)
    rises, falls = (_is_monotone(way * heights, errors, span) for way in (1.0, -1.0))
    flat = not np.any(np.abs(heights - np.average(heights, weights=errors**-2.0)) > _OFF * errors)
    direction = "flat" if flat else "rises" if rises else "falls" if falls else "neither"
    grid = np.linspace(knots[0], knots[-1], _POINTS)
    shown = np.interp(grid, knots, heights)
    part = round(_PART * _POINTS)

    about_mean = float(np.median(wide)) > _OPEN * float(np.median(errors))
    told_heights, told_errors = (heights - np.mean(heights), errors) if about_mean else (heights, wide)

    def end(i: int) -> tuple[float, float, float, float]:
        height, half = float(told_heights[i]), compute_halfwidth(float(told_errors[i]))
        return float(knots[i]), height, height - half, height + half

    def extreme(i: np.intp) -> tuple[float, float]:
        return float(knots[i]), float(told_heights[i])

    monotone = direction in ("rises", "falls")
    begins_flat, ends_flat = (float(np.ptp(piece)) < _FLAT * span for piece in (shown[:part], shown[-part:]))
    return CurveShape(
        state.name, direction, _parity(knots, heights, errors, span) if state.signed else "",
        monotone and ends_flat and not begins_flat, monotone and begins_flat and not ends_flat, periodic,
        (end(0), end(-1)), (extreme(np.argmin(heights)), extreme(np.argmax(heights))), about_mean,
    )  # fmt: skip


def _is_monotone(heights: Array, errors: Array, span: float) -> bool:
    """Return whether rising heights are within the errors, or a small share of the range, of these."""
    rising = isotonic_regression(heights, weights=errors**-2.0).x
    return bool(np.all(np.abs(heights - rising) < np.maximum(_OFF * errors, _OF_RANGE * span)))


def _parity(knots: Array, heights: Array, errors: Array, span: float) -> str:
    reach = min(-knots[0], knots[-1])
    if reach <= 0.2 * float(np.max(np.abs(knots))):
        return ""
    grid = np.linspace(0.0, reach, _POINTS)
    here, there = np.interp(grid, knots, heights), np.interp(-grid, knots, heights)
    within = np.maximum(_OFF * np.interp(grid, knots, errors), _OF_RANGE * span)
    if np.all(np.abs(here - there) < within):
        return "even"
    return "odd" if np.all(np.abs(here + there) < within) else "neither"


def _repeats(knots: Array, heights: Array, errors: Array) -> bool:
    """Return whether one period explains most of a curve that crosses its middle often."""
    grid = np.linspace(knots[0], knots[-1], 4 * _POINTS)
    shown = np.interp(grid, knots, heights)
    shown = shown - np.polyval(np.polyfit(grid, shown, 1), grid)
    if float(np.std(shown)) < float(np.median(errors)) or np.count_nonzero(np.diff(np.sign(shown))) < _CROSSINGS:
        return False
    power = np.abs(np.fft.rfft(shown))[1:] ** 2
    top = int(np.argmax(power))
    return float(power[max(0, top - 1) : top + 2].sum() / power.sum()) > _PERIODIC
