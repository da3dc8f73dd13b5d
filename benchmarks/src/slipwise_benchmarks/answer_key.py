"""The answer of a dirty campaign: every effect's importance, by simulation without it.

Two runs decide: the first one that is fitted and the held-out one. All else is equal: motions, memories that the
specimen brings into a run, logger, faults of gauges; there is no noise. An effect of the rig is left out of the
simulation, a fault of a gauge out of the measurement.

Part of an effect hides in base parameters. So each has its size in noise floors too, when it alone is hidden in the
base, before and after a linear fit of those parameters; see `slipwise_benchmarks.floors`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.floors import sizes_in_floors
from slipwise_benchmarks.gauges import Logger, measure, sensor
from slipwise_benchmarks.importance import Importance, importance
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.planted import Plant, faults_of, named, only, together, without
from slipwise_benchmarks.rig_ode import Memory, Shaker, simulate
from slipwise_benchmarks.score import SMALLEST
from slipwise_benchmarks.settings import Settings

#: Steps of the simulations that decide [s]: results differ from those of half the step by less than 1e-4.
COARSE = 4.0e-5
EVERY = 5
#: Below this share of what is material nobody asks for the size in floors [1].
_ASKED = 0.5


@dataclass(frozen=True)
class Scene:
    """Everything that is equal whether an effect is there or not.

    Attributes:
        base: true base parameters.
        motions: the runs that decide, the held-out one last.
        numbers: of these runs in the campaign.
        memories: what the specimen brings into each of them.
        clock: of the first of the campaign's runs [s].
        logger: the chain, at a rate that divides that of the simulation.
        names: channels that are recorded.
        first: faults that come before any balance.
        shaker: what makes true channels: the second simulator, or the library.
    """

    base: Settings
    motions: tuple[Motion, ...]
    numbers: tuple[int, ...]
    memories: tuple[Memory, ...]
    clock: float
    logger: Logger
    names: tuple[str, ...]
    first: tuple[Fault, ...] = ()
    shaker: Shaker = simulate

    def shaken(self, plants: Sequence[Plant]) -> list[dict]:
        """Give the true channels of the runs with these effects in the specimen."""
        settings = self.base.changed(**together(plants, self.base).settings)
        runs = []
        for motion, number, memory in zip(self.motions, self.numbers, self.memories, strict=True):
            runs.append(self.shaker(settings.of_run(number, self.clock), motion, memory.copy(), COARSE, EVERY))
        return runs

    def recorded(self, true: Sequence[dict], faults: Sequence[Fault]) -> list[dict]:
        """Give what perfect sensors behind the same logger show of these runs."""
        return [
            measure(one, self.names, self.logger, list(faults), None, number)
            for one, number in zip(true, self.numbers, strict=True)
        ]

    def floors(self, true: Sequence[dict], recorded: Sequence[dict]) -> tuple[float, float]:
        """Give the largest size in any balance of what hides in these runs, before and after a fit of the base."""
        sizes = sizes_in_floors(self.base, list(true), list(recorded), self.logger)
        return max(sizes["raw"].values()), max(sizes["after_fit"].values())

    def last(self) -> "Scene":
        """Give the held-out run alone, without faults that come before any balance."""
        return replace(
            self, motions=self.motions[-1:], numbers=self.numbers[-1:], memories=self.memories[-1:], first=()
        )

    def noise(self) -> dict[str, float]:
        """Give the standard deviation of every channel's noise [SI]."""
        return {name: self.logger.noise[sensor(name)] for name in self.names}


@dataclass(frozen=True)
class Entry:
    """The answer for one effect.

    Attributes:
        importance: what changes without it.
        raw, after_fit: its largest size in any balance when it alone is hidden, before and after a fit of the base
            parameters [floors]; 0 where it is far from material.
    """

    importance: Importance
    raw: float
    after_fit: float

    @property
    def status(self) -> str:
        """Whether it is "material" or "minor"."""
        return self.importance.status

    @property
    def visible(self) -> bool:
        """Whether base parameters leave of it what can be seen."""
        return self.after_fit >= SMALLEST


def alone(scene: Scene, plant: Plant, bare: Sequence[dict]) -> Entry:
    """Give the answer for one effect in an otherwise complete model.

    Args:
        scene: in which it is.
        plant: the effect.
        bare: true channels without anything hidden.
    """
    hidden = plant.hidden(scene.base)
    true = bare if plant.of_gauge else scene.shaken([plant])
    there = scene.recorded(true, faults_of(hidden, scene.names))
    held_out = None if plant.of_gauge else (true[-1], bare[-1])
    worth = importance((there, scene.recorded(bare, ())), held_out, scene.noise(), plant.of_gauge)
    return Entry(worth, *scene.floors(true, there))


def answer_key(scene: Scene, plants: Sequence[Plant], faults: Sequence[Fault]) -> dict[str, Entry]:
    """Give the answer, name -> entry.

    Args:
        scene: what is equal.
        plants: everything that is hidden.
        faults: of gauges among these, with their rails.
    """
    true, bare = scene.shaken(plants), scene.shaken(())
    every = [*faults, *scene.first]
    there = scene.recorded(true, every)
    entries = {}
    for name in named(plants):
        own = [fault for fault in faults if fault.effect == name]
        if own:
            gone = scene.recorded(true, [fault for fault in every if fault.effect != name])
            worth = importance((there, gone), None, scene.noise(), True)
        else:
            changed = scene.shaken(without(plants, name))
            held_out = (true[-1], changed[-1])
            worth = importance((there, scene.recorded(changed, every)), held_out, scene.noise(), False)
        raw = after = 0.0
        if worth.of_limit > _ASKED:
            lone = bare if own else scene.shaken(only(plants, name))
            raw, after = scene.floors(lone, scene.recorded(lone, own))
        entries[name] = Entry(worth, raw, after)
    return entries
