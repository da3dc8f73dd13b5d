"""Columns that were read in another unit than they were written in, found by the balances before anything else.

A factor is told as a unit where it is one that units have, where the relations of the channel hold several times
better with it, and where no other channel put right lets all relations hold better.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.campaign import Campaign
from slipwise.channels import channel
from slipwise.preparation.channel_scale import (
    ChannelScale,
    System,
    divide_channels,
    estimate_channel_scale,
    find_system,
)
from slipwise.preparation.gauge_groups import group_gauges
from slipwise.record import Record
from slipwise.relations.balance_rows import PreparedRun, prepare_runs
from slipwise.relations.rigid_balances import Relation, list_rigid_balances
from slipwise.rig import Specimen
from slipwise.units import parse_unit

#: Units in which gauges are written, by SI unit, those that people use most first: decimal ones, and others.
_DECIMAL: dict[str, tuple[str, ...]] = {
    "N": ("kN", "N", "MN", "daN"), "m": ("mm", "m", "cm", "um"), "m/s^2": ("m/s^2", "cm/s^2", "mm/s^2"),
    "rad": ("rad", "mrad"),
}  # fmt: skip
_OTHER: dict[str, tuple[str, ...]] = {
    "N": ("kgf", "lbf", "kip", "tf"), "m": ("inch",), "m/s^2": ("g", "inch/s^2"), "rad": ("deg",),
}  # fmt: skip
#: Factors between units of any kind: g, pound and inch; powers of ten have names of their own.
_FACTORS = (9.80665, 4.448222, 25.4)
#: Largest power of ten that is looked for; how far a factor may be from that of units, and a sure one [1].
_LARGEST, _NEAR, _SURE = 9, 0.25, 0.03
#: Other cells of its kind that must be there to tell that one is idle or has another unit.
LIKE_IT = 2
#: A card of cells is off by more than any girder could weigh or push; one cell differs from its like by its factor,
#: within what pads differ by [1].
_OF_CARD, _ALIKE = 50.0, 1.8
#: One cell moves like the others of its kind, by this correlation, and by more than so many times more or less [1].
_TOGETHER, _UNLIKE = 0.9, 4.0
#: Relations must hold that many times better with the channel put right, on their geometric mean [1].
_BETTER = 3.0
#: A gauge may be off by less than this by its calibration alone: no sign of another unit, such as daN for kgf [1].
_OF_CALIBRATION = 1.3
#: Columns that are looked for, one after the other.
_MOST = 3


@dataclass(frozen=True)
class WrongUnit:
    """Channels that are a factor too large.

    Attributes:
        channels: one, or the cells of a card.
        factor: by which they are too large [1].
    """

    channels: tuple[str, ...]
    factor: float

    def words(self, place: str) -> str:
        """Say what is wrong, and which unit was probably read as which; `place` stands for the channels."""
        large, factor = ("large", self.factor) if self.factor > 1.0 else ("small", 1.0 / self.factor)
        power = round(np.log10(factor))
        size = f"10^{power}" if factor > 0.99e5 and _is_close(factor, 10.0**power) else f"{factor:,.4g}"
        return f"{place} is {size.replace(',', ' ')} times too {large} ({_guess(self.channels[0], self.factor)})"


def find_wrong_units(campaign: Campaign) -> list[WrongUnit]:
    """Return the channels and cards that were read in another unit, the clearest first; at most three.

    Args:
        campaign: in step, wrong signs turned back; of a rig whose slip is prescribed nothing is told.
    """
    if not campaign.specimen.free:
        return []
    runs, _ = prepare_runs(campaign)
    usable, _ = list_rigid_balances(runs[0].record, campaign.specimen)
    usable = [r for r in usable if r.accuses and r.rows in ("moving", "inner")]
    found: list[WrongUnit] = []
    for _ in range(_MOST if usable else 0):
        wrong = _clearest(runs, usable, campaign.specimen)
        if wrong is None:
            break
        found.append(wrong)
        runs = divide_channels(runs, wrong.channels, wrong.factor)
    return found


def convert_units(record: Record, factors: Mapping[str, float]) -> Record:
    """Return a record with channels divided by the factors by which they are too large, channel -> factor [1]."""
    return record.replaced(**{name: record[name] / factor for name, factor in factors.items() if name in record})


def _clearest(runs: list[PreparedRun], usable: Sequence[Relation], specimen: Specimen) -> WrongUnit | None:
    """Return the channel or card whose scaling lets all relations hold best, where its factor is one of units."""
    system = find_system(runs, usable, specimen)
    if not system.stacked.residual:
        return None
    untouched = estimate_channel_scale(system, (), mass_known=True)
    best: tuple[float, WrongUnit] | None = None
    for names in group_gauges(runs[0].record).values():
        found = estimate_channel_scale(system, names, mass_known=True)
        if not _helps(untouched, found):
            continue
        factor, left = _refined(system, names, found.factor)
        factor = _of_units(names[0], factor)
        # of two channels that mend one relation, the one that mends the others too
        if factor and _is_possible(factor, names, runs) and (best is None or left < best[0]):
            best = left, WrongUnit(names, factor)
    return _unlike_its_card(runs) if best is None else best[1]


def _unlike_its_card(runs: Sequence[PreparedRun]) -> WrongUnit | None:
    """Return the cell that moves like the others of its kind, but by a factor of units more or less.

    Where a balance fails for other reasons it cannot tell; pads that stand unevenly differ by less than such a factor.
    A pad between the ends of a girder that pitches moves ten times less too: but its cell shows the weight at rest as
    the others do, and a factor would be in that as well, unless the cell was tared.
    """
    for place, card in group_gauges(runs[0].record).items():
        if "*" not in place or len(card) <= LIKE_IT:
            continue
        values = {n: np.concatenate([r.record[n] - np.mean(r.record[n]) for r in runs]) for n in card}
        size = {n: float(np.std(v)) for n, v in values.items()}
        rest = {n: float(np.mean([abs(np.mean(r.record[n])) for r in runs])) for n in card}
        for name in card:
            others = [values[n] / size[n] for n in card if n != name and size[n] > 0.0]
            if size[name] == 0.0 or len(others) < LIKE_IT:
                continue
            ratio = size[name] / float(np.median([size[n] for n in card if n != name]))
            together = float(np.corrcoef(values[name], np.mean(others, axis=0))[0, 1])
            factor = _of_units(name, ratio, np.log(_ALIKE))
            weight = factor * float(np.median([rest[n] for n in card if n != name]))  # as it would show it
            if rest[name] > size[name] and abs(np.log(rest[name] / max(weight, 1e-300))) > np.log(_ALIKE):
                continue
            if together > _TOGETHER and factor and max(ratio, 1.0 / ratio) > _UNLIKE:
                return WrongUnit((name,), factor)
    return None


def _helps(untouched: ChannelScale, found: ChannelScale) -> bool:
    """Return whether a channel's own relations hold several times better with another scale of it."""
    gain = [np.log(untouched.left[name] / found.left[name]) for name in found.own]
    return found.factor > 0.0 and bool(gain) and float(np.mean(gain)) > np.log(_BETTER)


