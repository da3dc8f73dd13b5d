"""What is hidden in a campaign: names, sizes and laws, drawn at random."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.hidden_gauge import GAUGE_EFFECTS, ON_REQUEST
from slipwise_benchmarks.hidden_pad import PAD_EFFECTS
from slipwise_benchmarks.hidden_rig import FRAME_EFFECTS, RIG_EFFECTS, UNKNOWN_KINDS, unknown
from slipwise_benchmarks.laws import LAWS
from slipwise_benchmarks.settings import Settings

#: Middle of each size, in multiples of what is typical of the rig.
SIZES = {"small": 0.4, "medium": 1.0, "large": 2.5}
PHYSICS: tuple[str, ...] = (*PAD_EFFECTS, *RIG_EFFECTS)
INSTRUMENTS: tuple[str, ...] = tuple(name for name in GAUGE_EFFECTS if name not in ON_REQUEST)
#: Effects that a campaign without motion across and without yaw cannot show, or hardly.
RICH_ONLY: tuple[str, ...] = ("anisotropy",)
RICH_BETTER: tuple[str, ...] = ("buffer_mismatch", "mass_eccentricity", "table_pitch", "guide_drag")
#: Two laws that share one memory in the simulator.
_CLASH = ({"breakaway", "rate_and_state"},)


@dataclass(frozen=True)
class Case:
    """What to hide: effects (none: a complete model), their size, and whether y motion and more gauges are there."""

    effects: tuple[str, ...]
    size: str
    rich: bool = False


@dataclass(frozen=True)
class Hidden:
    """What was hidden.

    Attributes:
        missing: names as a verdict should give them; any law outside the catalogue is "unknown".
        settings: changed settings of the rig.
        faults: of gauges.
        details: effect -> scale, form and values, for people.
    """

    missing: tuple[str, ...] = ()
    settings: dict[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    details: dict[str, dict[str, Any]] = field(default_factory=dict)

    def only(self, name: str) -> "Hidden":
        """Give one member of a pair alone."""
        settings = {key: value for key, value in self.settings.items() if key in self.details[name]}
        faults = tuple(fault for fault in self.faults if fault.effect == name)
        return Hidden((name,), settings, faults, {name: self.details[name]})


def hide(effects: Sequence[str], size: str, base: Settings, rng: np.random.Generator) -> Hidden:
    """Draw laws and sizes of the named effects.

    Args:
        effects: names of the catalogue; "unknown" or "unknown:washboard" for a law outside it; none for complete.
        size: one of `SIZES`; each effect gets 0.8 to 1.25 times that.
        base: the specimen they are hidden in.
        rng: generator.

    Raises:
        KeyError: an effect, a kind or a size that does not exist.
    """
    missing: list[str] = []
    settings: dict[str, Any] = {}
    faults: list[Fault] = []
    details: dict[str, dict[str, Any]] = {}
    for name in effects:
        scale = SIZES[size] * float(np.exp(rng.uniform(np.log(0.8), np.log(1.25))))
        one = hide_one(name, scale, base, rng)
        missing += one.missing
        settings |= one.settings
        faults += one.faults
        details |= one.details
    return Hidden(tuple(missing), settings, tuple(faults), details)


def hide_one(name: str, scale: float, base: Settings, rng: np.random.Generator) -> Hidden:
    """Draw the law of one effect; `scale` is in multiples of what is typical of the rig.

    "law:speed bump" is a law of `slipwise_benchmarks.laws`, outside the catalogue.

    Raises:
        KeyError: an effect or a kind that does not exist.
    """
    family, _, kind = name.partition(":")
    if family in GAUGE_EFFECTS:
        fault = GAUGE_EFFECTS[family](rng, scale, base)
        said = {"scale": scale, "form": fault.form, "channels": list(fault.channels), "size": fault.size}
        return Hidden((family,), faults=(fault,), details={family: said})
    if family == "law":
        change, form = LAWS[kind].change(rng, scale), kind
    elif family == "unknown":
        change, form = unknown(kind or str(rng.choice(list(UNKNOWN_KINDS))), rng, scale, base)
    else:
        change, form = {**PAD_EFFECTS, **RIG_EFFECTS, **FRAME_EFFECTS}[family](rng, scale, base)
    plain = {key: np.asarray(value).tolist() for key, value in change.items()}
    return Hidden((family,), dict(change), details={family: {"scale": scale, "form": form, **plain}})


def _rich(effects: Sequence[str], rng: np.random.Generator) -> bool:
    if set(effects) & set(RICH_ONLY):
        return True
    return bool(rng.random() < (0.5 if set(effects) & set(RICH_BETTER) else 0.06))


def draw_pair(rng: np.random.Generator, physics: Sequence[str] = PHYSICS) -> tuple[str, ...]:
    """Draw two effects: physics with physics, or physics with an instrument."""
    first = str(rng.choice(physics))
    others = INSTRUMENTS if rng.random() < 0.4 else physics
    while True:
        second = str(rng.choice(others))
        if second != first and {first, second} not in _CLASH:
            return first, second


def draw(seed: int, physics: Sequence[str] = PHYSICS) -> Case:
    """Draw a case: a third complete, then single physics, instruments, pairs and laws outside the catalogue.

    Args:
        seed: decides all.
        physics: effects of the catalogue that there can be.
    """
    rng = np.random.default_rng([seed, 7])
    kind = rng.choice(["complete", "physics", "instrument", "pair", "unknown"], p=[0.33, 0.34, 0.13, 0.12, 0.08])
    size = str(rng.choice(list(SIZES)))
    effects: tuple[str, ...] = ()
    if kind == "physics":
        effects = (str(rng.choice(physics)),)
    elif kind == "instrument":
        effects = (str(rng.choice(INSTRUMENTS)),)
    elif kind == "pair":
        effects = draw_pair(rng, physics)
    elif kind == "unknown":
        effects = ("unknown:" + str(rng.choice(list(UNKNOWN_KINDS))),)
    return Case(effects, size, _rich(effects, rng))


def plan(count: int, seed: int) -> list[Case]:
    """Give `count` cases that cover the whole catalogue evenly: one third complete, the rest in turn.

    In every 36 cases that are not complete about 25 are single effects, 6 pairs and 5 laws outside the catalogue;
    each effect meets all sizes in turn.
    """
    rng = np.random.default_rng([seed, 11])
    singles = [str(name) for name in rng.permutation([*PHYSICS, *INSTRUMENTS])]
    kinds = [str(kind) for kind in rng.permutation(list(UNKNOWN_KINDS))]
    sizes = list(SIZES)
    cases: list[Case] = []
    turn = {"single": 0, "unknown": 0}
    for i in range(count):
        place = i // 3 * 2 + i % 3 - 1
        if i % 3 == 0:
            effects, size = (), "medium"
        elif place % 6 == 2:
            effects, size = draw_pair(rng), str(rng.choice(sizes))
        elif place % 7 == 5:
            at = turn["unknown"]
            turn["unknown"] += 1
            effects, size = ("unknown:" + kinds[at % len(kinds)],), sizes[(at + at // len(kinds)) % 3]
        else:
            at = turn["single"]
            turn["single"] += 1
            effects, size = (singles[at % len(singles)],), sizes[(at + at // len(singles)) % 3]
        cases.append(Case(effects, size, _rich(effects, rng)))
    return cases
