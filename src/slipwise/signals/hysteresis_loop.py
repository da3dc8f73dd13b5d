"""Loops as numbers: energy, edge slope, flatness and corner sharpness of a force against slip."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.errors import InputError, SettingError

#: A turn counts as a reversal when slip goes back by more than this fraction of its range.
_TURN = 0.01


@dataclass(frozen=True)
class LoopShape:
    """The shape of one pad's loop, or of the sum's.

    On the sliding branches the loop is taken as a trapezoid: |F| = force_up + edge_slope x where slip grows, and
    |F| = force_down + edge_slope x where it shrinks, fitted over the fast part with every metre of sliding weighing
    the same.

    Attributes:
        energy: dissipated over the whole record [J].
        energy_per_cycle: the energy over `cycles` [J].
        cycles: slid path over that of one cycle of the full range, 4 half_range [1].
        half_range: half of largest minus smallest slip [m].
        force_up: |F| at slip 0 where slip grows [N].
        force_down: |F| at slip 0 where slip shrinks [N].
        edge_slope: of the trapezoid, d|F|/dx on the sliding branches; 0 for a rectangle [N/m].
        flatness: 1 - rms deviation of |F| from its branch's mean over the mean |F|; 1 for a rectangle [1].
        corner_sharpness: energy over that of the same trapezoid with perfect corners; 1 if every reversal is at once
            followed by the full force, less where corners are round [1].
    """

    energy: float
    energy_per_cycle: float
    cycles: float
    half_range: float
    force_up: float
    force_down: float
    edge_slope: float
    flatness: float
    corner_sharpness: float


def energy(slip: Array, force: Array) -> float:
    """Return the work of a force over slip, the integral of F dx by trapezoids [J].

    Args:
        slip: (n,) [m].
        force: (n,) of the girder on the pad, positive when sliding to + [N].
    """
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(slip)))


def branches(slip: Array) -> NDArray[np.int8]:
    """Tell for every interval between samples whether slip is on a growing (+1) or a shrinking (-1) branch.

    Turns smaller than 1 % of the slip range are noise and do not end a branch; before the first turn of that size
    the branch is the one that leads to it. A record without any slip is all 0.

    Args:
        slip: (n,) [m].

    Returns:
        (n - 1,) of -1, 0, +1.
    """
    out = np.zeros(max(len(slip) - 1, 0), dtype=np.int8)
    threshold = _TURN * float(np.ptp(slip)) if len(slip) else 0.0
    if threshold == 0.0:
        return out
    sign, start, lowest, highest = 0, 0, 0, 0
    for i, value in enumerate(slip.tolist()):
        if value > slip[highest]:
            highest = i
        if value < slip[lowest]:
            lowest = i
        if sign <= 0 and value - slip[lowest] > threshold:
            out[start:lowest] = sign or -1
            sign, start, highest = 1, lowest, i
        elif sign >= 0 and slip[highest] - value > threshold:
            out[start:highest] = sign or 1
            sign, start, lowest = -1, highest, i
    out[start:] = sign
    return out


def loop_shape(slip: Array, force: Array, fast: float = 0.5) -> LoopShape:
    """Measure the shape of a loop.

    Args:
        slip: (n,) evenly sampled [m].
        force: (n,) of the girder on the pad or on all pads, positive when sliding to + [N].
        fast: the fast part is where the speed is above this fraction of the largest speed [1].

    Returns:
        The shape; it holds for any motion, cycles need not repeat.

    Raises:
        SettingError: `fast` is not within 0 to 1, or slip and force differ in length.
        InputError: nothing slid both ways, so that there is no loop.

    Source: docs/theory.md, sections 1.2 (trapezoid of one pad) and 1.3 (rectangle of the sum).
    """
    if not 0.0 <= fast < 1.0:
        raise SettingError(f"fast = {fast:g} is a fraction of the largest speed: 0 or more, below 1")
    if slip.shape != force.shape:
        raise SettingError(f"slip has {slip.shape} values and force {force.shape}: a loop needs them in pairs")
    branch = branches(slip)
    step = np.diff(slip)
    inside = (np.abs(step) > fast * np.max(np.abs(step), initial=0.0)) & (np.sign(step) == branch)
    up, down = inside & (branch > 0), inside & (branch < 0)
    if up.sum() < 2 or down.sum() < 2:
        raise InputError("there is no loop: slip must go both ways, with at least two fast samples each way")
    middle = 0.5 * (slip[1:] + slip[:-1])
    size = branch * 0.5 * (force[1:] + force[:-1])
    slope, flatness = _edges(middle, size, np.abs(step), up, down)
    level_up, level_down = (
        float(np.average(size[part] - slope * middle[part], weights=np.abs(step[part]))) for part in (up, down)
    )
    half_range = 0.5 * float(np.ptp(slip))
    cycles = float(np.sum(branch * step)) / (4.0 * half_range)
    sharp = float(np.sum((np.where(branch > 0, level_up, level_down) + slope * middle) * branch * step))
    total = energy(slip, force)
    return LoopShape(
        energy=total,
        energy_per_cycle=total / cycles,
        cycles=cycles,
        half_range=half_range,
        force_up=level_up,
        force_down=level_down,
        edge_slope=slope,
        flatness=flatness,
        corner_sharpness=total / sharp,
    )


def _edges(
    place: Array, size: Array, weight: Array, up: NDArray[np.bool_], down: NDArray[np.bool_]
) -> tuple[float, float]:
    """Fit one slope to both branches, each with its own level; give it and the flatness."""
    top = bottom = deviation = total = 0.0
    for part in (up, down):
        w, x, f = weight[part], place[part], size[part]
        x_off, f_off = x - np.average(x, weights=w), f - np.average(f, weights=w)
        top += float(np.sum(w * x_off * f_off))
        bottom += float(np.sum(w * x_off**2))
        deviation += float(np.sum(w * f_off**2))
        total += float(np.sum(w * f))
    all_weight = float(weight[up].sum() + weight[down].sum())
    return top / bottom, 1.0 - np.sqrt(deviation / all_weight) / (total / all_weight)
