"""Columns that several campaigns share: one size of an effect, in its own strengths, and what it is in each of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.short_repr import short_repr
from slipwise.specimens.specimen import SpecimenColumn, SpecimenStatistics, is_of_model

#: Unit of a strength that means the same on any rig: a share, a ratio, a coefficient of friction.
_PURE = "1"
#: Figures to which two shapes are the same.
_FIGURES = 3


@short_repr
@dataclass(frozen=True)
class SharedColumns:
    """Effects that several campaigns can be asked for together.

    Attributes:
        columns: (S,) in limits that are the mean of those of the campaigns.
        parts: for each campaign (K, S): how much of each of its own columns one limit of a shared one is.
        not_compared: effects whose sizes mean something on their own rig only, with the units of their strengths.
    """

    columns: tuple[SpecimenColumn, ...]
    parts: tuple[Array, ...]
    not_compared: Mapping[str, tuple[str, ...]]


def list_shared_columns(specimens: Sequence[SpecimenStatistics]) -> SharedColumns:
    """Match the columns of campaigns by effect, shape and strength.

    Campaigns of one rig share every effect but faults of gauges and what sits on one pad. Those of different rigs share
    the laws of the faces that slide whose strengths are pure numbers: a force, a length or a stiffness belongs to the
    rig on which it was measured.

    Args:
        specimens: at least two.
    """
    alike = len({s.rig for s in specimens}) == 1
    not_compared: dict[str, tuple[str, ...]] = {}
    by_effect: dict[str, list[SpecimenColumn]] = {}
    for c in (c for s in specimens for c in s.columns):
        if c.gauge or c.label != c.effect:
            continue
        if not alike and not (c.faces and set(c.units.values()) <= {_PURE}):
            not_compared.setdefault(c.effect, tuple(sorted(set(c.units.values()))))
            continue
        by_effect.setdefault(c.effect, []).append(c)
    for effect in not_compared:  # one strength that belongs to a rig takes the others with it
        by_effect.pop(effect, None)
    columns: list[SpecimenColumn] = []
    parts: list[list[Array]] = [[] for _ in specimens]
    for every in by_effect.values():
        for asked in _distinct(every):
            found = [match_column(s.columns, asked) for s in specimens]
            sizes = [float(np.linalg.norm(x)) for x in found]
            told = [x for x in sizes if x > 0.0]
            if len(told) < 2:
                continue
            factor = float(np.exp(-np.mean(np.log(told))))
            columns.append(replace(asked, step={name: x * factor for name, x in asked.step.items()}))
            for out, x in zip(parts, found, strict=True):
                out.append(x * factor)
    stacked = tuple(
        np.stack(x, axis=1) if x else np.zeros((len(s.columns), 0)) for x, s in zip(parts, specimens, strict=True)
    )
    return SharedColumns(_renumbered(columns), stacked, not_compared)


def _distinct(columns: Sequence[SpecimenColumn]) -> list[SpecimenColumn]:
    """Return one column of each form and strength; only those of models, where a model has the effect."""
    fitted = [c for c in columns if is_of_model(c)]
    out: dict[tuple, SpecimenColumn] = {}
    for c in fitted or columns:
        shape = tuple((name, float(f"{x:.{_FIGURES}g}")) for name, x in sorted(c.shape.items()))
        out.setdefault((c.form, shape, tuple(sorted(c.step))), c)
    return list(out.values())


def _renumbered(columns: Sequence[SpecimenColumn]) -> tuple[SpecimenColumn, ...]:
    """Return the columns, each form of an effect with a number of its own: two campaigns may have used one for two."""
    numbers: dict[tuple, int] = {}
    out = []
    for c in columns:
        key = (c.label, c.form, *sorted(c.shape.items()))
        numbers.setdefault(key, sum(label == c.label for label, *_ in numbers))
        out.append(replace(c, form=numbers[key]))
    return tuple(out)


def match_column(columns: Sequence[SpecimenColumn], asked: SpecimenColumn) -> Array:
    """Return how much of each column of a campaign (K,) one limit of another campaign's column is [limits].

    It is told by the form whose shape is nearest; zeros where the campaign does not know the effect.

    Args:
        columns: of the campaign.
        asked: the column of the other.
    """
    out = np.zeros(len(columns))
    own = [k for k, c in enumerate(columns) if c.label == asked.label]
    if not own:
        return out
    nearest = min((columns[k] for k in own), key=lambda c: (_distance(c.shape, asked.shape), c.form != asked.form))
    at = [k for k in own if columns[k].form == nearest.form]
    names = sorted({name for k in at for name in columns[k].step} | set(asked.step))
    largest = [max([abs(asked.step.get(n, 0.0)), *(abs(columns[k].step.get(n, 0.0)) for k in at)]) for n in names]
    scale = 1.0 / np.maximum(largest, 1e-300)
    steps = np.array([[columns[k].step.get(n, 0.0) for k in at] for n in names]) * scale[:, None]
    wanted = np.array([asked.step.get(n, 0.0) for n in names]) * scale
    out[at] = np.linalg.lstsq(steps, wanted, rcond=None)[0]
    return out


def _distance(one: Mapping[str, float], other: Mapping[str, float]) -> float:
    """Return how far two shapes are apart, in squares of relative differences [1]."""
    pairs = [(one[name], other[name]) for name in one.keys() & other.keys()]
    return sum(((a - b) / max(abs(a) + abs(b), 1e-300)) ** 2 for a, b in pairs)
