"""Campaigns with a hidden effect: `make_campaign(folder, seed)` writes one and gives the answer."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.drawn_rigs import DRAWN, as_built, draw_rig, natural_frequency, possible_on, with_cells_for
from slipwise_benchmarks.faults import Fault, with_rails
from slipwise_benchmarks.floors import sizes_in_floors
from slipwise_benchmarks.gauges import Logger, draw_logger, measure, recorded_channels
from slipwise_benchmarks.hidden import SIZES, Case, Hidden, draw, hide
from slipwise_benchmarks.motions import NATURAL, Motion, draw_quake, draw_sine
from slipwise_benchmarks.rig_ode import EVERY, STEP, Memory, Shaker, simulate
from slipwise_benchmarks.settings import GRAVITY, Settings, pad_names, random_rig, rated
from slipwise_benchmarks.specimen_text import specimen_toml
from slipwise_benchmarks.truth import Truth
from slipwise_benchmarks.write import write_campaign

Array = NDArray[np.float64]
Run = dict[str, Array]
MOST_SLIP = 0.045
LEAST_LOAD = 600.0
_COARSE = 4.0e-5
_CALMER = 12  # times that motions are made smaller when a hidden effect lets the girder slip or lift too far


@dataclass(frozen=True)
class Campaign:
    """A campaign in memory.

    Attributes:
        truth: the answer.
        true: run -> channels of `simulate` at 5 kHz, true slip speed among them.
        recorded: run -> channels at 500 Hz as the laboratory has them.
        specimen: text of the specimen.toml of a drawn rig; "" for those that have a name.
    """

    truth: Truth
    true: dict[str, Run]
    recorded: dict[str, Run]
    specimen: str = ""

    def at_samples(self, run: str) -> Run:
        """Give the true channels of a run, unfiltered and free of noise, at the recorded instants."""
        stride = int(round(self.recorded[run]["time"][1] / self.true[run]["time"][1]))
        return {name: values[::stride] for name, values in self.true[run].items()}


def fit_amplitude(base: Settings, motion: Motion, target: float, low: float, high: float) -> Motion:
    """Scale the horizontal part until the base rig slips about `target` [m], its peak within `low`..`high` [m/s^2]."""
    for _ in range(3):
        peak = float(np.abs(motion.ax).max())
        slip = float(np.abs(simulate(base, motion, step=_COARSE)["slip_x"]).max())
        factor = float(np.clip((target / max(slip, 1.0e-4)) ** 0.6, 0.4, 2.0))
        motion = motion.scaled(float(np.clip(peak * factor, low, high)) / peak)
    return motion


def draw_motions(natural: float, base: Settings, rng: np.random.Generator, rich: bool) -> dict[str, Motion]:
    """Draw the five table motions of a campaign; slips of the base rig are about 10 to 32 mm.

    Args:
        natural: frequency of the girder on its buffers [Hz].
        base: the rig.
        rng: generator.
        rich: with motion across.
    """
    sine = draw_sine(natural, rng, rich)
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


def shake(
    settings: Settings,
    motions: dict[str, Motion],
    clock: float,
    step: float = STEP,
    every: int = EVERY,
    memories: dict[str, Memory] | None = None,
    shaker: Shaker = simulate,
) -> dict[str, Run]:
    """Run all motions in order on one specimen: wear stays, heat is gone after the rest.

    Args:
        settings: of the specimen.
        motions: run -> motion.
        clock: of the first run [s].
        step: of the integration [s].
        every: steps for a row of the result.
        memories: gets, for each run, what the specimen brings into it.
        shaker: what makes true channels of a specimen, a motion and its memory: `simulate`, or the library.
    """
    memory = Memory()
    runs = {}
    for number, (name, motion) in enumerate(motions.items()):
        if memories is not None:
            memories[name] = memory.copy()
        runs[name] = shaker(settings.of_run(number, clock), motion, memory, step, every)
    return runs


def _too_wild(base: Settings, runs: dict[str, Run]) -> bool:
    slip = max(float(np.abs(run["slip_x"]).max()) for run in runs.values())
    load = min(float(run[f"pad_{pad}_N"].min()) for run in runs.values() for pad in pad_names(base))
    return not (slip < MOST_SLIP and load > LEAST_LOAD * base.pad_size)


def _floors(
    base: Settings, runs: dict[str, Run], hidden: Hidden, logger: Logger, names: Sequence[str]
) -> dict[str, dict[str, float]]:
    in_step = replace(logger, late={})
    clean = [measure(true, names, in_step, hidden.faults, None, number) for number, true in enumerate(runs.values())]
    return sizes_in_floors(base, list(runs.values()), clean, in_step)


def build_campaign(
    seed: int,
    *,
    name: str = "",
    effects: Sequence[str] | None = None,
    size: str | None = None,
    rig: str | None = None,
    rich: bool = False,
) -> Campaign:
    """Make a campaign in memory: true channels, recorded channels and the answer.

    Args:
        seed: of everything random.
        name: for the answer.
        effects: what to hide (see `slipwise_benchmarks.hidden.hide`); empty: nothing; None: drawn from the seed.
        size: "small", "medium" or "large"; None: drawn.
        rig: "bridge1" or "bridge2"; None: one of them; `DRAWN`: any that stands.
        rich: motion across as well, and gauges for yaw, the girder's edges and F_y.
    """
    rngs = np.random.default_rng(seed).spawn(6)
    rig = rig or str(rngs[1].choice(["bridge1", "bridge2"]))
    said = draw_rig(rngs[1]) if rig == DRAWN else rated(rig)
    base = as_built(said, rngs[1]) if rig == DRAWN else random_rig(rig, rngs[1])
    if effects is None:
        case = draw(seed, possible_on(base))
    else:
        case = Case(tuple(effects), str(rngs[0].choice(list(SIZES))), rich)
    size = size or case.size
    rich = rich or case.rich
    natural = natural_frequency(base) if rig == DRAWN else NATURAL[rig]
    motions = draw_motions(natural, base, rngs[2], rich)
    hidden = hide(case.effects, size, base, rngs[3])
    # on pads that stand unevenly each has a slip of its own, which follows from forces that are measured
    yaw_known = rich or rig == DRAWN
    settings = base.changed(yaw_known=yaw_known, **hidden.settings)
    clock = float(rngs[3].uniform(0.0, 100.0))
    runs = shake(settings, motions, clock)
    for _ in range(_CALMER):
        if not _too_wild(base, runs):
            break
        motions = {run: motion.scaled(0.85, 0.92) for run, motion in motions.items()}
        runs = shake(settings, motions, clock)
    names = recorded_channels(pad_names(base), rich)
    logger = draw_logger(rngs[4], names)
    if rig == DRAWN:
        logger = with_cells_for(base, logger)
    faults = [with_rails(f, list(runs.values())) if f.effect == "channel_clipping" else f for f in hidden.faults]
    hidden = replace(hidden, faults=tuple(faults))
    recorded = {run: measure(true, names, logger, faults, rngs[5], i) for i, (run, true) in enumerate(runs.items())}
    floors = _floors(base, runs, hidden, logger, names)
    alone = {}
    for member in hidden.missing if len(hidden.missing) > 1 else ():
        part = hidden.only(member)
        shaken = shake(base.changed(yaw_known=yaw_known, **part.settings), motions, clock)
        alone[member] = max(_floors(base, shaken, part, logger, names)["after_fit"].values())
    truth = Truth(name, seed, rig, rich, size if hidden.missing else "", hidden, base, logger, floors, alone)
    return Campaign(truth, runs, recorded, specimen_toml(said) if rig == DRAWN else "")


def with_faults(made: Campaign, faults: Sequence[Fault], seed: int) -> Campaign:
    """Record the same shaking once more, with other faults of gauges and fresh noise; the truth stays the rig's.

    Args:
        made: whose true channels are measured.
        faults: of gauges, in order.
        seed: of the noise.
    """
    logger = made.truth.logger
    names = [name for name in next(iter(made.recorded.values())) if name != "time"]
    railed = [with_rails(f, list(made.true.values())) if f.effect == "channel_clipping" else f for f in faults]
    rng = np.random.default_rng(seed)
    recorded = {
        run: measure(true, names, logger, railed, rng, number) for number, (run, true) in enumerate(made.true.items())
    }
    return replace(made, recorded=recorded)


def make_campaign(
    folder: Path,
    seed: int,
    *,
    effects: Sequence[str] | None = None,
    size: str | None = None,
    rig: str | None = None,
    rich: bool = False,
) -> Truth:
    """Write a campaign (campaign.toml, five CSV files, a drawn rig's specimen.toml, no answer) and give the answer.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        seed: as in `build_campaign`, and so all others.
        effects: names, or None to draw them.
        size: of the effects, or None to draw it.
        rig: name, or None to draw it.
        rich: whether there are more gauges.
    """
    made = build_campaign(seed, name=folder.name, effects=effects, size=size, rig=rig, rich=rich)
    truth = made.truth
    write_campaign(folder, "specimen.toml" if made.specimen else truth.rig, truth.logger, made.recorded)
    if made.specimen:
        (folder / "specimen.toml").write_text(made.specimen, encoding="utf-8")
    return truth
