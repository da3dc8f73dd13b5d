"""What a seed of a family of rigs stands for: the plan of a dirty campaign, and its chain.

Every plan is drawn from the seed alone. A family of dirt has it alone at even seeds, and beside all that is usual at
odd ones. What held-out families have is in no other: no late cards, no other clock, no friction that changes from run
to run.
"""

from dataclasses import replace

import numpy as np

from slipwise_benchmarks.dirty_logger import draw_dirty_logger
from slipwise_benchmarks.dirty_plan import CLASH, Plan, draw_dirt, draw_effects, draw_plan, hide_on_purpose
from slipwise_benchmarks.drawn_rigs import DRAWN, possible_on
from slipwise_benchmarks.family_dirt import NOISE, SOILS, Soiled, noisy
from slipwise_benchmarks.gauges import RICH, USUAL, Logger, draw_logger
from slipwise_benchmarks.hidden_rig import FRAME_EFFECTS, UNKNOWN_KINDS
from slipwise_benchmarks.law_plan import BESIDE
from slipwise_benchmarks.laws import LAWS
from slipwise_benchmarks.library_effects import UNLISTED
from slipwise_benchmarks.plan_rigs import STOREYS, plan_rig_of
from slipwise_benchmarks.planted import BOTH_SHAKE, Plant

#: How often nothing, one or two, or three to five effects are hidden on purpose [1].
_PURPOSE = {"nothing": 0.4, "one or two": 0.45, "three to five": 0.15}
#: Size of a law outside the catalogue: floors after a fit of the base parameters, and limits.
_LAW_FLOORS, _LAW_TARGET = (3.0, 13.0), (1.5, 10.0)
_HELD_OUT_NAMES = frozenset({"clock_skew"})
_HELD_OUT_FIRST = "late"


def clean(seed: int, maker: str) -> Soiled:
    """One or two effects, or nothing, in a clean laboratory."""
    rng = _rng(seed)
    return _for(maker, Soiled(_purpose(seed, rng), clean_chain(rng)))


def usual(seed: int, maker: str) -> Soiled:
    """All that is usual: a campaign of `slipwise_benchmarks.dirty_plan`."""
    plan = draw_plan(seed)
    first = tuple(dict.fromkeys("dead" if kind == _HELD_OUT_FIRST else kind for kind in plan.first))
    return _for(maker, Soiled(replace(plan, first=first), None))


def soiled(kind: str, seed: int, maker: str) -> Soiled:
    """One kind of dirt: alone, or beside all that is usual."""
    rng = _rng(seed)
    plan = _purpose(seed, rng)
    if seed % 2:
        names = {plant.name for plant in plan.plants}
        plan = replace(plan, plants=(*plan.plants, *draw_dirt(names, rng)))
        chain: Logger = draw_dirty_logger(rng, RICH)
    else:
        chain = clean_chain(rng)
    if kind == NOISE:
        return _for(maker, Soiled(plan, noisy(chain, rng)))
    return _for(maker, SOILS[kind](Soiled(plan, chain), rng))


def unknown(seed: int, maker: str) -> Soiled:
    """A law outside the catalogue, sometimes beside one of the catalogue; half of them with all that is usual."""
    rng = _rng(seed)
    kinds = [f"law:{name}" for name in LAWS] + [f"unknown:{kind}" for kind in UNKNOWN_KINDS]
    kinds = kinds if maker == "ode" else [f"unknown:{kind}" for kind in UNLISTED]
    name = kinds[seed % len(kinds)]
    law = Plant(name, 1.0, int(rng.integers(2**31)), False, _log(rng, *_LAW_TARGET), _log(rng, *_LAW_FLOORS))
    beside = [hide_on_purpose(str(rng.choice(BESIDE)), rng)] if rng.random() < 0.4 else []
    plan = Plan("unknown", (law, *beside), (), rich=False, runs=5, short=False, uplift=False)
    if rng.random() < 0.5:
        return _for(maker, Soiled(plan, clean_chain(rng)))
    names = {plant.name for plant in plan.plants}
    return _for(maker, Soiled(replace(plan, plants=(*plan.plants, *draw_dirt(names, rng))), None))


def drawn(seed: int, maker: str) -> Soiled:
    """A rig of 1 to 100 t on three to eight pads, in a clean laboratory."""
    rng = _rng(seed)
    possible = possible_on(plan_rig_of(seed, DRAWN).built)
    plan = replace(_purpose(seed, rng, possible), rig=DRAWN)
    return _for(maker, Soiled(plan, clean_chain(rng)))


def storeys(seed: int, maker: str) -> Soiled:
    """A frame on the girder, in a clean laboratory or in one with all that is usual."""
    rng = _rng(seed)
    possible = (*possible_on(plan_rig_of(seed, STOREYS).built), *FRAME_EFFECTS)
    plan = replace(_purpose(seed, rng, possible), rig=STOREYS)
    if seed % 2 == 0:
        return _for(maker, Soiled(plan, clean_chain(rng)))
    dirt = [p for p in draw_dirt({p.name for p in plan.plants}, rng) if not p.name.startswith(("buffer_", "key_"))]
    return _for(maker, Soiled(replace(plan, plants=(*plan.plants, *dirt)), None))


def clean_chain(rng: np.random.Generator) -> Logger:
    """Draw a chain that tells its filter, without what is off by a fraction of a sample."""
    return replace(draw_logger(rng, USUAL), late={})


def _rng(seed: int) -> np.random.Generator:
    return np.random.default_rng([seed, 61])


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _purpose(seed: int, rng: np.random.Generator, possible: tuple[str, ...] = ()) -> Plan:
    """Draw what is hidden on purpose and how the rig is shaken."""
    group = str(rng.choice(list(_PURPOSE), p=list(_PURPOSE.values())))
    effects = draw_effects(group, rng)
    if possible:  # other rigs: what they can have, and no fault of gauges
        effects = [str(name) for name in rng.choice(possible, size=len(effects), replace=False)]
    unwanted = {*_HELD_OUT_NAMES, *({"rate_and_state"} if set(effects) >= CLASH else ())}
    effects = [name for name in effects if name not in unwanted]
    rich = bool(rng.random() < 0.2) or "anisotropy" in effects
    plants = tuple(hide_on_purpose(effect, rng) for effect in effects)
    runs = int(rng.choice([3, 5], p=[0.25, 0.75]))
    return Plan(group if plants else "nothing", plants, (), rich=rich, runs=runs, short=False, uplift=False)


def _for(maker: str, made: Soiled) -> Soiled:
    """Give the plan as a maker has it: the library's replay knows the library's effects."""
    plants = tuple(p for p in made.plan.plants if p.dirt or p.name not in _HELD_OUT_NAMES)
    if maker != "ode":
        plants = tuple(
            replace(plant, effect=plant.effect if plant.name == "unknown" else plant.name, of_library=True)
            if plant.name not in BOTH_SHAKE and not plant.of_gauge
            else plant
            for plant in plants
        )
    return replace(made, plan=replace(made.plan, plants=plants, maker=maker))
