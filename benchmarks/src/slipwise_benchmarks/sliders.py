"""Families of single sliders: tests with a prescribed slip, by a machine that holds or varies the load.

`build_slider(kind, seed, maker)` makes one in memory, with its answer. Something may hide beside the kind itself: each
law of `slipwise_benchmarks.slider_friction`, or a contact that gives way before it slips.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.bearing import Bearing, Force, draw_bearing, drive_of, record
from slipwise_benchmarks.slider_friction import Drive
from slipwise_benchmarks.slider_key import slider_key

Array = NDArray[np.float64]


def _force_of_library(bearing: Bearing, drive: Drive) -> Array:
    """Give the force by the library, which needs to be installed for nothing else."""
    from slipwise_benchmarks.slider_library import library_force

    return library_force(bearing, drive)


#: Maker -> what gives the force of a test.
FORCES: dict[str, Force] = {"ode": Bearing.force, "replay": _force_of_library}
#: Run -> role, share of the stroke, share of the largest speed.
_RUNS = {"slow": ("fit", 1.0, 0.25), "fast": ("fit", 0.9, 1.0), "other": ("holdout", 0.7, 0.5)}
#: Longest slip over which friction turns round that both makers can make [m].
_LONGEST = 4.9e-3
#: Sizes of what hides in friction: lowest and highest.
_HIDDEN: dict[str, tuple[float, float]] = {
    "direction_asymmetry": (0.01, 0.1),
    "run_in": (0.03, 0.3),
    "breakaway": (0.002, 0.03),
}
_PRESSURE = (0.05, 0.4)


@dataclass(frozen=True)
class SliderCampaign:
    """One test in memory.

    Attributes:
        bearing: what was tested.
        roles: run -> "fit" or "holdout".
        tables: run -> what `slipwise_benchmarks.bearing.record` gives.
        answer: as plain data.
    """

    bearing: Bearing
    roles: dict[str, str]
    tables: dict[str, Array]
    answer: dict[str, Any]


def build_slider(kind: str, seed: int, maker: str) -> SliderCampaign:
    """Make a test of a single slider.

    Args:
        kind: a key of `KINDS_OF_SLIDER`.
        seed: of everything random.
        maker: a key of `FORCES`.
    """
    rng = np.random.default_rng([seed, 67])
    bearing, fast = KINDS_OF_SLIDER[kind](seed, rng)
    noise, motion = rng.spawn(2)
    drives = {run: drive_of(bearing, motion, share, speed * fast) for run, (_, share, speed) in _RUNS.items()}
    tables = {run: record(bearing, noise, drive, FORCES[maker]) for run, drive in drives.items()}
    answer = {
        "effects": slider_key(bearing, [drives["slow"], drives["other"]], FORCES[maker]),
        "imperfections": {"zero": bearing.zero, "control": bearing.control, "noise": list(bearing.noise)},
        "settings": {name: _finite(value) for name, value in vars(bearing).items() if name != "hidden"},
        "details": {name: {"size": size} for name, size in bearing.hidden},
    }
    return SliderCampaign(bearing, {run: role for run, (role, *_) in _RUNS.items()}, tables, answer)


def _finite(value: Any) -> Any:
    """Give the same, None in place of what is infinite, which JSON has not."""
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _with_hidden(bearing: Bearing, rng: np.random.Generator, names: tuple[str, ...]) -> Bearing:
    """Hide one of these in friction, or, as often as not, nothing."""
    if rng.random() < 0.5:
        return bearing
    name = str(rng.choice(names))
    if name == "presliding":
        return replace(bearing, turning=min(_log(rng, 3.0e-3, 0.1), _LONGEST / bearing.stroke))
    sign = float(rng.choice([-1.0, 1.0])) if name != "breakaway" else 1.0
    return replace(bearing, hidden=((name, sign * _log(rng, *_HIDDEN[name])),))


def _slider(seed: int, rng: np.random.Generator) -> tuple[Bearing, float]:
    bearing = draw_bearing(str(rng.choice(["flat", "flat", "rim"])), seed)
    return _with_hidden(bearing, rng, (*_HIDDEN, "presliding")), _log(rng, 0.05, 0.6)


def _tribometer(seed: int, rng: np.random.Generator) -> tuple[Bearing, float]:
    """A pin under some newtons on a plate that goes to and fro by millimetres, slowly."""
    load, stroke, drawn = _log(rng, 5.0, 500.0), _log(rng, 1.0e-3, 1.5e-2), draw_bearing("flat", seed)
    bearing = replace(drawn, load=load, stroke=stroke, zero=drawn.zero * load / drawn.load, rate=10.0 * drawn.rate)
    return _with_hidden(bearing, rng, ("direction_asymmetry", "run_in", "presliding")), _log(rng, 2.0e-3, 6.0e-2)


def _pendulum(seed: int, rng: np.random.Generator) -> tuple[Bearing, float]:
    return _with_hidden(draw_bearing("pendulum", seed), rng, (*_HIDDEN,)), _log(rng, 0.05, 0.6)


def _swung_pendulum(seed: int, rng: np.random.Generator) -> tuple[Bearing, float]:
    bearing = replace(draw_bearing("pendulum", seed), varying=float(rng.uniform(0.1, 0.45)))
    if rng.random() < 0.3:
        size = float(rng.choice([-1.0, 1.0])) * _log(rng, *_PRESSURE)
        bearing = replace(bearing, hidden=(("pressure_law", size),))
    return bearing, _log(rng, 0.05, 0.6)


def _spring_or_wall(seed: int, rng: np.random.Generator) -> tuple[Bearing, float]:
    """A spring through the middle, a wall beyond a gap, or both; friction none."""
    bearing = draw_bearing("spring", seed)
    kind = str(rng.choice(["both", "spring", "wall"]))
    if kind == "spring":
        bearing = replace(bearing, wall=0.0, gap=np.inf)
    elif kind == "wall":
        bearing = replace(bearing, stiffness=0.0)
    return bearing, _log(rng, 0.05, 0.6)


#: kind -> what draws the bearing and the largest speed of its tests [m/s].
KINDS_OF_SLIDER: dict[str, Callable[[int, np.random.Generator], tuple[Bearing, float]]] = {
    "slider": _slider,
    "tribometer": _tribometer,
    "pendulum": _pendulum,
    "swung_pendulum": _swung_pendulum,
    "spring_or_wall": _spring_or_wall,
}
