"""How large each effect that was not named can be at most.

One effect after the other is given room to be as large as what matters usually is, while everything else stays as the
posterior has it, small imperfections of all others included: the upper end of its size is then what the campaign says
of it, and not that small imperfections are usually small. Where that is no less than the room, the campaign says
nothing. The replays that gave columns their units tell what a size moves, so that a limit can be read as slip, energy
and load.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.evidence.posterior import make_normal_system
from slipwise.evidence.prior import Prior, list_trifles
from slipwise.relations.parameters import Term
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.initial_grid import strengths
from slipwise.selection.weighed_model import WeighedModel
from slipwise.short_repr import short_repr

#: Chance that a size lies below its limit [1].
CHANCE = 0.95
#: A campaign that leaves more than this share of the room that an effect is given says nothing of it [1].
_SAYS_NOTHING = 0.8


@short_repr
@dataclass(frozen=True)
class UpperLimit:
    """The largest size that an effect can have.

    Attributes:
        effect: its name.
        label: of the term that may be largest: that of a gauge's fault ends with its channel.
        size: at most so large [limits of materiality].
        parameter: the strength in which `value` is given.
        value: how far that lies from the effect's absence at most [unit].
        unit: of that strength.
        responses: name of `RESPONSES` -> change at that size, with its sign [m, J, N]; empty for gauges.
        measured: whether the campaign says anything of it.
    """

    effect: str
    label: str
    size: float
    parameter: str
    value: float
    unit: str
    responses: Mapping[str, float]
    measured: bool

    @property
    def may_matter(self) -> bool:
        """Whether it can be there at a size that matters."""
        return self.size >= 1.0 or not self.measured

    def as_json(self) -> dict[str, Any]:
        """Return the effect's entry of diagnosis.json; no numbers where the campaign says nothing of it."""
        numbers = {"size": self.size, "value": self.value, **self.responses}
        told = {k: self.measured and np.isfinite(x) for k, x in numbers.items()}
        written = {k: float(f"{x:.3g}") if told[k] else None for k, x in numbers.items()}
        return {**written, "parameter": self.parameter, "unit": self.unit, "of": self.label, "measured": self.measured}


@dataclass(frozen=True)
class _Background:
    """Everything as the posterior has it: sizes drawn of what is large, trifles given those."""

    large: Array
    mean: Array
    covariance: Array
    trifles: Array


def compute_upper_limits(
    weighed: WeighedModel, terms: Sequence[Term], named: Iterable[str] = ()
) -> dict[str, UpperLimit]:
    """Return effect -> how large it can be at most, of what was not named, the largest first.

    Args:
        weighed: of the campaign.
        terms: candidates.
        named: effects of which no limit is asked.
    """
    left_out, of = set(named), {t.label: t for t in terms}
    background = _make_background(weighed)
    rng = np.random.default_rng(0)
    best: dict[str, UpperLimit] = {}
    for label in dict.fromkeys(c.label for c in weighed.columns):
        places = np.array([i for i, c in enumerate(weighed.columns) if c.label == label])
        effect = weighed.columns[places[0]].effect
        if effect in left_out or label not in of:
            continue
        drawn = _draw_with_room(weighed, background, places, rng)
        found = _limit_of(weighed, of[label], places, drawn)
        if effect not in best or found.size > best[effect].size:
            best[effect] = found
    return {found.effect: found for found in sorted(best.values(), key=lambda x: -x.size)}


def _make_background(weighed: WeighedModel) -> _Background:
    large, base, trifles = weighed.posterior.strengths, weighed.statistics.base, list_trifles(weighed.columns)
    system = make_normal_system(weighed.statistics, weighed.tolerances, weighed.posterior.level, trifles)
    covariance = np.linalg.inv(system.regular).astype(np.float64)
    mean = (covariance @ system.pull)[base:] - large @ (covariance @ system.whole[:, base:])[base:].T
    return _Background(large, mean, covariance[base:, base:], trifles)


def _draw_with_room(
    weighed: WeighedModel, of: _Background, places: NDArray[np.int64], rng: np.random.Generator
) -> Array:
    """Draw the sizes (n, k) of one candidate's columns, which may be as large as what matters usually is [limits]."""
    forms = len({weighed.columns[i].form for i in places})
    room = Prior().large[0] / np.sqrt(forms)
    own = of.covariance[np.ix_(places, places)]
    known = np.linalg.inv(0.5 * (own + own.T))
    curvature = known - np.diag(of.trifles[places] ** -2.0) + room**-2.0 * np.eye(len(places))
    values, axes = np.linalg.eigh(0.5 * (curvature + curvature.T))
    values = np.maximum(values, room**-2.0)  # what the data say of nothing is round-off
    middle = (axes / values) @ (axes.T @ (known @ of.mean[:, places].T))
    spread = rng.standard_normal((len(of.mean), len(places))) @ (axes / np.sqrt(values)).T
    return of.large[:, places] + middle.T + spread


def _limit_of(weighed: WeighedModel, term: Term, places: NDArray[np.int64], drawn: Array) -> UpperLimit:
    own: dict[str, list[int]] = {}
    for k, place in enumerate(places):
        own.setdefault(weighed.columns[place].strength, []).append(k)
    amounts = {name: _amount([weighed.columns[places[k]] for k in at], drawn[:, at]) for name, at in own.items()}
    size = float(np.quantile(np.sqrt(sum(a**2 for a in amounts.values())), CHANCE))
    ends = {name: float(np.quantile(np.abs(a), CHANCE)) for name, a in amounts.items()}
    name = max(ends, key=lambda n: ends[n])
    spread = float(np.std(amounts[name]))
    column = weighed.columns[places[own[name][0]]]
    # of a law that takes another's place nothing is zero where it is absent
    of = [term.effect.parameter(name)] if name else strengths(term.effect)[:1]
    unit = column.unit if name else column.unit * sum(column.values[p.name] - float(p.neutral or 0.0) for p in of)
    known = (weighed.units.get((term.label, n)) for n in (*(p.name for p in of), ""))
    moved = next((m for m in known if m is not None and m.share > 0.0), None)
    return UpperLimit(
        effect=term.effect.name,
        label=term.label,
        size=size,
        parameter="".join(p.name for p in of),
        value=abs(unit) * ends[name] if of else float("nan"),
        unit="".join(p.unit for p in of),
        responses={} if moved is None else {r: x * ends[name] / moved.share for r, x in moved.responses.items()},
        measured=spread < _SAYS_NOTHING * Prior().large[0],
    )


def _amount(columns: Sequence[CandidateColumn], drawn: Array) -> Array:
    """Return how much there is of one strength (n,), its forms together, which may look either way [limits]."""
    whole = drawn @ np.sign([c.unit for c in columns])
    return whole if columns[0].two_sided or not columns[0].strength else np.maximum(whole, 0.0)
