"""The quantities of a bearing that standards name, from its loop of force F against slip x under a load N.

    energy of a cycle             E = closed integral of F dx
    effective stiffness           K_eff = (F+ - F-) / (x+ - x-),            at the largest slip to both sides
    equivalent damping            xi = (2/pi) E / [K_eff (x+ - x-)^2]  =  E / (2 pi K_eff d^2),     d = (x+ - x-)/2
    characteristic strength       Q_d: half the distance of the two sliding branches at zero slip
    second-slope stiffness        K_d: mean slope dF/dx of the two sliding branches
    coefficient of friction       mu = integral of F dx / integral of N |dx|;  at one instant |F - K_d x| / N

Source: ASCE/SEI 7-16, section 17.8.3 (effective stiffness and damping); EN 15129:2009, chapter 8 (isolators, sliding
surfaces); Constantinou et al., MCEER-07-0012 (2007), for Q_d and K_d of sliding bearings.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array, Mask
from slipwise.bearings.coefficients import (
    at_peak_speed,
    breakaway,
    first_breakaway,
    fit_restoring_stiffness,
    is_fastest,
    take_restoring_out,
)
from slipwise.bearings.loops import Loop
from slipwise.bearings.sliding_branches import (
    find_turned_round,
    fit_sliding_branches,
    force_at_turn,
    is_in_the_middle,
    shows_sliding_alone,
)


@dataclass(frozen=True)
class Quantity:
    """One quantity.

    Attributes:
        key: in JSON.
        words: as tables name it.
        unit: SI.
        of_cycle: whether it needs a closed cycle; the others are given for whole runs too.
    """

    key: str
    words: str
    unit: str
    of_cycle: bool = False


QUANTITIES: tuple[Quantity, ...] = (
    Quantity("friction_mean", "coefficient of friction, mean", "1"),
    Quantity("friction_breakaway", "coefficient of friction, breakaway", "1"),
    Quantity("breakaway_pressure", "pressure at breakaway", "Pa"),
    Quantity("friction_peak_speed", "coefficient of friction, at peak speed", "1"),
    Quantity("peak_speed", "peak speed", "m/s"),
    Quantity("peak_speed_pressure", "pressure at peak speed", "Pa"),
    Quantity("mean_pressure", "mean pressure", "Pa"),
    Quantity("energy", "energy dissipated", "J"),
    Quantity("way", "way slid", "m"),
    Quantity("displacement_max", "largest slip", "m"),
    Quantity("displacement_min", "smallest slip", "m"),
    Quantity("characteristic_strength", "characteristic strength Q_d", "N", True),
    Quantity("second_slope_stiffness", "post-sliding stiffness K_d", "N/m", True),
    Quantity("effective_stiffness", "effective stiffness K_eff", "N/m", True),
    Quantity("equivalent_damping", "equivalent damping", "1", True),
)
#: Those that the motion alone decides: a law says nothing of them.
OF_MOTION = frozenset({"peak_speed", "way", "displacement_max", "displacement_min", "mean_pressure",
                       "peak_speed_pressure", "breakaway_pressure"})  # fmt: skip
#: Force at the largest slip over that of the sliding branches there: beyond this a rim or a stop was reached [1].
_STOPPED = 1.25
Values = dict[str, NDArray[Any]]


def measure_cycle(loop: Loop) -> Values:
    """Return every quantity of one closed cycle, key -> (d,) SI; NaN where it cannot be given.

    Q_d, K_d and breakaway cannot where friction turns round over so much of the stroke that no part of it shows sliding
    alone.

    Args:
        loop: of the cycle.
    """
    up, down = int(np.argmax(loop.slip)), int(np.argmin(loop.slip))
    stroke = float(loop.slip[up] - loop.slip[down])
    strength, slope = fit_sliding_branches(loop)
    if not shows_sliding_alone(loop):
        strength, slope = np.full_like(strength, np.nan), np.full_like(slope, np.nan)
    friction = take_restoring_out(loop, slope)
    branches = ((up, down, -1.0), (down, up, 1.0))
    turned = [find_turned_round(loop, a, b, sign * friction[:, 0], float(strength[0])) for a, b, sign in branches]
    at_ends = [force_at_turn(loop, turn, np.nan_to_num(slope)) for turn in (up, down)]
    if 0.5 * (at_ends[0][0] - at_ends[1][0]) > _STOPPED * (strength[0] + slope[0] * 0.5 * stroke):
        # a stop pushes back at the turns, and what of the force is friction there is not known
        turned = [samples[:0] for samples in turned]
    broken = [breakaway(loop, sign * friction, order) for (_, _, sign), order in zip(branches, turned, strict=True)]
    energy, stiffness = _energy(loop), (at_ends[0] - at_ends[1]) / stroke
    middle = is_in_the_middle(loop)
    fastest = is_fastest(loop, middle & (loop.direction > 0)) | is_fastest(loop, middle & (loop.direction < 0))
    return {
        **_of_motion(loop, fastest),
        "energy": energy,
        "friction_mean": energy / _carried_way(loop),
        "friction_breakaway": 0.5 * (broken[0][0] + broken[1][0]),
        "breakaway_pressure": 0.5 * (broken[0][1] + broken[1][1]),
        "friction_peak_speed": at_peak_speed(loop, friction, fastest),
        "characteristic_strength": strength,
        "second_slope_stiffness": slope,
        "effective_stiffness": stiffness,
        "equivalent_damping": 2.0 / np.pi * energy / (stiffness * stroke**2),
    }


def measure_run(loop: Loop) -> Values:
    """Return the quantities of a whole run, of any motion, key -> (d,) SI; NaN where one cannot be given.

    Breakaway is that of the first movement from rest.

    Args:
        loop: of the run.
    """
    energy = _energy(loop)
    friction = take_restoring_out(loop, fit_restoring_stiffness(loop))
    mean = energy / _carried_way(loop)
    broken = first_breakaway(loop, friction, mean)
    fastest = is_fastest(loop, np.ones(len(loop.slip), dtype=bool))
    return {
        **_of_motion(loop, fastest),
        "energy": energy,
        "friction_mean": mean,
        "friction_breakaway": broken[0],
        "breakaway_pressure": broken[1],
        "friction_peak_speed": at_peak_speed(loop, friction, fastest),
    }


def _of_motion(loop: Loop, fastest: Mask) -> Values:
    """Return what the motion alone decides; peak speed, mean of both directions, of the fastest samples (m,)."""
    steps = np.abs(np.diff(loop.slip))
    peaks = [loop.speed[kept].max() for sign in (1.0, -1.0) if (kept := fastest & (loop.direction == sign)).any()]
    carried = steps @ (0.5 * (loop.load[1:] + loop.load[:-1]))
    return {
        "peak_speed": np.array([np.mean(peaks)]),
        "way": np.array([steps.sum()]),
        "displacement_max": np.array([loop.slip.max()]),
        "displacement_min": np.array([loop.slip.min()]),
        "mean_pressure": np.array([carried / (steps.sum() or np.nan) / loop.area]),
        "peak_speed_pressure": np.array([loop.load[fastest].mean() / loop.area]),
    }


def _energy(loop: Loop) -> Array:
    return np.asarray(np.diff(loop.slip) @ (0.5 * (loop.force[1:] + loop.force[:-1])))


def _carried_way(loop: Loop) -> float:
    """Return the way slid times the load carried over it, as far as friction acts along x [N m]; NaN where it is 0."""
    steps, share = np.abs(np.diff(loop.slip)), 0.5 * (loop.along[1:] + loop.along[:-1])
    return float(steps @ (share * 0.5 * (loop.load[1:] + loop.load[:-1]))) or float("nan")
