"""What several specimens say together, as data, in sentences, as a table and as specimens.json."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.display import Tabular
from slipwise.short_repr import short_repr
from slipwise.specimens.random_effects import RandomEffects

#: Number of the format of specimens.json.
SCHEMA = 1
#: What an effect is to several specimens.
SHARED, OWN = "all", "one"


@short_repr
@dataclass(frozen=True)
class NumberOverSpecimens:
    """A number of the law, by specimen and over all.

    Attributes:
        key: "shear_rate.strength", "breakaway.rise" ...
        unit: SI unit.
        values: specimen -> value under the shared law [unit].
        errors: specimen -> standard error [unit].
        over: mean and spread; None where fewer than two specimens tell it.
    """

    key: str
    unit: str
    values: Mapping[str, float]
    errors: Mapping[str, float]
    over: RandomEffects | None

    def as_json(self) -> dict[str, Any]:
        """Return the number's entry of specimens.json."""
        out: dict[str, Any] = {
            "key": self.key,
            "unit": self.unit,
            "specimens": {
                name: {"value": _number(value), "error": _number(self.errors[name])}
                for name, value in self.values.items()
            },
        }
        if self.over is not None:
            o = self.over
            out |= {"mean": _number(o.mean), "low": _number(o.low), "high": _number(o.high)}
            out |= {k: _number(x) for k, x in (("spread", o.spread), ("spread_low", o.spread_low))}
            out |= {"spread_high": _number(o.spread_high), "differ": _number(o.differ)}
        return out


@short_repr
@dataclass(frozen=True)
class JointEffect:
    """An effect that is in all specimens, or in one alone.

    Attributes:
        effect: its name.
        of: `SHARED`, or `OWN` for a property of one specimen.
        specimen: that one; "" for an effect of all.
        probability: that it is there so [1].
        size: mean where it is there [limits of materiality].
        floors: what a fit of the base leaves of it in a campaign, root mean square of those that show it [noise].
        faint: whether that is so little that a small error which every campaign repeats could be all of it.
        alone: specimen -> chance that it is there, by its campaign alone; 0 where that does not know it.
        named: specimens whose own verdict names it.
        sizes: of its strengths.
    """

    effect: str
    of: str
    specimen: str
    probability: float
    size: float
    floors: float
    faint: bool
    alone: Mapping[str, float]
    named: tuple[str, ...]
    sizes: tuple[NumberOverSpecimens, ...]

    def as_json(self) -> dict[str, Any]:
        """Return the effect's entry of specimens.json."""
        return {
            "effect": self.effect,
            "of": self.of,
            "specimen": self.specimen,
            "probability": round(self.probability, 3),
            "size": _number(self.size),
            "floors": _number(self.floors),
            "faint": self.faint,
            "alone": {name: round(x, 3) for name, x in self.alone.items()},
            "named": list(self.named),
            "sizes": [one.as_json() for one in self.sizes],
        }


@dataclass(frozen=True, repr=False)
class SpecimensReport(Tabular):
    """One law over several specimens.

    Attributes:
        names: of the specimens.
        rigs: of each.
        effects: what is there, those of all first, the likeliest first.
        numbers: of the base model, under that law.
        not_compared: effects whose sizes mean something on their own rig only -> units of their strengths.
    """

    names: tuple[str, ...]
    rigs: tuple[str, ...]
    effects: tuple[JointEffect, ...]
    numbers: tuple[NumberOverSpecimens, ...]
    not_compared: Mapping[str, tuple[str, ...]]

    @property
    def sentence(self) -> str:
        """What all specimens have, what one has alone, and what is seen alike in all but faintly."""
        count = len(self.names)
        shared = [_told(e) for e in self.effects if e.of == SHARED and not e.faint]
        own = [f"{e.effect} of {e.specimen} ({_percent(e.probability)})" for e in self.effects if e.of == OWN]
        faint = [_told(e) for e in self.effects if e.of == SHARED and e.faint]
        none = f"The {count} specimens share no effect{' that shows' if faint else ''}"
        first = f"All {count} specimens have {_listed(shared)}" if shared else none
        first += f"; of one specimen alone: {_listed(own)}" if own else ""
        return f"{first}; alike in all, but faint: {_listed(faint)}." if faint else f"{first}."

    def as_json(self) -> dict[str, Any]:
        """Return the content of specimens.json."""
        return {
            "schema": SCHEMA,
            "specimens": [{"name": n, "rig": rig} for n, rig in zip(self.names, self.rigs, strict=True)],
            "sentence": self.sentence,
            "effects": [e.as_json() for e in self.effects],
            "numbers": [n.as_json() for n in self.numbers],
            "not_compared": {name: list(units) for name, units in self.not_compared.items()},
        }

    def _headline(self) -> str:
        return self.sentence

    def _rows(self) -> list[dict[str, Any]]:
        rows = []
        for n in (*(n for e in self.effects for n in e.sizes), *self.numbers):
            row: dict[str, Any] = {"key": n.key, "unit": n.unit}
            if n.over is not None:
                row |= {"mean": n.over.mean, "low": n.over.low, "high": n.over.high, "spread": n.over.spread}
                row |= {"spread_low": n.over.spread_low, "spread_high": n.over.spread_high}
            rows.append(row | {name: n.values.get(name, float("nan")) for name in self.names})
        return rows


def _told(effect: JointEffect) -> str:
    return f"{effect.effect} ({_percent(effect.probability)})"


def _percent(probability: float) -> str:
    return f"{100.0 * min(probability, 0.99):.0f} %"


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _number(value: float) -> float | None:
    return float(f"{value:.6g}") if np.isfinite(value) else None
