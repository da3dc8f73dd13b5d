"""What every candidate changes in the balances of a rigid girder: one column for each fault of a gauge in each form."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from slipwise.arrays import Array
from slipwise.instruments.balances_case import Case, Point, mended
from slipwise.instruments.delay_or_filter import is_delay
from slipwise.instruments.disturbances import Alternative
from slipwise.instruments.suspects import Suspect, suspects
from slipwise.record import Record
from slipwise.regression.normal_equations import Block, build_equations, invert_regularised, weigh_equations
from slipwise.relations.balance_rows import PreparedRun, Stack, adding, list_changed_rows, stack_rows, with_records

#: Forms of one disturbance that compete at once.
_FORMS = 3
#: Power of a channel over that of its noise from which on there is as much signal as noise in it [1].
_SIGNAL = 2.0
#: A lag that is taken out is held against itself at its size times these [1].
_NEIGHBOURS = (1.0, 1.2, 1.0 / 1.2)


@dataclass(frozen=True)
class FaultColumn:
    """One number of a candidate at one form.

    Attributes:
        label: of the candidate.
        effect: its name, or words.
        gauge: whether it is a fault of gauges.
        form: number of the form.
        two_sided: whether its size may have either sign.
        suspect: the fault; None of a disturbance.
        block: relation -> (n, 1) change of what is left by taking one unit out: the least size of a fault.
        noise: relation -> what the gauge's own noise adds to the product of the column with what is left.
        strength: name of what the column is the change by.
        numbers: fitted beside it.
    """

    label: str
    effect: str
    gauge: bool
    form: int
    two_sided: bool
    suspect: Suspect | None
    block: Block
    noise: Mapping[str, float]
    strength: str = "size"
    numbers: int = 0


@dataclass(frozen=True)
class BalancesAt:
    """Records and balances at a point.

    Attributes:
        case: what is judged.
        point: where.
        runs: without the faults of the point.
        stack: their balances.
    """

    case: Case
    point: Point
    runs: list[PreparedRun]
    stack: Stack

    def changed(self, runs: Sequence[PreparedRun], suspect: Suspect, before: Stack) -> dict[str, Array]:
        """Return the change of what is left, relation -> (n,), where the channels of a suspect were changed."""
        case, touched = self.case, frozenset(suspect.channels)
        return list_changed_rows(runs, case.relations, case.specimen, self.point.constants, before, touched)


def evaluate(case: Case, point: Point) -> BalancesAt:
    """Evaluate the balances without the faults of a point."""
    runs = mended(case.runs, point.sizes)
    return BalancesAt(case, point, runs, stack_rows(runs, case.relations, case.specimen, point.constants))


def label_of(suspect: Suspect) -> str:
    """Name a fault on its place, whatever its form; a filter is a form of the delay that it is where it is small."""
    return f"{_kind(suspect)} {suspect.target}" + (" other" if suspect.effect.gauges.reads else "")


def _kind(suspect: Suspect) -> str:
    return suspect.effect.plainer or suspect.effect.name


def columns_of_faults(
    at: BalancesAt, kept: Sequence[FaultColumn], anew: Mapping[str, Sequence[float]]
) -> list[FaultColumn]:
    """Return the columns of all faults, in units of their least size.

    The column of a fault that is taken out of the records is the whole change over its size: a large delay is no
    straight line from zero. The other forms of such a fault, and other effects that are a lag of the same gauge, are
    held against it at the same size.

    Args:
        at: where.
        kept: columns that were taken before.
        anew: labels whose columns are taken again -> sizes at which they are taken [least sizes].
    """
    case, point = at.case, at.point
    every = suspects(case.runs[0].record, case.specimen, case.effects)
    in_place = {label_of(s): (s, size) for s, size in point.sizes}
    lags = {s.channels: one for one in in_place.values() if (s := one[0]).unit == "s"}
    in_place = {label_of(s): lags[s.channels] for s in every if s.unit == "s" and s.channels in lags} | in_place
    bare = {
        suspect.key: evaluate(case, Point(point.constants, tuple(one for one in point.sizes if one[0] is not suspect)))
        for suspect, _ in point.sizes
    }
    known: dict[str, list[FaultColumn]] = {}
    for c in kept:
        if c.label not in anew and c.label not in in_place:
            known.setdefault(c.label, []).append(c)
    found = [c for own in known.values() for c in own]
    forms: dict[str, int] = {}
    for suspect in every:
        label = label_of(suspect)
        if label in known or (suspect.fault.scales and shows_only_noise(case, suspect.channels)):
            continue
        changes: list[tuple[dict[str, Array], dict[str, float]]] = []
        if label in in_place:
            for factor in _NEIGHBOURS if suspect.unit == "s" else (1.0,):
                size = factor * in_place[label][1]
                if (suspect.one_sided and size <= 0.0) or is_delay(suspect.effect, suspect.values(size), case.passed):
                    continue
                take = partial(suspect.correct, size=size)  # where all of it is out there is as much noise as before
                changes.append((_change_by(bare[in_place[label][0].key], suspect, take, suspect.least / size), {}))
        elif not suspect.effect.plainer:  # a small filter is a delay
            for size in anew.get(label, (suspect.step / suspect.least,)):
                take = partial(suspect.distort, size=size * suspect.least)
                change = _change_by(at, suspect, take, -1.0 / size)
                large = suspect.unit == "s" and label in anew
                changes.append((change, _noise_of_lag(at, suspect, take, -1.0 / size, change) if large else {}))
        blind = _list_blind_relations(case, suspect)
        for change, noise in changes:
            block = {n: rows[:, None] for n, rows in change.items() if n not in blind}
            if any(np.any(rows) for rows in block.values()):
                number = forms[label] = forms.get(label, -1) + 1
                noise = noise or _noise_with_itself(at, suspect)
                column = FaultColumn(label, _kind(suspect), True, number, not suspect.one_sided, suspect, block, noise)
                found.append(column)
    return found


def _change_by(at: BalancesAt, suspect: Suspect, take: Callable[[Record], Record], factor: float) -> dict[str, Array]:
    """Return what a change of the records changes in the balances times a factor, relation -> (n,)."""
    changed = at.changed(with_records(at.runs, take), suspect, at.stack)
    return {n: rows * factor for n, rows in changed.items()}


def _noise_of_lag(
    at: BalancesAt,
    suspect: Suspect,
    take: Callable[[Record], Record],
    factor: float,
    change: Mapping[str, Array],
) -> dict[str, float]:
    """Return what the gauge's own noise adds to the product of a large lag's column with what is left.

    Half way between noise and the same noise at another time there is less of it, and a large lag would explain that.

    Args:
        at: balances without the fault.
        suspect: the lag.
        take: changes a record by it, so far that noise comes to where it is other noise.
        factor: by which the change of the balances becomes the column.
        change: the column.
    """
    runs = adding(at.runs, at.case.noise, suspect.channels)
    noisy = replace(at, runs=runs, stack=stack_rows(runs, at.case.relations, at.case.specimen, at.point.constants))
    beside = _change_by(noisy, suspect, take, factor)
    return {n: -float((noisy.stack.residual[n] - at.stack.residual[n]) @ (beside[n] - change[n])) for n in change}


def shows_only_noise(case: Case, channels: Sequence[str]) -> bool:
    """Return whether channels show more noise than signal: of such a gauge nobody knows how much it reads of either."""

    def power(parts: Sequence[Mapping[str, Array]]) -> float:
        return sum(float(np.sum((one[n] - np.mean(one[n])) ** 2)) for one in parts for n in channels if n in one)

    return power([run.record.channels for run in case.runs]) < _SIGNAL * power(case.noise)


def _list_blind_relations(case: Case, suspect: Suspect) -> set[str]:
    """Return the relations that say nothing of a fault: one factor of all its channels only shrinks what is left."""
    own = set(suspect.channels)
    return {r.name for r in case.relations if own.issuperset(r.needs)} if suspect.fault.scales else set()


def _noise_with_itself(at: BalancesAt, suspect: Suspect) -> dict[str, float]:
    """Return the product of a gain's signature with the residual that comes from the channel's own noise alone.

    The signature of a gain is the channel with its noise, so a gain would "explain" noise by shrinking it. What a
    delay or an offset makes of noise has nothing to do with the noise itself.
    """
    if not suspect.fault.scales:
        return {}
    change = at.changed(adding(at.runs, at.case.noise, suspect.channels), suspect, at.stack)
    return {name: suspect.least * float(rows @ rows) for name, rows in change.items()}


def in_question(
    physics: Sequence[Alternative], stack: Stack, left: Mapping[str, Array], floor: Mapping[str, float]
) -> list[Alternative]:
    """Return the disturbances, of one with many forms (a bending girder's frequencies) those that explain most."""
    of: dict[tuple[str, frozenset[str]], list[Alternative]] = {}
    for a in physics:
        of.setdefault((a.name, frozenset(a.columns)), []).append(a)
    kept: list[Alternative] = []
    for forms in of.values():
        if len(forms) > _FORMS:
            base = list(stack.base.values())
            parts, first = build_equations([*base, *(a.columns for a in forms)], {n: left[n] for n in forms[0].columns})
            whole, pull = weigh_equations(parts, {n: 1.0 / floor[n] for n in parts}, int(first[-1]))
            known = int(first[len(base)])
            free = invert_regularised(whole[:known, :known]) @ np.column_stack([whole[:known], pull[:known]])
            gains = []
            for k in range(len(forms)):
                own = slice(int(first[len(base) + k]), int(first[len(base) + k + 1]))
                y = pull[own] - whole[own, :known] @ free[:, -1]
                gains.append(float(y @ invert_regularised(whole[own, own] - whole[own, :known] @ free[:, own]) @ y))
            forms = [forms[k] for k in np.argsort(gains)[-_FORMS:]]
        kept += forms
    return kept


def columns_of_physics(physics: Sequence[Alternative], left: Mapping[str, Array]) -> Iterator[FaultColumn]:
    """Yield the columns of disturbances, in their own units."""
    forms: dict[str, int] = {}
    for a in physics:
        label = f"{a.name} in {', '.join(sorted(a.columns))}"
        number = forms[label] = forms.get(label, -1) + 1
        for k in range(a.width):
            block = {n: c[:, k : k + 1] for n, c in a.columns.items() if n in left}
            if any(np.any(b) for b in block.values()):
                yield FaultColumn(label, a.name, False, number, True, None, block, {})
