"""What a plan says, as data, as a table for pandas, and as plan.json."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.display import Drawn, Tabular
from slipwise.planning.chances import Chance, RankedMotion
from slipwise.planning.gauge_kits import Remedy
from slipwise.planning.structure import Structure
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class GaugeSet:
    """A set of gauges, and what it shows.

    Attributes:
        words: what it is beside the planned one.
        structure: what it shows whatever the motion.
        chances: of every effect at its limit of materiality in the planned motions; empty without.
        unsized: why there are no chances; "" where there are.
    """

    words: str
    structure: Structure
    chances: tuple[Chance, ...] = ()
    unsized: str = ""

    @property
    def channels(self) -> tuple[str, ...]:
        """Channels of the gauges."""
        return self.structure.channels

    @property
    def of_rig(self) -> tuple[Chance, ...]:
        """Chances of effects of the rig; the others are of faults of gauges."""
        return tuple(c for c in self.chances if not c.place)

    def chance_of(self, effect: str) -> Chance | None:
        """Return the chance of an effect of the rig; None where it was not put in."""
        return next((c for c in self.of_rig if c.effect == effect), None)


@dataclass(frozen=True, repr=False)
class PlannedTest(Drawn, Tabular):
    """A planned test.

    Attributes:
        rig: its name.
        sets: gauges: the planned ones first, then with what would separate more, then the best and the cheapest set.
        unused: planned channels that no balance of the rig uses.
        remedies: what would show and separate what the planned gauges do not.
        motions: in the sequence that names most as early as possible; none where none was planned or replayed.
        failed: motion -> why it could not be replayed.
        hardly: motions in which the specimen hardly slides.
        untestable: effect -> why neither this rig nor these motions can show it.
        budget: of channels; None where none was given.
        notes: what a reader must know of the plan, in sentences.
        seconds: that it took [s].
    """

    rig: str
    sets: tuple[GaugeSet, ...]
    unused: tuple[str, ...]
    remedies: tuple[Remedy, ...]
    motions: tuple[RankedMotion, ...]
    failed: Mapping[str, str]
    hardly: tuple[str, ...]
    untestable: Mapping[str, str]
    budget: int | None
    notes: tuple[str, ...]
    seconds: float

    @property
    def planned(self) -> GaugeSet:
        """The planned gauges."""
        return self.sets[0]

    @property
    def sentence(self) -> str:
        """What the plan comes to."""
        structure = self.planned.structure
        told, seen, _ = structure.score
        every = sum(len(f.effects) for f in structure.faults if not f.channels)
        count = len(structure.channels)
        counted = f"{count} channel{'' if count == 1 else 's'}"
        words = (
            f"With {counted} {seen} of {every} effects of {self.rig} can be seen, and {told} of "
            "them told from whatever else may be wrong"
        )
        asked = [c for c in self.planned.of_rig if c.possible]
        if not asked:
            return f"{words}."
        likely = sum(c.named >= 0.5 for c in asked)
        return (
            f"{words}. At the limit of materiality {likely} of {len(asked)} would be named by "
            f"{_motions(len(self.motions))} in more than half of campaigns like this one."
        )

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Return a row for each effect, or fault of a gauge, with each set of gauges."""
        out = []
        for one in self.sets:
            for c in one.chances:
                about = {"gauges": one.words, "channels": len(one.channels), "effect": c.effect, "place": c.place}
                sizes = {"parameter": c.parameter, "value": c.value, "unit": c.unit, "named_from": _named_from(c)}
                out.append({**about, **sizes, "seen": c.seen, "named": c.named})
        return out

    def as_json(self) -> dict[str, Any]:
        """Return what plan.json holds."""
        return {
            "schema": 1,
            "rig": self.rig,
            "sentence": self.sentence,
            "budget": self.budget,
            "unused": list(self.unused),
            "sets": [_set(one) for one in self.sets],
            "remedies": [
                {
                    "first": r.first,
                    "second": r.second or None,
                    "add": [kit.words for kit in r.kits],
                    "channels": list(r.channels),
                }
                for r in self.remedies
            ],
            "motions": [dict(vars(one)) for one in self.motions],
            "failed": dict(self.failed),
            "hardly_slides": list(self.hardly),
            "untestable": dict(self.untestable),
            "notes": list(self.notes),
            "seconds": self.seconds,
        }

    def _headline(self) -> str:
        return self.sentence

    def _rows(self) -> list[dict[str, Any]]:
        return self.rows


def _motions(count: int) -> str:
    return "this motion" if count == 1 else f"these {count} motions"


def _named_from(chance: Chance) -> float | None:
    """Return the size from which an effect is named [limits]; None where its parameter cannot be so large."""
    return chance.least if np.isfinite(chance.least) and chance.least < 1e6 else None


def _set(one: GaugeSet) -> dict[str, Any]:
    structure = one.structure
    return {
        "words": one.words,
        "channels": list(one.channels),
        "faults": [
            {
                "kind": kind,
                "effects": list(structure.faults[of[0]].effects),
                "gauge": bool(structure.faults[of[0]].channels),
                "seen": kind not in structure.unseen,
            }
            for kind, of in structure.kinds.items()
        ],
        "confused": [list(pair) for pair in structure.confused],
        "chances": [
            {**{k: v for k, v in vars(c).items() if k not in ("taken_for", "least", "place")}}
            | {"place": c.place or None, "named_from": _named_from(c), "taken_for": dict(c.taken_for)}
            for c in one.chances
        ],
        "unsized": one.unsized,
    }
