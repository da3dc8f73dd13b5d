"""Gauges wired the wrong way round, found before anything else: with one of them no balance means anything."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from slipwise.instruments.joint_fit import Case, Fit, start
from slipwise.instruments.rows import with_records
from slipwise.instruments.suspects import Suspect, effect_of, groups_of

#: A relation is broken when it leaves more than this part of the scatter of what it is made of [1].
_BROKEN = 0.15
#: A turned gauge takes this much of what broken relations leave away [1].
_CURES = 0.7
#: More than this many are not looked for.
_MOST = 3


def turned_gauges(case: Case) -> tuple[list[Suspect], Case, Fit]:
    """Find gauges with the wrong sign; give them, the case with them turned, and its first fit."""
    found: list[Suspect] = []
    here = start(case)
    for _ in range(_MOST):
        broken = _broken(case, here)
        if not broken:
            break
        trials = []
        for place, channels in groups_of(case.runs[0].record).items():
            suspect = _sign(place, channels)
            turned = replace(case, runs=with_records(case.runs, lambda r, s=suspect: s.mend(r, -1.0)))
            after = start(turned)
            trials.append((_left(after, broken) / _left(here, broken), after.score, suspect, turned, after))
        share, _, suspect, turned, after = min(trials, key=lambda trial: trial[0])
        if share > (1.0 - _CURES) ** 2:
            break
        found.append(suspect)
        case, here = turned, after
    return found, case, here


def _sign(place: str, channels: tuple[str, ...]) -> Suspect:
    effect = effect_of("turned")
    sign = effect.parameters[0].name
    return Suspect(effect.name, place, place, channels, "1", -1.0, 0.0, lambda size: {sign: size})


def _broken(case: Case, here: Fit) -> list[str]:
    """Give the relations that do not hold at all."""
    broken = []
    for relation in case.relations:
        if relation.name not in here.left or relation.rows in ("quiet", "wander") or not relation.accuses:
            continue
        made_of = np.concatenate(
            [run.rows(relation.known(run.record, case.specimen), relation.rows) for run in case.runs]
        )
        if float(np.std(here.left[relation.name])) > _BROKEN * float(np.std(made_of)):
            if here.scale[relation.name] > 5.0 * here.floor[relation.name]:
                broken.append(relation.name)
    return broken


def _left(here: Fit, names: list[str]) -> float:
    squares: Mapping[str, float] = {n: float(np.mean(np.square(here.left[n] / here.floor[n]))) for n in names}
    return sum(squares.values())