def _refined(system: System, names: Sequence[str], factor: float) -> tuple[float, float]:
    """Return a factor found on channels that were divided by it, with the mass free, and the log of what is left.

    The means, which tell most of a load, are taken in at the end unless they contradict the rest: a cell may be tared.
    """
    left = 0.0
    for centred in (True, True, False):
        again = estimate_channel_scale(system.divided(names, factor, centred=centred), names, mass_known=False)
        if again.factor <= 0.0 or (not centred and abs(np.log(again.factor)) > _NEAR):
            break
        factor *= again.factor
        left = sum(np.log(list(again.left.values()))) if centred else left
    return factor, float(left)


def _is_possible(factor: float, names: Sequence[str], runs: Sequence[PreparedRun]) -> bool:
    """Return whether a factor fits what the channels beside show: one cell differs by it from others of its kind."""
    if len(names) > 1:
        return min(factor, 1.0 / factor) < 1.0 / _OF_CARD
    kind = names[0].rpartition("_")[2]
    card = group_gauges(runs[0].record).get(f"pad_*_{kind}", ()) if names[0].startswith("pad_") else ()
    if len(card) < LIKE_IT + 1:
        return True
    moved = {name: float(np.median([np.std(run.record[name]) for run in runs])) for name in card}
    others = float(np.median([moved[name] for name in card if name != names[0]]))
    return abs(np.log(max(moved[names[0]], 1e-300) / max(others, 1e-300) / factor)) < np.log(_ALIKE)


def _of_units(name: str, factor: float, near: float = _NEAR) -> float:
    """Return the factor of units that is nearest to a fitted one; 0 where none is near, or it is 1.

    Where the fit is too rough to tell units apart, a power of ten is the likelier one.
    """
    units = [*(_ratio(name, *pair) for pair in _pairs(name)), *_powers(), *_FACTORS, *(1.0 / f for f in _FACTORS)]
    known = [f for f in units if max(f, 1.0 / f) > _OF_CALIBRATION]
    for factors, reach in ((known, _SURE), (_powers(), near), (known, near)):
        away = np.abs(np.log(np.array(factors) / factor))
        if away.min() < reach:
            return factors[int(np.argmin(away))]
    return 0.0


def _powers() -> list[float]:
    return [10.0**power for power in range(-_LARGEST, _LARGEST + 1) if power]


def _pairs(name: str) -> list[tuple[str, str]]:
    """Return pairs of units in which a column may have been written and read, the most usual first."""
    decimal, other = (units.get(channel(name).unit, ()) for units in (_DECIMAL, _OTHER))
    units = (*decimal, *other)
    pairs = [(a, b) for a in units for b in units if a != b and (a in decimal or b in decimal)]
    return sorted(pairs, key=lambda pair: units.index(pair[0]) + units.index(pair[1]))


def _ratio(name: str, written: str, read: str) -> float:
    """Return by how much a column is too large that was written in one unit and read in another [1]."""
    si = channel(name).unit
    return parse_unit(read, si, name) / parse_unit(written, si, name)


def _guess(name: str, factor: float) -> str:
    """Say which unit was probably read as which."""
    for written, read in _pairs(name):
        if _is_close(_ratio(name, written, read), factor):
            return f"{written} read as {read}?"
    return "is its decimal point right, and the unit of its calibration?"


def _is_close(one: float, other: float) -> bool:
    return abs(one / other - 1.0) < 1e-4
