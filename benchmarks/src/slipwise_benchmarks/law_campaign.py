"""Campaigns with a law outside the catalogue: `make_law_campaign(folder, seed)` writes one, and its answer beside it.

Five runs, as in a dirty campaign: three to fit, a repeat, and other motions to hold out. A clean one has no dirt, and a
chain that tells its filter.
"""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise_benchmarks.dirty import DirtyCampaign, build_dirty
from slipwise_benchmarks.gauges import USUAL, Logger, draw_logger
from slipwise_benchmarks.law_plan import LawPlan, draw_law_plan, law_of
from slipwise_benchmarks.write import write_campaign, write_truth

#: Least and largest size of a law after a fit of the base parameters [floors], and how often it is set to get there.
LEAST, LARGEST = 2.0, 16.0
_TRIES = 4


@dataclass(frozen=True)
class LawCampaign:
    """A campaign in memory.

    Attributes:
        plan: what its seed stands for.
        made: runs, true and recorded, and the answer of a dirty campaign.
    """

    plan: LawPlan
    made: DirtyCampaign

    @property
    def floors(self) -> float:
        """Size of the law after a fit of the base parameters to it alone [floors]; 0 where there is none."""
        return self.made.truth.key["law"].after_fit if self.plan.law else 0.0

    def answer(self) -> dict[str, Any]:
        """Give the answer as plain data: the law, what is beside it, whether there is dirt, and its size."""
        law, truth = law_of(self.plan), self.made.truth
        settings = truth.base.changed(**truth.hidden.settings)
        return {
            "law": None if law is None else law.truth(settings),
            "beside": list(self.plan.beside),
            "dirty": self.plan.dirty,
            "name": self.plan.law,
            "floors": self.floors,
            "of_limit": truth.key["law"].importance.of_limit if law else 0.0,
            "minor": [name for name, entry in truth.key.items() if entry.status == "minor"],
            "seed": truth.seed,
            "rig": truth.rig,
        }


def build_law_campaign(seed: int, *, name: str = "", law: str | None = None, like: int | None = None) -> LawCampaign:
    """Make a campaign in memory.

    Args:
        seed: of everything random.
        name: for the answer.
        law: a name of `slipwise_benchmarks.laws.LAWS`, "" for none; None: what the seed stands for.
        like: seed of another campaign whose law it has, with a size of its own; rig, motions, dirt and what is beside
            it are this seed's.
    """
    plan = draw_law_plan(seed, law) if like is None else _alike(seed, draw_law_plan(like, law))
    made = _built(plan, seed, name)
    for _ in range(_TRIES):
        if not plan.law or LEAST <= made.floors <= LARGEST:
            break
        plan = _resized(plan, (1.3 * LEAST if made.floors < LEAST else 0.7 * LARGEST) / made.floors)
        made = _built(plan, seed, name)
    return made


def _alike(seed: int, other: LawPlan) -> LawPlan:
    """Give the plan of a seed with the law of another plan: the same constants, the seed's own size."""
    plan = draw_law_plan(seed, other.law)
    same = next(p.seed for p in other.plan.plants if p.name == "law")
    plants = [replace(p, seed=same) if p.name == "law" else p for p in plan.plan.plants]
    return replace(plan, plan=replace(plan.plan, plants=tuple(plants)))


def _built(plan: LawPlan, seed: int, name: str) -> LawCampaign:
    logger = None if plan.dirty else draw_clean_logger(seed)
    return LawCampaign(plan, build_dirty(seed, name=name, plan=plan.plan, logger=logger))


def draw_clean_logger(seed: int) -> Logger:
    """Draw the chain of a clean campaign: it tells its filter, and no card is late."""
    return replace(draw_logger(np.random.default_rng([seed, 43]), USUAL), late={})


def _resized(plan: LawPlan, factor: float) -> LawPlan:
    plants = [replace(p, floors=factor * p.floors) if p.name == "law" else p for p in plan.plan.plants]
    return replace(plan, plan=replace(plan.plan, plants=tuple(plants)))


def make_law_campaign(folder: Path, seed: int, *, law: str | None = None, like: int | None = None) -> dict[str, Any]:
    """Write campaign.toml, five CSV files and truth.json, and give the answer.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        seed: as in `build_law_campaign`.
        law: as there.
        like: as there.
    """
    campaign = build_law_campaign(seed, name=folder.name, law=law, like=like)
    answer = campaign.answer()
    write_law_campaign(folder, campaign)
    write_truth(folder / "truth.json", answer)
    return answer


def write_law_campaign(folder: Path, campaign: LawCampaign) -> None:
    """Write campaign.toml and five CSV files: what a laboratory would hand over, without the answer."""
    truth = campaign.made.truth
    rig, mass = (truth.said_rig, truth.said_mass) if campaign.plan.dirty else (truth.rig, None)
    write_campaign(folder, rig, truth.logger, campaign.made.recorded, truth.roles, mass)
