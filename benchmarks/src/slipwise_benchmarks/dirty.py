"""Dirty campaigns: many small imperfections at once, as in a laboratory, with or without effects that matter.

`make_dirty(folder, seed)` writes one and gives the answer. Everything is drawn from the seed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.answer_key import COARSE, EVERY, Scene, alone, answer_key
from slipwise_benchmarks.campaign import MOST_SLIP, shake
from slipwise_benchmarks.dirty_logger import draw_dirty_logger, with_ranges
from slipwise_benchmarks.dirty_plan import Plan, draw_plan
from slipwise_benchmarks.dirty_runs import draw_dirty_runs
from slipwise_benchmarks.dirty_truth import DirtyTruth
from slipwise_benchmarks.faults import Fault, with_rails
from slipwise_benchmarks.first_things import First, draw_first
from slipwise_benchmarks.gauges import Logger, measure, recorded_channels
from slipwise_benchmarks.makers import MAKERS
from slipwise_benchmarks.more_dirt import UNNAMED
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.plan_rigs import OWN, draw_plan_rig, generators
from slipwise_benchmarks.planted import Plant, faults_of, together
from slipwise_benchmarks.rig_ode import Memory, Shaker
from slipwise_benchmarks.settings import Settings, pad_names
from slipwise_benchmarks.specimen_text import specimen_toml
from slipwise_benchmarks.write import write_campaign

Array = NDArray[np.float64]
Run = dict[str, Array]
_CALMER = 10  # times that motions are made smaller when the girder slips too far
#: Rates above it show nothing more of what matters [Hz].
_KEY_RATE = 1000.0
#: Steps for a row of what is recorded: rows divide into any rate that is drawn.
_FINE = 5
_SHRINK = 4  # times that dirt which matters is made smaller, then left out, where nothing should matter
_BELOW = 0.6  # of what is material that it has then


@dataclass(frozen=True)
class DirtyCampaign:
    """A dirty campaign in memory.

    Attributes:
        truth: the answer.
        motions: run -> table motion.
        true: run -> channels of `simulate` at 10 kHz.
        recorded: run -> channels at the logger's rate as the laboratory has them.
        specimen: text of the specimen.toml of a rig that has one; "" for those that have a name.
    """

    truth: DirtyTruth
    motions: dict[str, Motion]
    true: dict[str, Run]
    recorded: dict[str, Run]
    specimen: str = ""


def build_dirty(seed: int, *, name: str = "", plan: Plan | None = None, logger: Logger | None = None) -> DirtyCampaign:
    """Make a dirty campaign in memory.

    Args:
        seed: of everything random.
        name: for the answer.
        plan: what is hidden and how it is shaken; None: what the seed stands for.
        logger: the chain; None: a laboratory's as it is, drawn.
    """
    rngs = generators(seed)
    plan = draw_plan(seed) if plan is None else plan
    specimen = draw_plan_rig(plan.rig, rngs[0])
    rig, own = specimen.name, specimen.name in OWN
    base = specimen.built.changed(yaw_known=plan.rich or specimen.built.yaw_known)
    names = recorded_channels(pad_names(base), plan.rich, len(base.storeys))
    shaker = MAKERS[plan.maker]
    first = [draw_first(kind, names, plan.runs, rngs[1]) for kind in plan.first]
    late = max((one.fault.size for one in first if one.fault is not None and one.kind == "late"), default=0.0)
    motions, roles = draw_dirty_runs(specimen.natural, base, plan, rngs[2])
    chain = draw_dirty_logger(rngs[3], names) if logger is None else logger
    chain = specimen.with_cells(chain) if own else chain
    clock = float(rngs[4].uniform(0.0, 100.0))

    def scene(memories: Mapping[str, Memory]) -> Scene:
        chosen = [next(iter(motions)), next(run for run, role in roles if role == "holdout")]
        return Scene(
            base,
            tuple(motions[run] for run in chosen),
            tuple(list(motions).index(run) for run in chosen),
            tuple(memories[run] for run in chosen),
            clock,
            replace(chain, rate=min(chain.rate, _KEY_RATE)),
            names,
            tuple(one.fault for one in first if one.fault is not None),
            shaker,
        )

    plants = _sized(scene({run: Memory() for run in motions}), plan.plants)
    for attempt in range(_SHRINK):
        motions, memories, coarse = _calm(base, plants, motions, clock, plan.uplift, shaker)
        now = scene(memories)
        faults = _faults(plants, base, names, list(coarse.values()))
        key = answer_key(now, plants, faults)
        small = set(key) if plan.group == "nothing" else UNNAMED
        large = {n for n, e in key.items() if e.status == "material" and n in small}
        if not large:
            break
        if attempt == 0:
            plants = [p.scaled(_BELOW / key[p.name].importance.of_limit) if p.name in large else p for p in plants]
        else:
            plants = [p for p in plants if p.name not in large]
    motions = {run: motion.followed_by_rest(late) for run, motion in motions.items()}
    true = shake(base.changed(**together(plants, base).settings), motions, clock, every=_FINE, shaker=shaker)
    chain = with_ranges(chain, true, names)
    every = [*faults, *now.first]
    recorded = {run: measure(one, names, chain, every, rngs[5], i) for i, (run, one) in enumerate(true.items())}
    said_rig, said_mass = _said(rig, base, first, plan, rngs[4])
    truth = DirtyTruth(
        name, seed, plan, rig, said_rig, said_mass, base, chain, roles, together(plants, base), key, first
    )
    return DirtyCampaign(truth, motions, true, recorded, specimen_toml(specimen.rated) if own else "")


def _sized(scene: Scene, plants: Sequence[Plant]) -> list[Plant]:
    """Give hidden effects the size they should have, alone, in the held-out run; make dirt smaller where it matters."""
    last = scene.last()
    bare = last.shaken(())
    sized = []
    for plant in plants:
        if plant.effect == "channel_clipping":  # its size is a share of what the runs reach
            sized.append(plant)
            continue
        found = alone(last, plant, bare)
        factor = plant.target / max(found.importance.of_limit, 1.0e-6)
        if plant.floors:
            factor = max(factor, plant.floors / max(found.after_fit, 1.0e-3))
        sized.append(plant.scaled(min(factor, 1.0) if plant.dirt else factor))
    return sized


def _calm(
    base: Settings,
    plants: Sequence[Plant],
    motions: dict[str, Motion],
    clock: float,
    uplift: bool,
    shaker: Shaker,
) -> tuple[dict[str, Motion], dict[str, Memory], dict[str, Run]]:
    """Make motions smaller until no run slips too far or lifts a pad; give what the specimen brings into each run."""
    settings = base.changed(**together(plants, base).settings)
    for _ in range(_CALMER):
        memories: dict[str, Memory] = {}
        runs = shake(settings, motions, clock, COARSE, EVERY, memories, shaker)
        wild = [run for run, true in runs.items() if _too_wild(base, true, uplift)]
        if not wild:
            break
        motions = {run: m.scaled(0.85, 1.0 if uplift else 0.9) if run in wild else m for run, m in motions.items()}
    return motions, memories, runs


def _too_wild(base: Settings, true: Run, uplift: bool) -> bool:
    slip = float(np.hypot(true["slip_x"], true["slip_y"]).max())
    load = min(float(true[f"pad_{pad}_N"].min()) for pad in pad_names(base))
    return not (slip < MOST_SLIP and (uplift or load > 600.0 * base.pad_size))


def _faults(plants: Sequence[Plant], base: Settings, names: Sequence[str], runs: list[Run]) -> list[Fault]:
    faults = faults_of(together(plants, base), names)
    return [with_rails(fault, runs) if fault.effect == "channel_clipping" else fault for fault in faults]


def _said(
    rig: str, base: Settings, first: Sequence[First], plan: Plan, rng: np.random.Generator
) -> tuple[str, float | None]:
    """Give the rig and the mass that the laboratory says it has: two times in five one, half of them wrong."""
    if rig in OWN:  # its specimen.toml says the mass
        return "specimen.toml", None
    wrong = any(one.kind == "wrong_rig" for one in first)
    said = next(other for other in ("bridge1", "bridge2") if (other == rig) != wrong)
    if plan.mass_error is not None:
        return said, base.mass * (1.0 + plan.mass_error)
    spread = float(rng.choice([0.001, 0.03]))
    mass = base.mass * (1.0 + rng.normal(0.0, spread))
    return said, float(mass) if rng.random() < 0.4 else None


def make_dirty(folder: Path, seed: int) -> DirtyTruth:
    """Write a dirty campaign, without the answer, and give the answer.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        seed: of everything random.
    """
    made = build_dirty(seed, name=folder.name)
    write_dirty(folder, made)
    return made.truth


def write_dirty(folder: Path, made: DirtyCampaign) -> None:
    """Write campaign.toml, the runs and a specimen.toml where the rig has one."""
    truth = made.truth
    write_campaign(folder, truth.said_rig, truth.logger, made.recorded, truth.roles, truth.said_mass)
    if made.specimen:
        (folder / "specimen.toml").write_text(made.specimen, encoding="utf-8")
