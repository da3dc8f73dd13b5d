"""The chance to see an effect at its limit of materiality, to name it, and what it would be taken for."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.evidence.calibration import load_calibration
from slipwise.evidence.statistics import restrict
from slipwise.planning.planned_columns import Allowed, PlannedColumns, add_motions
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.planned_twins import decide_twins, draw_pulls, prepare_weighing, weigh
from slipwise.short_repr import short_repr

#: Campaigns that are drawn of each effect.
TWINS = 40
#: What an effect is taken for is listed where that happens in so many of the campaigns [1].
_LISTED = 0.1


@short_repr
@dataclass(frozen=True)
class Chance:
    """An effect that is there at its limit of materiality, beside trifles of everything.

    Attributes:
        effect: its name.
        place: gauges on which it sits; "" for an effect of the rig.
        parameter: its strength.
        value: of that at the limit [unit].
        unit: SI unit.
        possible: whether the parameter may be so large; if not, the effect does not matter in these motions.
        least: size from which it would be large enough to be named [limits]; `inclusion.SEEN` floors of a relation.
        seen: chance that an effect is said to be there, as one that matters or as one that does not [1].
        named: chance that it is named as one that matters [1].
        taken_for: other effects that are named in its place, and how often [1].
    """

    effect: str
    place: str
    parameter: str
    value: float
    unit: str
    possible: bool
    least: float
    seen: float
    named: float
    taken_for: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class RankedMotion:
    """A motion among those planned.

    Attributes:
        motion: its name.
        slip: largest slip of the base model [m].
        named: mean chance to name an effect of the rig by this motion alone [1].
        order: place in the sequence that names most as early as possible, from 1.
        together: the same chance after all motions up to this one [1].
    """

    motion: str
    slip: float
    named: float
    order: int
    together: float


def compute_chances(
    planned: PlannedColumns, motions: Sequence[int], allowed: Allowed, *, gauges: bool = True
) -> tuple[Chance, ...]:
    """Return the chances of every effect: first those of the rig, what is surest first.

    Args:
        planned: the products.
        motions: places of the motions that are made.
        allowed: what the gauges allow.
        gauges: whether faults of gauges are put in too.
    """
    products = add_motions([planned.by_motion[k] for k in motions])
    statistics = restrict(products, allowed.relations, allowed.columns)
    kept = [planned.columns[k] for k in allowed.columns]
    weighing = prepare_weighing(statistics, kept, planned.tolerances)
    of = {t.label: t for t in planned.terms}
    effects = {c.label: c.effect for c in kept}
    calibration, rng = load_calibration(), np.random.default_rng(0)
    out = []
    for place in _list_planted(kept, gauges=gauges):
        column = kept[place]
        evidence = weigh(weighing, draw_pulls(weighing, place, 1.0, TWINS, rng))
        said = decide_twins(weighing, evidence, effects, calibration)
        seen = sum(bool(name) for name in said.listed) / TWINS
        counts = Counter(name for name in said.named if name)
        named = counts.pop(column.effect, 0) / TWINS
        others = tuple((name, n / TWINS) for name, n in counts.most_common() if n / TWINS >= _LISTED)
        p = of[column.label].effect.parameter(column.strength)
        size = column.neutral + column.unit
        possible = p.low <= size <= p.high
        out.append(
            Chance(
                column.effect,
                of[column.label].group,
                p.name,
                size,
                p.unit,
                possible,
                float(weighing.least[place]),
                seen,
                named,
                others,
            )
        )
    return tuple(sorted(out, key=lambda c: (bool(c.place), -c.named, -c.seen, c.least, c.effect)))


def _list_planted(columns: Sequence[CandidateColumn], *, gauges: bool) -> list[int]:
    """Return the place of the first column of every term; of what may sit on one pad alone the one on all of them."""
    first: dict[str, int] = {}
    for place, column in enumerate(columns):
        if column.label == column.effect or (column.gauge and gauges):
            first.setdefault(column.label, place)
    return list(first.values())


def compute_mean_chance(chances: Sequence[Chance]) -> float:
    """Return the mean chance to name an effect of the rig that matters here [1]; 0 without any."""
    own = [c.named for c in chances if not c.place and c.possible]
    return float(np.mean(own)) if own else 0.0


def rank_motions(planned: PlannedColumns, slips: Sequence[float], allowed: Allowed) -> tuple[RankedMotion, ...]:
    """Return the motions in the sequence that names effects of the rig as early as possible.

    Each motion of the sequence is the one that, with all before it, names most on average; of equals the one from
    which smaller sizes are seen.

    Args:
        planned: the products.
        slips: largest slip of every motion [m].
        allowed: what the gauges allow.
    """

    def judge(motions: Sequence[int]) -> tuple[float, float]:
        chances = [c for c in compute_chances(planned, motions, allowed, gauges=False) if c.possible]
        seen = [np.log(c.least) for c in chances]
        return compute_mean_chance(chances), -float(np.mean(seen)) if seen else 0.0

    names = [run.name for run in planned.base.campaign.runs]
    alone = [judge([k]) for k in range(len(names))]
    out: list[RankedMotion] = []
    chosen: list[int] = []
    while len(chosen) < len(names):
        rest = [k for k in range(len(names)) if k not in chosen]
        scores = {k: judge([*chosen, k]) if chosen else alone[k] for k in rest}
        best = max(rest, key=lambda k: scores[k])
        chosen.append(best)
        out.append(RankedMotion(names[best], slips[best], alone[best][0], len(chosen), scores[best][0]))
    return tuple(out)
