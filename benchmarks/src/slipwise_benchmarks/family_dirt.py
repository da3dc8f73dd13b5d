"""Kinds of dirt that have a family each: what is off in a laboratory, alone, or beside all that is usual.

`soiled(kind, plan, chain, rng)` gives the plan of a campaign and its chain with this dirt.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from slipwise_benchmarks.dirty_plan import CLASH, NEVER_SMALL, Plan
from slipwise_benchmarks.first_things import LATE_CELLS, LATE_CHANNEL
from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.hidden import PHYSICS
from slipwise_benchmarks.planted import Plant

#: Dirt of a family is so many times the usual, and may matter: lowest and highest, and limits of materiality.
_SCALE, _TARGET = (1.5, 6.0), (0.3, 4.0)
#: Small effects of a campaign that has them by the dozen, and how large each is [limits].
_DOZEN, _SMALL = 12, (0.15, 0.8)
#: One of two laws that share a memory, one that needs motion across, and laws that do not vanish with their size.
_NOT_SMALL = frozenset({"rate_and_state", "anisotropy", *NEVER_SMALL})


@dataclass(frozen=True)
class Soiled:
    """A plan and its chain; None: a laboratory's, drawn."""

    plan: Plan
    chain: Logger | None


Soil = Callable[[Soiled, np.random.Generator], Soiled]


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def dirt(effects: tuple[str, ...], rng: np.random.Generator) -> tuple[Plant, ...]:
    """Draw dirt of these names, larger than usual."""
    return tuple(
        Plant(name, _log(rng, *_SCALE), int(rng.integers(2**31)), True, _log(rng, *_TARGET)) for name in effects
    )


def _of(*effects: str) -> Soil:
    def soil(was: Soiled, rng: np.random.Generator) -> Soiled:
        there = {plant.name for plant in was.plan.plants if not plant.dirt}
        new = dirt(tuple(name for name in effects if name not in there), rng)
        kept = tuple(plant for plant in was.plan.plants if not (plant.dirt and plant.name in effects))
        return replace(was, plan=replace(was.plan, plants=(*kept, *new)))

    return soil


def _failed(was: Soiled, rng: np.random.Generator) -> Soiled:
    """A channel that is dead, clipped, or late."""
    kind = str(rng.choice(["dead", "clipped", LATE_CHANNEL]))
    if kind == "clipped":
        taken = [plant for plant in was.plan.plants if plant.name != "channel_clipping"]
        clipped = Plant("channel_clipping", _log(rng, 0.5, 2.0), int(rng.integers(2**31)), False, 1.0)
        return replace(was, plan=replace(was.plan, plants=(*taken, clipped)))
    return replace(was, plan=replace(was.plan, first=(kind,)))


def _second_logger(was: Soiled, rng: np.random.Generator) -> Soiled:
    """Cells on a logger of their own: late by up to seconds, and with another clock."""
    soiled = _of("clock_skew")(was, rng)
    return replace(soiled, plan=replace(soiled.plan, first=(LATE_CELLS,)))


def _wrong_mass(was: Soiled, rng: np.random.Generator) -> Soiled:
    """The mass that campaign.toml says is off by more than a scale may be."""
    error = float(rng.choice([-1.0, 1.0])) * _log(rng, 0.012, 0.06)
    return replace(was, plan=replace(was.plan, mass_error=error))


def _small_effects(was: Soiled, rng: np.random.Generator) -> Soiled:
    """A dozen effects of the catalogue, each below what is material."""
    taken = {plant.name for plant in was.plan.plants if not plant.dirt}
    taken |= CLASH if taken & CLASH else set()
    names = rng.choice([n for n in PHYSICS if n not in taken | _NOT_SMALL], size=_DOZEN, replace=False)
    small = tuple(Plant(str(n), 1.0, int(rng.integers(2**31)), False, _log(rng, *_SMALL)) for n in names)
    kept = tuple(p for p in was.plan.plants if not (p.dirt and p.name in names))
    return replace(was, plan=replace(was.plan, plants=(*kept, *small)))


def noisy(chain: Logger, rng: np.random.Generator) -> Logger:
    """Give a chain with hum of the mains and coloured noise."""
    return replace(
        chain,
        hum=_log(rng, 0.8, 5.0),
        mains=float(rng.choice([50.0, 60.0])),
        correlation=float(rng.uniform(0.3, 0.9)),
        pink=float(rng.uniform(0.1, 0.6)),
        noise={kind: level * _log(rng, 0.7, 3.0) for kind, level in chain.noise.items()},
    )


#: kind -> what makes a campaign dirty so; hum and noise belong to the chain, see `noisy`.
SOILS: dict[str, Soil] = {
    "gains": _of("channel_gain"),
    "offsets": _of("channel_offset"),
    "drifts": _of("channel_drift"),
    "filters_and_delays": _of("channel_filter", "channel_delay"),
    "coupled_gauges": _of("load_crosstalk", "cross_axis"),
    "failed_channels": _failed,
    "second_logger": _second_logger,
    "uneven_seating": _of("uneven_seating"),
    "temperature": _of("temperature"),
    "wrong_mass": _wrong_mass,
    "small_effects": _small_effects,
}
NOISE = "hum_and_noise"
