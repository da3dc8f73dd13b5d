"""What is planted in a dirty campaign: laws with a size that can be changed while everything else of them stays."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from slipwise_benchmarks.dirt import GAUGE_DIRT, RIG_DIRT
from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.hidden import Hidden, hide_one
from slipwise_benchmarks.library_effects import OF_DIRT, draw_use
from slipwise_benchmarks.more_dirt import MORE_GAUGE_DIRT, MORE_RIG_DIRT
from slipwise_benchmarks.other_forms import OTHER_FORMS
from slipwise_benchmarks.score import INSTRUMENT
from slipwise_benchmarks.settings import Settings

#: Beyond it a law is no longer what its author meant (a large effect of the clean bench has 2.5).
LARGEST = 4.0
_DIRT_OF_RIG = {name: law for name, (_, law) in RIG_DIRT.items()} | MORE_RIG_DIRT
_DIRT_OF_GAUGES = {name: law for name, (_, law) in GAUGE_DIRT.items()} | MORE_GAUGE_DIRT
#: What changes the specimen itself, whoever shakes it.
BOTH_SHAKE = frozenset({*MORE_RIG_DIRT, "superstructure"})


@dataclass(frozen=True)
class Plant:
    """One effect.

    Attributes:
        effect: name of the catalogue, with a colon and a form where it is one of `OTHER_FORMS`; "unknown:washboard" for
            a law outside it.
        scale: size in multiples of what is typical, of dirt or of a hidden effect [1].
        seed: of everything about its law but the size.
        dirt: whether it is one of `slipwise_benchmarks.dirt`.
        target: size wanted, in multiples of what is material; dirt may be smaller, not larger [1].
        floors: least size wanted after a fit of the base parameters [floors]; the larger of the two sizes counts.
        of_library: whether what it changes in the rig is an effect of the library, for the maker that replays with it.
    """

    effect: str
    scale: float
    seed: int
    dirt: bool
    target: float
    floors: float = 0.0
    of_library: bool = False

    @property
    def name(self) -> str:
        """Name as a verdict should give it."""
        return self.effect.partition(":")[0]

    @property
    def of_gauge(self) -> bool:
        """Whether it is a fault of a gauge: the rig moves as if it were not there."""
        return self.name in INSTRUMENT or self.name in MORE_GAUGE_DIRT

    def scaled(self, factor: float) -> "Plant":
        """Give the same law, `factor` times as large where it can be."""
        largest = self.scale if self.dirt else max(LARGEST, self.scale)
        return replace(self, scale=float(np.clip(self.scale * factor, 1.0e-3, largest)))

    def hidden(self, base: Settings) -> Hidden:
        """Give what it changes in the specimen `base`."""
        rng = np.random.default_rng(self.seed)
        if self.dirt and self.name in _DIRT_OF_GAUGES:
            faults = tuple(_DIRT_OF_GAUGES[self.name](rng, self.scale))
            said = {"scale": self.scale, "form": "dirt", "faults": [fault.describe() for fault in faults]}
            return Hidden((self.name,), faults=faults, details={self.name: said})
        if self.of_library and not self.of_gauge and self.name not in BOTH_SHAKE:
            return self._law(*draw_use(self.effect, rng, self.scale * (OF_DIRT if self.dirt else 1.0), base))
        if self.dirt:
            return self._law(_DIRT_OF_RIG[self.name](rng, self.scale, base), "dirt")
        if self.effect in OTHER_FORMS:
            return self._law(*OTHER_FORMS[self.effect](rng, self.scale, base))
        return hide_one(self.effect, self.scale, base, rng)

    def _law(self, change: dict[str, Any], form: str) -> Hidden:
        plain = {key: _plain(value) for key, value in change.items()}
        said = {"scale": self.scale, "form": form, **plain}
        return Hidden((self.name,), change, details={self.name: said})


def _plain(value: Any) -> Any:
    """Give the value of a setting as plain data."""
    if isinstance(value, tuple) and value and hasattr(value[0], "_asdict"):
        return [one._asdict() for one in value]
    return np.asarray(value).tolist()


def together(plants: Iterable[Plant], base: Settings) -> Hidden:
    """Give all of them in one specimen; faults of one name add, laws of one name do not meet."""
    settings: dict[str, Any] = {}
    missing, faults = [], []
    details: dict[str, dict[str, Any]] = {}
    for plant in plants:
        one = plant.hidden(base)
        missing += [name for name in one.missing if name not in missing]
        settings |= one.settings | {"uses": (*settings.get("uses", ()), *one.settings.get("uses", ()))}
        faults += one.faults
        details |= {name + (" (dirt)" if plant.dirt else ""): said for name, said in one.details.items()}
    return Hidden(tuple(missing), settings, tuple(faults), details)


def without(plants: Sequence[Plant], name: str) -> list[Plant]:
    """Leave out everything of one name."""
    return [plant for plant in plants if plant.name != name]


def faults_of(hidden: Hidden, names: Sequence[str]) -> list[Fault]:
    """Give the faults of gauges that a campaign has."""
    kept = []
    for fault in hidden.faults:
        channels = tuple(name for name in fault.channels if name in names)
        if channels:
            kept.append(replace(fault, channels=channels))
    return kept


def named(plants: Iterable[Plant]) -> list[str]:
    """Give every name once."""
    return list(dict.fromkeys(plant.name for plant in plants))


def only(plants: Sequence[Plant], name: str) -> list[Plant]:
    """Keep everything of one name."""
    return [plant for plant in plants if plant.name == name]
