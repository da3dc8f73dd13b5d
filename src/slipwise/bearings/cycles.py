"""A run cut into cycles by its slip: from one crossing of zero to the next in the direction in which the run began.

A crossing counts once slip has been clearly on both sides, so that noise at rest and near zero makes none. Where slip
stays on one side of its gauge's zero, the middle of its range takes the place of zero. The first cycle may begin from
rest, and the last one may end in it.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from slipwise.arrays import Array
from slipwise.short_repr import short_repr
from slipwise.signals.hysteresis_loop import branches

#: Slip must leave zero by this share of half its range to both sides between two crossings [1].
_CLEAR = 0.02
#: Slip that reaches less far than this share of its range to one side of zero lies on the other one [1].
_ONE_SIDED = 0.1
#: Both amplitudes of a fully reversed cycle differ by no more than this share of their sum, and its way is longer than
#: there and back by no more than this share [1].
_UNEVEN = 0.1
#: Cycles whose strokes differ by no more than this share are one series [1].
_ONE_STROKE = 0.1
#: A motion is cyclic where more than this share of the way slid lies in closed cycles [1].
_CYCLIC = 0.5


@dataclass(frozen=True)
class Cycle:
    """One cycle of a run.

    Attributes:
        start: place of its first crossing, in samples from the first one; whole or between two samples.
        end: place of the next crossing.
        series: number of the series of fully reversed cycles of one stroke that it belongs to, from 1; 0 where it does
            not go as far to one side as to the other, there and back, or has no neighbour of its stroke where others
            have one.
    """

    start: float
    end: float
    series: int = 0

    @property
    def closed(self) -> bool:
        """Whether it is one of a series, of which quantities of a cycle are given."""
        return self.series > 0

    def cut(self, values: Array) -> Array:
        """Return the values (n, ...) within the cycle, with those at both ends interpolated between samples."""
        first, last = int(np.floor(self.start)) + 1, int(np.ceil(self.end))
        ends = [_between(values, place) for place in (self.start, self.end)]
        return np.concatenate([ends[0][None], values[first:last], ends[1][None]])


@short_repr
@dataclass(frozen=True)
class CyclesOfRun:
    """How a run is cut.

    Attributes:
        zero: slip at which it is cut [m].
        cycles: one after another; those of an earthquake are no closed loops.
        cyclic: whether most of the way slid lies in closed cycles.
    """

    zero: float
    cycles: tuple[Cycle, ...]
    cyclic: bool

    @property
    def longest_series(self) -> tuple[Cycle, ...]:
        """The fully reversed cycles of one stroke that are most."""
        series = [tuple(c for c in self.cycles if c.series == n) for n in {c.series for c in self.cycles if c.series}]
        return max(series, key=len, default=())


def find_cycles(slip: Array) -> CyclesOfRun:
    """Cut a run into cycles.

    Args:
        slip: (n,) smoothed [m].

    Returns:
        No cycle where nothing slides, or slip crosses zero once at most.
    """
    low, high = float(np.min(slip)), float(np.max(slip))
    zero = 0.0 if min(-low, high) >= _ONE_SIDED * (high - low) else 0.5 * (low + high)
    away = slip - zero
    clear = 0.5 * _CLEAR * (high - low)
    outside = np.flatnonzero(np.abs(away) > clear)
    if len(outside) == 0:
        return CyclesOfRun(zero, (), False)
    away = away * np.sign(away[outside[0]])  # a mirrored run is cut where the run itself is
    places = _crossings(away, clear)
    steps = branches(slip) * np.diff(slip)  # noise at rest is no way
    cycles = _number_series([Cycle(a, b) for a, b in pairwise(places)], away, steps)
    closed = sum(float(steps[int(c.start) : int(np.ceil(c.end))].sum()) for c in cycles if c.closed)
    return CyclesOfRun(zero, cycles, closed > _CYCLIC * float(steps.sum()))


def _crossings(away: Array, clear: float) -> list[float]:
    """Return the places at which slip over zero (n,) rises through zero from clearly below to clearly above."""
    side = np.where(away > clear, 1, np.where(away < -clear, -1, 0))
    known = np.flatnonzero(side)
    rises = [(int(a), int(b)) for a, b in pairwise(known) if side[a] < 0 < side[b]]
    first, last = int(known[0]), int(known[-1])
    places = [_departure(away, first)] if first else []  # a record that begins beyond zero begins within a cycle
    places += [_crossing(away, a, b) for a, b in rises]
    if side[last] < 0 and last + 1 < len(away) and away[last + 1 :].max() > -0.5 * clear:
        places.append(_arrival(away, last, clear))  # it ends at rest, back at zero
    return places


def _crossing(away: Array, below: int, above: int) -> float:
    """Return where slip passes zero for the last time between two samples."""
    i = below + int(np.flatnonzero(away[below:above] <= 0.0)[-1])
    return i + float(-away[i] / (away[i + 1] - away[i]))


def _departure(away: Array, clear_at: int) -> float:
    """Return where slip leaves zero for good before it is clear of it."""
    below = np.flatnonzero(away[:clear_at] <= 0.0)
    if len(below):
        return _crossing(away, int(below[-1]), clear_at)
    return float(np.argmin(away[: clear_at + 1]))


def _arrival(away: Array, last: int, clear: float) -> float:
    """Return where slip comes back to zero from below, or comes to rest within what is clear of it."""
    above = np.flatnonzero(away[last + 1 :] >= 0.0)
    if len(above):
        return _crossing(away, last, last + 1 + int(above[0]))
    return float(last + 1 + np.argmax(away[last + 1 :] > away[last + 1 :].max() - 0.02 * clear))


def _number_series(cycles: list[Cycle], away: Array, steps: Array) -> tuple[Cycle, ...]:
    """Return the cycles, with the number of their series where two or more follow each other at one stroke.

    A run whose only closed cycle is one has that one as its series. So has each cycle of a run that goes from stroke to
    stroke, one cycle of each; the lone cycles of a run with longer series are its rise and its end.
    """
    strokes = [_reversed_stroke(away, steps, cycle) for cycle in cycles]
    groups: list[list[int]] = []
    for place, stroke in enumerate(strokes):
        if stroke and groups and abs(stroke - strokes[groups[-1][0]]) <= _ONE_STROKE * strokes[groups[-1][0]]:
            groups[-1].append(place)
        elif stroke:
            groups.append([place])
    kept = [group for group in groups if len(group) > 1]
    if not kept and (len(groups) == 1 or all(strokes)):
        kept = groups
    number = {place: n for n, group in enumerate(kept, start=1) for place in group}
    return tuple(replace(cycle, series=number.get(place, 0)) for place, cycle in enumerate(cycles))


def _reversed_stroke(away: Array, steps: Array, cycle: Cycle) -> float:
    """Return the stroke of a fully reversed cycle, from end to end [m]; 0 of any other."""
    first, last = int(np.ceil(cycle.start)), int(cycle.end)
    if last - first < 4:
        return 0.0
    up, down = float(away[first : last + 1].max()), -float(away[first : last + 1].min())
    way = float(steps[first:last].sum())
    even = abs(up - down) <= _UNEVEN * (up + down) and way <= (1.0 + _UNEVEN) * 2.0 * (up + down)
    return up + down if even else 0.0


def _between(values: Array, place: float) -> Array:
    below = min(int(np.floor(place)), len(values) - 2)
    share = place - below
    return (1.0 - share) * values[below] + share * values[below + 1]
