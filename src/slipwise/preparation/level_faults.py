"""Accelerations of a structure's levels held against each other: each answers the one below, whatever the forces are.

It is asked what leaves least of the inertia of all storeys unexplained (see `slipwise.campaign.level_order`): the
levels of a run as campaign.toml maps them, one of them turned round, one of them late, or all in another order. A level
that hardly moves beside the others is dead, and the others are held against each other without it.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign, Run
from slipwise.campaign.double_integrals import AGREE, find_sources
from slipwise.campaign.level_order import MOST_LEVELS, StoreyLink, find_order, judge_order, links_hold
from slipwise.campaign.level_spectra import LevelSpectra, level_spectra
from slipwise.preparation.synchronisation import find_strongest_lag, locate_vertex
from slipwise.rig import Specimen, storey_names

#: Fewer levels than these, the table's included, say nothing of each other.
FEWEST_LEVELS = 3
#: An explanation counts where it takes so much from the sum of what is left, a simpler one where it misses the best by
#: less than this [1]. On a real building as recorded no delay took more than 0.04, one of 10 ms 0.6.
_CLEAR, _NEARLY = 0.2, 0.1
#: A level that moves by less than this part of what the others do is dead [1].
_IDLE = 0.08
#: Delays that are tried without a hint [s], in steps of this part of the shortest period; longer ones where a level
#: resembles its neighbour most, up to the longest [s].
_SHORT, _STEP, _LONG = 0.1, 0.025, 6.0
#: Steps that are taken at once where a delay is looked for first.
_WIDE = 4
#: Runs agree on a delay within this share of it, and at least within so many steps of the tried ones [1].
_AGREED = 0.1
#: Faults of one run that are told at most.
_MOST = 3


@dataclass(frozen=True)
class LevelsOfRun:
    """What the accelerations of a run say of its levels, along one axis.

    Attributes:
        run: its name.
        levels: channels of the levels that move, as mapped, the lowest first.
        links: of each with the one below, once what is named here is put right.
        dead: channels of levels that do not move.
        turned: channels that stand turned round.
        late: channel -> by how much it is late [s].
        order: channels in the order that the motions show, the lowest first; as `levels` where that is right.
    """

    run: str
    levels: tuple[str, ...]
    links: tuple[StoreyLink, ...]
    dead: tuple[str, ...]
    turned: tuple[str, ...]
    late: Mapping[str, float]
    order: tuple[str, ...]

    @property
    def holds(self) -> bool:
        """Whether each level answers the one below."""
        return len(self.links) > 0 and links_hold(self.links)

    @property
    def contradicts(self) -> bool:
        """Whether the motions show other levels than those mapped, or one turned round or late."""
        return self.order != self.levels or bool(self.turned or self.late)


def read_levels(campaign: Campaign) -> list[LevelsOfRun]:
    """Return what each run says of the levels of its structure; nothing of runs with fewer than three.

    Args:
        campaign: a girder that is free, with storeys.
    """
    if not campaign.specimen.storeys:
        return []
    read = (_levels_of(run, campaign.specimen, axis) for run in campaign.runs for axis in "xy")
    return [levels for levels in read if levels is not None]


def agreed_turned(read: Sequence[LevelsOfRun]) -> tuple[str, ...]:
    """Return the channels that stand turned round in every run that has them."""
    return tuple(name for name in _names(levels.turned for levels in read) if _in_all(read, name, "turned"))


def agreed_late(read: Sequence[LevelsOfRun]) -> dict[str, float]:
    """Return the channels that are late by one delay in every run that has them [s]."""
    found = {}
    for name in _names(levels.late for levels in read):
        delays = [levels.late[name] for levels in read if name in levels.late]
        delay = float(np.median(delays))
        if _in_all(read, name, "late") and np.ptp(delays) < max(_AGREED * abs(delay), _SHORT * _AGREED):
            found[name] = delay
    return found


def dead_in(read: Sequence[LevelsOfRun]) -> dict[str, tuple[str, ...]]:
    """Return channel -> names of the runs in which it is dead."""
    return {
        name: tuple(dict.fromkeys(levels.run for levels in read if name in levels.dead))
        for name in _names(levels.dead for levels in read)
    }


def turned_displacements(campaign: Campaign) -> tuple[str, ...]:
    """Return the channels of floors' displacements that every run shows turned round.

    Args:
        campaign: whose accelerations have their signs.
    """
    found: dict[str, list[bool]] = {}
    for run, storey, axis in product(campaign.runs, storey_names(campaign.specimen.storeys), "xy"):
        name, levels = f"{storey}_d{axis}", [f"{storey}_a{axis}", f"table_a{axis}"]
        if run.record.has_all(name, *levels):
            sources = find_sources(run.record[name], np.stack([run.record[n] for n in levels]), run.record.dt)
            drift = next((s for s in sources if s.minus is not None and s.agreement > AGREE), None)
            found.setdefault(name, []).append(drift is not None and drift.scale < 0.0)
    return tuple(name for name, turned in found.items() if all(turned))


def _names(every: Iterable[Iterable[str]]) -> list[str]:
    return list(dict.fromkeys(name for names in every for name in names))


def _in_all(read: Sequence[LevelsOfRun], name: str, what: str) -> bool:
    """Return whether every run that can tell says so."""
    return all(name in getattr(levels, what) for levels in read if name in levels.levels and levels.holds)


def _levels_of(run: Run, specimen: Specimen, axis: str) -> LevelsOfRun | None:
    names = [f"{place}_a{axis}" for place in ("table", "girder", *storey_names(specimen.storeys))]
    masses = {f"girder_a{axis}": specimen.mass}
    masses |= {f"{n}_a{axis}": s.mass for n, s in zip(storey_names(specimen.storeys), specimen.storeys, strict=True)}
    there = [name for name in names if name in run.record and np.isfinite(run.record[name]).all()]
    if not FEWEST_LEVELS <= len(there) <= MOST_LEVELS:
        return None
    if not _shaken(run, there, axis):
        return None
    size = {name: float(np.std(run.record[name])) for name in there}
    dead = tuple(n for n in there if size[n] <= _IDLE * float(np.median([size[m] for m in there if m != n])))
    moving = [name for name in there if name not in dead]
    if len(moving) < FEWEST_LEVELS:
        return LevelsOfRun(run.name, (), (), dead, (), {}, ()) if dead and moving else None
    spectra = level_spectra(np.stack([run.record[name] for name in moving]), run.record.dt)
    if spectra is None:
        return None
    asked = _Asked(spectra, tuple(masses[name] for name in moving[1:]), [run.record[name] for name in moving])
    plain = _Asked(spectra, tuple(masses[name] for name in moving[1:]), [run.record[name] for name in moving])
    asked, turned, late = plain, list[str](), dict[str, float]()
    for _ in range(_MOST):
        found = _explain(asked)
        if found is None:
            break
        which, sign, delay = found
        asked = asked.put_right(which, sign, delay)
        if sign < 0:
            turned.append(moving[which])
        else:
            late[moving[which]] = delay
    if not links_hold(asked.links()):
        asked, turned, late = plain, [], {}
    order = _order(asked)
    if order != tuple(range(len(moving))):
        asked, turned, late = plain, [], {}  # they were held against the wrong levels
    links = judge_order(asked.spectra, order, asked.masses)
    return LevelsOfRun(run.name, tuple(moving), links, dead, tuple(turned), late, tuple(moving[i] for i in order))


def _shaken(run: Run, levels: Sequence[str], axis: str) -> bool:
    """Return whether a run was shaken along an axis: its table moves beside the levels, and they as along the other."""
    table, other = f"table_a{axis}", {"x": "y", "y": "x"}[axis]
    moved = float(np.median([np.std(run.record[name]) for name in levels]))
    if table in levels and float(np.std(run.record[table])) <= _IDLE * moved:
        return False
    beside = [f"{name[:-1]}{other}" for name in levels if f"{name[:-1]}{other}" in run.record]
    return not beside or moved > _IDLE * float(np.median([np.std(run.record[name]) for name in beside]))


@dataclass(frozen=True, eq=False)
class _Asked:
    """Levels as they are mapped: their spectra, masses of those above the lowest, and their signals."""

    spectra: LevelSpectra
    masses: tuple[float, ...]
    signals: Sequence[Array]

    def left(self, order: Sequence[int] | None = None) -> float:
        """Return what an order leaves, else that as mapped [1]."""
        return sum(link.left for link in self.links(order))

    def links(self, order: Sequence[int] | None = None) -> tuple[StoreyLink, ...]:
        return judge_order(self.spectra, order or range(len(self.signals)), self.masses)

    def put_right(self, which: int, sign: int, delay: float) -> "_Asked":
        """Return the levels with one of them turned round or brought forward."""
        signs = [sign if i == which else 1 for i in range(len(self.signals))]
        delays = [delay if i == which else 0.0 for i in range(len(self.signals))]
        return _Asked(self.spectra.signed(signs).brought_forward(delays), self.masses, self.signals)


def _explain(asked: _Asked) -> tuple[int, int, float] | None:
    """Return which level is turned round or late, its sign and its delay [s]; None where neither explains anything.

    A late table is not looked for: isolators answer it too slowly to show a delay, and the slip shows it.
    """
    count, plain = len(asked.signals), asked.left()
    tried = [(i, -1, 0.0) for i in range(count)] + [(i, 1, _delay_of(asked, i)) for i in range(1, count)]
    left = {what: asked.put_right(*what).left() for what in tried}
    least = min(left.values())
    if least > plain - _CLEAR:
        return None
    other = find_order(asked.spectra, turn=False)
    if other.holds and other.levels != tuple(range(count)) and asked.left(other.levels) < least - _NEARLY:
        return None
    return min((what for what in tried if left[what] < least + _NEARLY), key=lambda what: (what[1], left[what]))


def _delay_of(asked: _Asked, which: int) -> float:
    """Return the delay of a level that leaves least [s]: looked for in wide steps first, then beside the best."""
    step = _STEP / asked.spectra.highest
    dt, wide = asked.spectra.dt, _WIDE * step
    most = min(round(_LONG / dt), asked.spectra.samples // 2)
    beside = [i for i in (which - 1, which + 1) if 0 <= i < len(asked.signals)]
    hints = [dt * find_strongest_lag(asked.signals[which], asked.signals[i], most) for i in beside]
    tried = [wide * k for k in range(-round(_SHORT / wide), round(_SHORT / wide) + 1)]
    tried += [hint + wide * k for hint in hints if abs(hint) > _SHORT for k in (-1, 0, 1)]

    def left(delay: float) -> float:
        return asked.put_right(which, 1, delay).left()

    near = min(tried, key=left)
    best = min((near + step * k for k in range(-_WIDE, _WIDE + 1)), key=left)
    return best + step * locate_vertex(*(-left(best + step * k) for k in (-1, 0, 1)))


def _order(asked: _Asked) -> tuple[int, ...]:
    """Return the order of levels that the motions show; that as mapped unless another leaves clearly less."""
    mapped = tuple(range(len(asked.signals)))
    found = find_order(asked.spectra, turn=False)
    if found.levels != mapped and found.holds and asked.left(found.levels) < asked.left() - _CLEAR:
        return found.levels
    return mapped
