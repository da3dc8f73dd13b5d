"""Which dirty campaign a seed stands for: what is hidden on purpose, the dirt round it, runs and motions."""

from dataclasses import dataclass

import numpy as np

from slipwise_benchmarks.dirt import GAUGE_DIRT, RIG_DIRT
from slipwise_benchmarks.first_things import KINDS
from slipwise_benchmarks.hidden import INSTRUMENTS, PHYSICS, UNKNOWN_KINDS
from slipwise_benchmarks.other_forms import OTHER_FORMS
from slipwise_benchmarks.planted import Plant

#: What is hidden on purpose -> its share of campaigns.
MIX = {"nothing": 0.30, "one or two": 0.35, "three to five": 0.15, "unknown": 0.08, "first": 0.12}
#: Seeds that follow each other meet the mix evenly when they walk through it by the golden section.
_GOLDEN = 0.6180339887498949
#: Laws that share a memory in the simulator, and those that need motion across.
CLASH = {"breakaway", "rate_and_state"}
_ACROSS = {"anisotropy"}
#: Effects of the catalogue that a laboratory would not leave in: a wrong sign is one of the first things.
_NEVER = {"channel_sign"}
#: How often a family that has one gets a form that the clean bench does not know [1].
_OTHER = 0.5
#: How often what matters is large enough to stand above the noise as well [1].
_SEEN = 0.85
#: Laws that do not vanish with their size: an impact in a gap, and a bristle instead of the base's stick.
NEVER_SMALL = {"key_clearance", "presliding"}
#: Dirt stays below this share of what is material unless it is there on purpose.
_MOST_DIRT = 0.8


@dataclass(frozen=True)
class Plan:
    """What a seed stands for.

    Attributes:
        group: one of `MIX`.
        plants: hidden effects and dirt.
        first: kinds of first things.
        rich: motion across and more gauges.
        runs: number of them, 2 to 5.
        short: runs of 4 s.
        uplift: the last fitted run lifts pads; never the only one, for landings hang on the least change.
        rig: "bridge1", "bridge2", one of `plan_rigs.OWN` with its specimen.toml; "": one of the bridges.
        maker: who shakes it, a key of `slipwise_benchmarks.makers.MAKERS`.
        mass_error: of the mass that campaign.toml says, over the true one [1]; None: a laboratory's.
    """

    group: str
    plants: tuple[Plant, ...]
    first: tuple[str, ...]
    rich: bool
    runs: int
    short: bool
    uplift: bool
    rig: str = ""
    maker: str = "ode"
    mass_error: float | None = None


def group_of(seed: int) -> str:
    """Give the group of a seed."""
    return _place(seed)[0]


def _place(seed: int) -> tuple[str, float]:
    """Give the group of a seed, and how far inside it the seed stands [0 to 1]."""
    place = (seed * _GOLDEN) % 1.0
    for group, share in MIX.items():
        if place < share:
            return group, place / share
        place -= share
    return list(MIX)[-1], 0.0  # rounding


def draw_plan(seed: int) -> Plan:
    """Draw everything that a seed decides before the specimen is known."""
    rng = np.random.default_rng([seed, 31])
    group, inside = _place(seed)
    rich = bool(rng.random() < 0.2)
    effects = draw_effects(group, rng)
    rich = rich or bool(_ACROSS & set(effects))
    plants = [hide_on_purpose(effect, rng) for effect in effects]
    plants += draw_dirt({plant.name for plant in plants}, rng)
    runs = int(rng.choice([2, 3, 4, 5], p=[0.12, 0.13, 0.15, 0.6]))
    kinds = [KINDS[int(inside * len(KINDS))]]  # every kind as often as the others
    if rng.random() < 0.25:
        kinds.append(str(rng.choice([kind for kind in KINDS if kind not in kinds])))
    return Plan(
        group=group,
        plants=tuple(plants),
        first=tuple(kinds) if group == "first" else (),
        rich=rich,
        runs=runs,
        short=bool(rng.random() < 0.08),
        uplift=bool(rng.random() < 0.09) and runs > 2,
    )


def draw_effects(group: str, rng: np.random.Generator) -> list[str]:
    """Draw the effects that hide in a campaign of a group."""
    count = {
        "nothing": 0,
        "one or two": int(rng.integers(1, 3)),
        "three to five": int(rng.integers(3, 6)),
        "unknown": int(rng.integers(0, 3)),
        "first": int(rng.integers(0, 3)),
    }[group]
    gauges = [name for name in INSTRUMENTS if name not in _NEVER]
    chosen: list[str] = ["unknown:" + str(rng.choice(list(UNKNOWN_KINDS)))] if group == "unknown" else []
    wanted = count + len(chosen)
    while len(chosen) < wanted:
        name = str(rng.choice(gauges if rng.random() < 0.2 else PHYSICS))
        if name not in chosen and not CLASH <= {*chosen, name}:
            chosen.append(name)
    forms = {form.partition(":")[0]: form for form in OTHER_FORMS}
    return [forms[name] if name in forms and rng.random() < _OTHER else name for name in chosen]


def hide_on_purpose(effect: str, rng: np.random.Generator) -> Plant:
    """Plant an effect that is mostly material, one time in five near the border."""
    low, high = (0.6, 1.6) if rng.random() < 0.2 else (1.5, 15.0)
    target = float(np.exp(rng.uniform(np.log(low), np.log(high))))
    floors = float(np.exp(rng.uniform(np.log(1.4), np.log(8.0)))) if low > 1.0 and rng.random() < _SEEN else 0.0
    return Plant(effect, 1.0, int(rng.integers(2**31)), False, target, floors)


def draw_dirt(taken: set[str], rng: np.random.Generator) -> list[Plant]:
    """Draw the dirt round hidden effects: all of it, and sometimes a law of the catalogue, below what is material.

    Args:
        taken: names that are hidden on purpose.
        rng: generator.
    """
    plants = []
    for effect, (often, _) in {**RIG_DIRT, **GAUGE_DIRT}.items():
        there = rng.random() < often
        scale = float(np.exp(rng.uniform(np.log(0.2), np.log(3.0))))
        most, seed = float(rng.uniform(0.1, _MOST_DIRT)), int(rng.integers(2**31))
        if there and (effect in GAUGE_DIRT or effect not in taken):
            plants.append(Plant(effect, scale, seed, True, most))
    if rng.random() < 0.4:  # some law of the catalogue is really there, and does not matter
        left = [name for name in PHYSICS if name not in taken | set(RIG_DIRT) | CLASH | _ACROSS | NEVER_SMALL]
        most = float(rng.uniform(0.1, _MOST_DIRT))
        plants.append(Plant(str(rng.choice(left)), 1.0, int(rng.integers(2**31)), False, most))
    return plants
