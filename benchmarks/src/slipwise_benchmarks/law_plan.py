"""Which campaign with a law outside the catalogue a seed stands for: the law, what is beside it, and the dirt."""

from dataclasses import dataclass

import numpy as np

from slipwise_benchmarks.dirty_plan import Plan, draw_dirt
from slipwise_benchmarks.law import Law
from slipwise_benchmarks.laws import LAWS
from slipwise_benchmarks.planted import Plant

#: What a campaign has -> its share of campaigns: a law that states drive, one that they do not, or none.
MIX = {"in library": 0.68, "absent": 0.12, "none": 0.20}
#: Seeds that follow each other meet the mix, and the laws in it, evenly when they walk by the golden section.
_GOLDEN = 0.6180339887498949
#: Effects of the catalogue that may stand beside a law.
BESIDE = (
    *("run_in", "buffer_damping", "breakaway", "pad_spread", "slide_tilt", "direction_asymmetry", "pressure_law"),
    *("buffer_hysteresis", "buffer_hardening", "heating", "uneven_seating", "mass_eccentricity"),
)
#: State or port of a law -> effects that stand for a part of it, so that nobody could say which of them is there.
_ALIKE: dict[str, set[str]] = {
    "load": {"pressure_law", "uneven_seating", "mass_eccentricity"},
    "lagged_load": {"pressure_law"},
    "heat": {"heating", "run_in"},
    "separate_body": {"heating", "run_in"},
    "outward": {"buffer_hardening", "direction_asymmetry"},
    "one pad": {"pad_spread", "mass_eccentricity", "uneven_seating"},
    "girder": {"buffer_damping", "buffer_hysteresis", "buffer_hardening"},
    "buffer": {"buffer_damping", "buffer_hysteresis", "buffer_hardening"},
    "time_since_reversal": {"breakaway"},
    "distance_since_reversal": {"buffer_hysteresis"},
}
#: Size of the law after a fit of the base parameters [floors].
_FLOORS = (3.5, 13.0)


@dataclass(frozen=True)
class LawPlan:
    """What a seed stands for.

    Attributes:
        law: a name of `LAWS`; "" for none.
        beside: effects of the catalogue that matter too.
        dirty: whether there are small imperfections and a laboratory's chain.
        plan: all of it, as a dirty campaign is built from it.
    """

    law: str
    beside: tuple[str, ...]
    dirty: bool
    plan: Plan


def draw_law_plan(seed: int, law: str | None = None) -> LawPlan:
    """Draw what a seed decides before the specimen is known.

    Args:
        seed: of everything random.
        law: a name of `LAWS` or "" for none, whatever the seed stands for. None: the seed decides.
    """
    rng = np.random.default_rng([seed, 41])
    law = _law_of(seed) if law is None else law
    count = int(rng.choice(3, p=[0.5, 0.35, 0.15] if law else [0.7, 0.3, 0.0]))
    beside = tuple(str(name) for name in rng.choice(beside_of(law), size=count, replace=False))
    dirty = bool(rng.random() < 0.5)
    plants = [_law(law, rng)] if law else []
    plants += [_beside(name, rng) for name in beside]
    plants += draw_dirt({plant.name for plant in plants}, rng) if dirty else []
    group = "unknown" if law else ("one or two" if beside else "nothing")
    return LawPlan(law, beside, dirty, Plan(group, tuple(plants), (), rich=False, runs=5, short=False, uplift=False))


def beside_of(law: str) -> list[str]:
    """Give the effects of the catalogue that may stand beside a law, "" for none."""
    kinds = {*LAWS[law].states, LAWS[law].port} if law else set()
    alike = set().union(*(_ALIKE.get(kind, set()) for kind in kinds))
    return [name for name in BESIDE if name not in alike]


def _law_of(seed: int) -> str:
    place = (seed * _GOLDEN) % 1.0
    for kind, share in MIX.items():
        if place < share and kind != "none":
            names = [name for name, law in LAWS.items() if law.absent == (kind == "absent")]
            return names[int(place / share * len(names))]
        place -= share
    return ""


def _law(name: str, rng: np.random.Generator) -> Plant:
    floors = float(np.exp(rng.uniform(*np.log(_FLOORS))))
    return Plant(f"law:{name}", 1.0, int(rng.integers(2**31)), False, 0.0, floors)


def _beside(name: str, rng: np.random.Generator) -> Plant:
    target = float(np.exp(rng.uniform(np.log(1.5), np.log(5.0))))
    return Plant(
        name, 1.0, int(rng.integers(2**31)), False, target, float(np.exp(rng.uniform(np.log(1.5), np.log(4.0))))
    )


def law_of(plan: LawPlan) -> Law | None:
    """Give the law of a plan."""
    return LAWS[plan.law] if plan.law else None
