"""Where in its motion a slider is: stuck, breaking away, slow, steady, turning, lifted; and how far since it turned."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun

STATES: tuple[str, ...] = ("stick", "breakaway", "low speed", "reversal", "steady +", "steady −", "uplift")
#: A direction counts once the slider is faster than this part of its usual speed, or 2 mm/s [1, m/s].
_MOVING_PART, _MOVING = 0.05, 2e-3
#: Slow: below this part of its usual speed, or 2 cm/s [1, m/s].
_SLOW_PART, _SLOW = 0.2, 2e-2
#: "At" a reversal or a breakaway: within this part of the usual way between two turns [1].
_NEAR = 0.04


@dataclass(frozen=True)
class MotionStates:
    """States of one run, (n,) each.

    Attributes:
        label: number in `STATES`.
        direction: +1 or -1, the last one in which it clearly moved; 0 before it moved.
        since_turn: way since the last reversal [m]; NaN before the first.
        path: slid since the run began [m].
        way: usual way between two turns [m].
    """

    label: NDArray[np.int64]
    direction: NDArray[np.int64]
    since_turn: Array
    path: Array
    way: float


def classify_motion_states(run: FitRun) -> MotionStates:
    """Sort the samples of a run."""
    velocity, states = run.velocity, run.states
    speed = np.abs(velocity)
    usual = float(np.quantile(speed, 0.95))
    moving = min(_MOVING, _MOVING_PART * usual)
    direction = _held(np.where(speed > moving, np.sign(velocity), 0.0)).astype(np.int64)
    path = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(run.time))])
    turns, clear = _turns(direction, velocity)
    for turn, first in zip(turns, clear, strict=True):
        # a direction begins where motion turned, not where it became clear
        direction[turn:first] = direction[first]
    since_turn = _since(path, turns)
    ways = np.diff(path[turns]) if len(turns) > 1 else np.array([path[-1]])
    way = float(np.quantile(ways[ways > 0.0], 0.9)) if np.any(ways > 0.0) else float(path[-1])
    stuck = states.stuck
    freed = np.flatnonzero(stuck[:-1] & ~stuck[1:]) + 1
    since_stick = _since(path, freed)
    slow = speed < min(_SLOW, _SLOW_PART * usual)
    near = _NEAR * way
    label = np.where(direction >= 0, STATES.index("steady +"), STATES.index("steady −"))
    label = np.where(slow, STATES.index("low speed"), label)
    turning = (since_turn < near) | (slow & _before(turns, path, near))
    label = np.where(turning, STATES.index("reversal"), label)
    label = np.where(since_stick < near, STATES.index("breakaway"), label)
    label = np.where(stuck, STATES.index("stick"), label)
    label = np.where(states.uplift, STATES.index("uplift"), label)
    return MotionStates(label.astype(np.int64), direction, since_turn, path, way)


def _held(values: Array) -> Array:
    """Let every zero repeat the value before it."""
    place = np.where(values != 0.0, np.arange(len(values)), 0)
    return values[np.maximum.accumulate(place)]


def _turns(direction: NDArray[np.int64], velocity: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the samples at which motion turns round, and those at which the new direction is clear.

    It turns where velocity last changed sign before the new direction.
    """
    changed = np.flatnonzero((direction[1:] != direction[:-1]) & (direction[:-1] != 0)) + 1
    crossings = np.flatnonzero(np.signbit(velocity[1:]) != np.signbit(velocity[:-1])) + 1
    if len(crossings) == 0 or len(changed) == 0:
        return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
    last = np.searchsorted(crossings, changed, side="right") - 1
    turns, places = np.unique(crossings[np.maximum(last, 0)], return_index=True)
    return turns, changed[places]


def _since(path: Array, events: NDArray[np.int64]) -> Array:
    """Return the way since the last event; NaN before the first."""
    if len(events) == 0:
        return np.full(len(path), np.nan)
    last = np.searchsorted(events, np.arange(len(path)), side="right") - 1
    return np.where(last >= 0, path - path[events[np.maximum(last, 0)]], np.nan)


def _before(events: NDArray[np.int64], path: Array, reach: float) -> NDArray[np.bool_]:
    """Tell which samples lie less than a way before an event."""
    if len(events) == 0:
        return np.zeros(len(path), dtype=bool)
    coming = np.searchsorted(events, np.arange(len(path)), side="left")
    known = coming < len(events)
    return known & (path[events[np.minimum(coming, len(events) - 1)]] - path < reach)
