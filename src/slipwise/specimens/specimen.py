"""What one campaign says of its specimen, as products: enough for a law over several, and small enough for a file.

Sizes of effects are in limits of materiality, which differ between campaigns; what one limit is in the strengths of an
effect goes with each column, so that sizes of two campaigns can be compared in the strength's own unit.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.diagnosis.result import Diagnosis
from slipwise.errors import InputError
from slipwise.estimation.intervals import Interval, compute_intervals, compute_standard_error
from slipwise.evidence.posterior import make_normal_system
from slipwise.evidence.prior import OF_MODEL, list_trifles
from slipwise.relations.parameters import Term
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.initial_grid import strengths
from slipwise.selection.weighed_model import BaseNumber, WeighedModel
from slipwise.short_repr import short_repr

#: Where an effect is a law of the faces that slide.
_OF_THE_FACES = ("shear", "area", "stick")


@short_repr
@dataclass(frozen=True)
class SpecimenColumn:
    """One strength of a candidate at one form, as one campaign knows it.

    Attributes:
        label: of the candidate's term.
        effect: its name.
        gauge: whether it is a fault of gauges.
        faces: whether it is a law of the faces that slide, and no property of the rig.
        form: number of the form; `OF_MODEL` for an effect that the campaign's own model has.
        shape: values of its constants.
        step: strength -> by how much it changes in one limit [unit]; "" for the share of a law in another's place.
        units: of these strengths.
        absent: values of these strengths at which the effect is absent [unit].
        two_sided: whether the size may lie on either side of zero.
        numbers: how many were fitted beside its size.
        floors: what a fit of the base leaves of one limit in the relation that shows it best [noise].
        fitted: size in the campaign's own model [limits]; 0 for what it has not.
    """

    label: str
    effect: str
    gauge: bool
    faces: bool
    form: int
    shape: Mapping[str, float]
    step: Mapping[str, float]
    units: Mapping[str, str]
    absent: Mapping[str, float]
    two_sided: bool
    numbers: int
    floors: float
    fitted: float


@dataclass(frozen=True)
class SpecimenNumber:
    """A base number of one campaign.

    Attributes:
        key: "rig.mass", "shear_rate.rate" ...
        value: as it was fitted beside the effects of the campaign's own model [unit].
        error: standard error; NaN where the fit ended on a bound [unit].
        unit: SI unit.
        scale: one unit of its slope in the products [unit].
    """

    key: str
    value: float
    error: float
    unit: str
    scale: float


@short_repr
@dataclass(frozen=True)
class SpecimenStatistics:
    """One campaign of several.

    Attributes:
        name: of the campaign; no two of several are called alike.
        rig: its name.
        columns: (K,) of candidates.
        numbers: (b,) that are fitted whatever is missing; they stand before the columns in the products.
        whole: (b + K, b + K) precision that the data give.
        ridge: (b + K,) precision of what is known beside the data, trifles included.
        pull: (b + K,) of the data and of what is known.
        trifle: (K,) standard deviation of what is always there [limits].
        chance: label -> chance that it is more than a trifle, by this campaign alone.
        named: effects that its verdict names.
        apart: labels of terms that cannot be in one model, in both orders.
    """

    name: str
    rig: str
    columns: tuple[SpecimenColumn, ...]
    numbers: tuple[SpecimenNumber, ...]
    whole: Array
    ridge: Array
    pull: Array
    trifle: Array
    chance: Mapping[str, float]
    named: tuple[str, ...]
    apart: tuple[tuple[str, str], ...]


def make_specimen(found: Diagnosis, name: str = "") -> SpecimenStatistics:
    """Keep of a diagnosis what a law over several specimens needs.

    Args:
        found: the diagnosis.
        name: of the specimen; that of the campaign when not given.

    Raises:
        InputError: nothing was weighed in it.
    """
    weighed = found.search.weighed
    if weighed is None:
        raise InputError(f"{name or found.campaign}: no posterior was computed, so it cannot be joined with others")
    named = found.verdict.effects if found.verdict.kind in ("named", "instrument") else ()
    entries = compute_intervals(found.final).entries
    return condense(name or found.campaign, found.final.campaign.rig, weighed, found.search.terms, entries, named)


def condense(
    name: str, rig: str, weighed: WeighedModel, terms: Sequence[Term], entries: Sequence[Interval], named: Sequence[str]
) -> SpecimenStatistics:
    """Keep of a weighed model what a law over several specimens needs.

    Args:
        name: of the specimen.
        rig: name of its rig.
        weighed: of the campaign.
        terms: candidates.
        entries: base numbers with their intervals.
        named: effects that the verdict names.
    """
    of = {t.label: t for t in terms}
    trifle = list_trifles(weighed.columns)
    system = make_normal_system(weighed.statistics, weighed.tolerances, weighed.posterior.level, trifle)
    floors = np.sqrt(np.maximum(np.array([np.diag(x) for x in weighed.left_by_base]).max(axis=0), 0.0))
    own = weighed.own[weighed.statistics.base :]
    columns = tuple(
        _make_column(c, of.get(c.label), float(floor), float(size))
        for c, floor, size in zip(weighed.columns, floors, own, strict=True)
    )
    known = {e.key: e for e in entries}
    chance = np.mean(weighed.posterior.sizes > 0.0, axis=0).tolist()
    return SpecimenStatistics(
        name,
        rig,
        columns,
        tuple(_make_number(n, known.get(n.key)) for n in weighed.numbers),
        system.whole,
        np.diag(system.regular - system.whole).copy(),
        system.pull,
        trifle,
        dict(zip(weighed.posterior.labels, chance, strict=True)),
        tuple(named),
        tuple(sorted(weighed.apart)),
    )


def _make_number(of: BaseNumber, entry: Interval | None) -> SpecimenNumber:
    if entry is None:
        return SpecimenNumber(of.key, float(of.value), float("nan"), "", float(of.scale))
    error = float("nan") if entry.bound or entry.limit else compute_standard_error(entry.low, entry.high)
    return SpecimenNumber(of.key, float(of.value), float(error), entry.unit, float(of.scale))


def _make_column(c: CandidateColumn, term: Term | None, floors: float, fitted: float) -> SpecimenColumn:
    known = [] if term is None else strengths(term.effect)
    if c.strength:
        step = {c.strength: float(c.unit)}
    else:  # all strengths together, in shares of their fitted sizes; of a law in another's place nothing is zero
        step = {p.name: float(c.unit * (c.values[p.name] - (p.neutral or 0.0))) for p in known} or {"": float(c.unit)}
    units = {p.name: p.unit for p in known if p.name in step} or {"": "1"}
    absent = {p.name: float(p.neutral or 0.0) for p in known if p.name in step} or {"": 0.0}
    shape = {name: float(x) for name, x in c.values.items() if name not in {p.name for p in known}}
    faces = term is not None and term.effect.port in _OF_THE_FACES
    return SpecimenColumn(
        c.label, c.effect, c.gauge, faces, c.form, shape, step, units, absent, c.two_sided, c.numbers, floors, fitted
    )


def is_of_model(column: SpecimenColumn) -> bool:
    """Return whether a column is that of an effect of the campaign's own model."""
    return column.form == OF_MODEL
