"""What is believed of all candidates before a campaign is looked at, and how their columns belong together."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.short_repr import short_repr

Ints = NDArray[np.int64]
#: Number of the form of an effect that is in the model: its constants are those of the fit.
OF_MODEL = -2


class Competing(Protocol):
    """What a posterior asks of a column: a strength of an effect of the model, or the size of a fault of a gauge."""

    @property
    def label(self) -> str:
        """Of the candidate's term."""
        ...

    @property
    def effect(self) -> str:
        """Its name."""
        ...

    @property
    def gauge(self) -> bool:
        """Whether it is a fault of gauges."""
        ...

    @property
    def form(self) -> int:
        """Number of the form."""
        ...

    @property
    def strength(self) -> str:
        """Its name; "" for all strengths of an effect of the model together."""
        ...

    @property
    def two_sided(self) -> bool:
        """Whether it may lie on either side of what is neutral."""
        ...

    @property
    def numbers(self) -> int:
        """How many were fitted beside it."""
        ...


@dataclass(frozen=True)
class Prior:
    """What is believed before a campaign is looked at.

    Attributes:
        trifle: standard deviation of what is always there [limits of materiality].
        trifle_of_gauges: the same of faults of gauges.
        large: standard deviations of what matters.
        widths: prior of each of these.
        chance: that an effect matters, shared among its terms.
        independent: samples as which a relation counts at most.
        floor: least variance of what is left of a relation [noise variance].
        places: how many effects may matter at once.
    """

    trifle: float = 0.15
    trifle_of_gauges: float = 0.3
    large: tuple[float, ...] = (2.5, 10.0, 50.0)
    widths: tuple[float, ...] = (0.55, 0.33, 0.12)
    chance: float = 0.04
    independent: float = 100.0
    floor: float = 0.3
    places: int = 12

    @property
    def cost_of_effect(self) -> float:
        """By how much an effect must be likelier than its absence to matter [nats]."""
        return float(-np.log(self.chance))

    def get_trifle(self, *, gauge: bool) -> float:
        """Return the standard deviation of what is always there [limits]."""
        return self.trifle_of_gauges if gauge else self.trifle

    def compute_coarsening(self, rows: Array) -> Array:
        """Return by how many rows one independent sample stands, of relations that have so many rows each (r,)."""
        return np.maximum(1.0, rows / self.independent)


@short_repr
@dataclass(frozen=True)
class ColumnGroups:
    """Columns by form, forms by term.

    Attributes:
        labels: (T,) of the terms.
        effects: (T,) names of their effects.
        gauge: (T,) whether they are faults of gauges.
        owner: (F,) term of each form.
        number: (F,) of each form among its term's.
        columns: (F, w) places of its columns.
        length: (F,) how many of them count.
    """

    labels: tuple[str, ...]
    effects: tuple[str, ...]
    gauge: NDArray[np.bool_]
    owner: Ints
    number: Ints
    columns: Ints
    length: Ints


def group_columns(columns: Sequence[Competing]) -> ColumnGroups:
    """Return which columns make which form of which term."""
    labels = list(dict.fromkeys(c.label for c in columns))
    forms: dict[tuple[str, int], list[int]] = {}
    for i, c in enumerate(columns):
        forms.setdefault((c.label, c.form), []).append(i)
    width = max((len(v) for v in forms.values()), default=1)
    table = np.zeros((len(forms), width), np.int64)
    for row, members in enumerate(forms.values()):
        table[row, : len(members)] = members
    of = {c.label: c for c in columns}
    return ColumnGroups(
        tuple(labels),
        tuple(of[label].effect for label in labels),
        np.array([of[label].gauge for label in labels], bool),
        np.array([labels.index(label) for label, _ in forms], np.int64),
        np.array([form for _, form in forms], np.int64),
        table,
        np.array([len(v) for v in forms.values()], np.int64),
    )


def compute_log_odds(forms: ColumnGroups, columns: Sequence[Competing]) -> Array:
    """Return the logarithm of the prior of each form at one place against none (F,)."""
    prior, effects = Prior(), forms.effects
    shared = {e: effects.count(e) for e in effects}
    per_form = np.bincount(forms.owner, minlength=len(forms.labels))
    whole = np.array([not columns[of].strength for of in forms.columns[:, 0]], bool)
    among = np.where(whole, 1, per_form[forms.owner])  # a whole fit is at its best form, and pays for its numbers
    odds = np.log([prior.chance / shared[effects[t]] / prior.places for t in forms.owner]) - np.log(among)
    # numbers that were fitted with a form cost what they do in any choice of a model (Schwarz 1978, Ann. Stat. 6)
    numbers = np.array([columns[of].numbers for of in forms.columns[:, 0]])
    return odds - 0.5 * numbers * np.log(prior.independent)


def list_trifles(columns: Sequence[Competing]) -> Array:
    """Return the standard deviation (K,) of what is always there of every column: a term's forms share it [limits]."""
    prior = Prior()
    forms: dict[str, set[int]] = {}
    for c in columns:
        forms.setdefault(c.label, set()).add(c.form)
    return np.array([prior.get_trifle(gauge=c.gauge) / len(forms[c.label]) ** 0.5 for c in columns])
