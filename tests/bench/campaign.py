"""Campaigns with a hidden effect: `make_campaign(folder, seed)` writes one and gives the answer."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.faults import with_rails
from bench.floors import sizes_in_floors
from bench.gauges import RICH, USUAL, Logger, draw_logger, measure
from bench.hidden import Case, Hidden, draw, hide
from bench.motions import Motion, draw_quake, draw_sine
from bench.rig_ode import Memory, simulate
from bench.settings import GRAVITY, PADS, Settings, random_rig
from bench.write import RUNS, write_campaign

Array = NDArray[np.float64]
Run = dict[str, Array]
MOST_SLIP = 0.045
LEAST_LOAD = 600.0
_COARSE = 4.0e-5


@dataclass(frozen=True)
class Truth:
    """The answer of one campaign.

    Attributes:
        name: of the folder.
        seed: that made it.
        rig: bridge1 or bridge2.
        rich: whether it has motion across and more gauges.
        size: small, medium or large; "" for a complete model.
        hidden: what the base model lacks.
        base: true base parameters.
        logger: what the chain did.
        floors: {"raw" or "after_fit": {balance: size in floors}}; see `bench.floors`.
    """

    name: str
    seed: int
    rig: str
    rich: bool
    size: str
    hidden: Hidden
    base: Settings
    logger: Logger
    floors: dict[str, dict[str, float]]

    @property
    def missing(self) -> tuple[str, ...]:
        """Names that a verdict should give."""
        return self.hidden.missing

    @property
    def size_in_floors(self) -> float:
        """Largest of the balances before any base fit."""
        return max(self.floors["raw"].values())

    def as_dict(self) -> dict[str, Any]:
        """Give the answer as plain data, in the form of the practice campaigns and more."""
        base = self.base
        settings = {"h": base.height, "Kb": 0.5 * base.buffer_stiffness, "s1": base.s1, "n": base.n, "k": base.k}
        settings |= {"alpha": base.alpha, "mass": base.mass, "pad_stiffness": base.pad_stiffness}
        settings |= {"pad_damping": base.pad_damping, "inertia_pitch": base.inertia_pitch}
        instruments = {fault.effect: fault.describe() for fault in self.hidden.faults}
        logger = {"lowpass": self.logger.lowpass, "order": self.logger.order, "phase": self.logger.phase}
        logger |= {"noise": self.logger.noise, "late": self.logger.late, "correlation": self.logger.correlation}
        return {
            "missing": list(self.missing),
            "settings": settings,
            "instruments": instruments,
            "details": self.hidden.details,
            "size": self.size,
            "size_in_floors": self.size_in_floors,
            "floors": self.floors,
            "seed": self.seed,
            "rig": self.rig,
            "rich": self.rich,
            "logger": logger,
        }


def fit_amplitude(base: Settings, motion: Motion, target: float, low: float, high: float) -> Motion:
    """Scale the horizontal part so that the base rig slips about `target` [m], its peak within `low`..`high` [m/s^2]."""
    for _ in range(3):
        peak = float(np.abs(motion.ax).max())
        slip = float(np.abs(simulate(base, motion, step=_COARSE)["slip_x"]).max())
        factor = float(np.clip((target / max(slip, 1.0e-4)) ** 0.6, 0.4, 2.0))
        motion = motion.scaled(float(np.clip(peak * factor, low, high)) / peak)
    return motion


def draw_motions(rig: str, base: Settings, rng: np.random.Generator, rich: bool) -> dict[str, Motion]:
    """Draw the five table motions of a campaign; slips of the base rig are about 10 to 32 mm."""
    sine = draw_sine(rig, rng, rich)
    sine = fit_amplitude(base, sine, rng.uniform(0.010, 0.022), 0.18 * GRAVITY, 0.5 * GRAVITY)
    first, second = draw_quake(rng, rich), draw_quake(rng, rich)
    first = fit_amplitude(base, first, rng.uniform(0.016, 0.032), 0.4 * GRAVITY, 0.95 * GRAVITY)
    second = fit_amplitude(base, second, rng.uniform(0.014, 0.030), 0.4 * GRAVITY, 0.95 * GRAVITY)
    return {
        "sine_hv": sine,
        "quake_h": first.without_vertical(),
        "quake_hv": first,
        "quake_hv_again": first,
        "quake2_hv": second,
    }


def shake(settings: Settings, motions: dict[str, Motion], clock: float) -> dict[str, Run]:
    """Run all motions in order on one specimen: wear stays, heat is gone after the rest."""
    memory = Memory()
    runs = {}
    for number, (name, _) in enumerate(RUNS):
        now = settings.changed(clock=clock + 1800.0 * number)
        runs[name] = simulate(now, motions[name], memory)
    return runs


def _too_wild(runs: dict[str, Run]) -> bool:
    slip = max(float(np.abs(run["slip_x"]).max()) for run in runs.values())
    load = min(float(run[f"pad_{pad}_N"].min()) for run in runs.values() for pad in PADS)
    return not (slip < MOST_SLIP and load > LEAST_LOAD)


def make_campaign(
    folder: Path,
    seed: int,
    *,
    effects: Sequence[str] | None = None,
    size: str | None = None,
    rig: str | None = None,
    rich: bool = False,
) -> Truth:
    """Write a campaign (campaign.toml and five CSV files, without the answer) and give the answer.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        seed: of everything random.
        effects: what to hide (see `bench.hidden.hide`); empty: nothing; None: drawn from the seed.
        size: "small", "medium" or "large"; None: drawn.
        rig: "bridge1" or "bridge2"; None: drawn.
        rich: motion across as well, and gauges for yaw, the girder's edges and F_y.
    """
    rngs = np.random.default_rng(seed).spawn(6)
    case = draw(seed) if effects is None else Case(tuple(effects), str(rngs[0].choice(["small", "medium", "large"])), rich)
    size = size or case.size
    rich = rich or case.rich
    rig = rig or str(rngs[1].choice(["bridge1", "bridge2"]))
    base = random_rig(rig, rngs[1])
    motions = draw_motions(rig, base, rngs[2], rich)
    hidden = hide(case.effects, size, base, rngs[3])
    settings = base.changed(**hidden.settings)
    clock = float(rngs[3].uniform(0.0, 100.0))
    runs = shake(settings, motions, clock)
    for _ in range(6):
        if not _too_wild(runs):
            break
        motions = {name: motion.scaled(0.85, 0.92) for name, motion in motions.items()}
        runs = shake(settings, motions, clock)
    logger = draw_logger(rngs[4], rich)
    names = RICH if rich else USUAL
    faults = [with_rails(f, list(runs.values())) if f.effect == "channel_clipping" else f for f in hidden.faults]
    recorded = {name: measure(run, names, logger, faults, rngs[5]) for name, run in runs.items()}
    in_step = replace(logger, late={})
    clean = [measure(run, names, in_step, faults, None) for run in runs.values()]
    floors = sizes_in_floors(base, list(runs.values()), clean, in_step)
    write_campaign(folder, rig, logger, recorded)
    hidden = Hidden(hidden.missing, hidden.settings, tuple(faults), hidden.details)
    return Truth(folder.name, seed, rig, rich, size if hidden.missing else "", hidden, base, logger, floors)
