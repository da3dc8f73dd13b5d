"""Rigs that a plan may name: the bridges, and those that bring their own specimen.toml."""

from dataclasses import dataclass

import numpy as np

from slipwise_benchmarks.drawn_rigs import DRAWN, as_built, draw_rig, natural_frequency, with_cells_for
from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.motions import NATURAL
from slipwise_benchmarks.parts import Storey
from slipwise_benchmarks.settings import Settings, drawn_law, random_rig, rated

#: A frame of one to four floors on a girder on four pads.
STOREYS = "storeys"
#: Rigs whose campaign has a specimen.toml.
OWN: tuple[str, ...] = (DRAWN, STOREYS)
_BRIDGES = ("bridge1", "bridge2")


@dataclass(frozen=True)
class PlanRig:
    """A specimen.

    Attributes:
        name: as in the plan.
        rated: what its laboratory knows of it.
        built: what it is.
        natural: frequency round which a sine is drawn [Hz].
    """

    name: str
    rated: Settings
    built: Settings
    natural: float

    def with_cells(self, logger: Logger) -> Logger:
        """Give a chain with load cells made for this rig."""
        return with_cells_for(self.built, logger)


def plan_rig_of(seed: int, name: str) -> PlanRig:
    """Give the specimen that a campaign of this seed has."""
    return draw_plan_rig(name, generators(seed)[0])


def generators(seed: int) -> list[np.random.Generator]:
    """Give the generators of a campaign: of its specimen, first things, runs, chain, what is said, and noise."""
    return np.random.default_rng([seed, 17]).spawn(6)


def draw_plan_rig(name: str, rng: np.random.Generator) -> PlanRig:
    """Draw a specimen; "" is one of the bridges."""
    if name == DRAWN:
        said = draw_rig(rng)
        built = as_built(said, rng).changed(yaw_known=True)
        return PlanRig(name, said, built, natural_frequency(built))
    if name == STOREYS:
        said = _frame(rng)
        built = said.changed(
            mass=said.mass * (1.0 + rng.normal(0.0, 0.004)),
            height=said.height * (1.0 + rng.normal(0.0, 0.01)),
            pad_stiffness=said.pad_stiffness * (1.0 + rng.normal(0.0, 0.05)),
            **drawn_law(said, rng),
        )
        return PlanRig(name, said, built, natural_frequency(built))
    name = name or str(rng.choice(_BRIDGES))
    return PlanRig(name, rated(name), random_rig(name, rng), NATURAL[name])


def _frame(rng: np.random.Generator) -> Settings:
    """Draw a base of 4 to 10 t that carries one to four floors; the frame swings at 2 to 6 Hz on a fixed base.

    Source: a frame of few storeys has a period of 0.1 s a storey and more; damping 1 to 4 % of critical. Sizes assumed.
    """
    count, mass = int(rng.integers(1, 5)), float(rng.uniform(4.0e3, 1.0e4))
    height = float(rng.uniform(0.25, 0.4))
    floor = mass * float(rng.uniform(0.25, 0.6))
    first = float(rng.uniform(2.0, 6.0)) * 2.0 * np.pi
    # equal floors on equal columns: the lowest mode has w = 2 sqrt(k/m) sin(pi / (4 n + 2))
    stiffness = floor * (first / (2.0 * np.sin(np.pi / (4.0 * count + 2.0)))) ** 2
    damping = 2.0 * float(rng.uniform(0.01, 0.04)) * stiffness / first
    step = float(rng.uniform(0.7, 1.2))
    storeys = [Storey(floor, height + step * number, stiffness, damping) for number in range(1, count + 1)]
    carried = mass + count * floor
    along, across, depth = 3.4, 4.4, 0.4
    per_pad = 0.25 * carried * (2.0 * np.pi * float(rng.uniform(40.0, 60.0))) ** 2
    return rated("block").changed(
        mass=mass,
        height=height,
        storeys=storeys,
        spacing_x=3.0,
        spacing_y=4.0,
        inertia_roll=mass / 12.0 * (across**2 + depth**2),
        inertia_pitch=mass / 12.0 * (along**2 + depth**2),
        inertia_yaw=mass / 12.0 * (along**2 + across**2),
        pad_stiffness=per_pad,
        pad_damping=2.0 * 0.05 * np.sqrt(per_pad * 0.25 * carried),
        pad_size=carried / 1.0e4,
        size=carried / 1.0e4,
    )
