"""Rigs of any size for the bench: 1 to 100 t on three to eight pads, flat or pendulums, h/b of 0.1 to 1.

`draw_rig` draws what a laboratory knows of its rig and writes into its specimen.toml, `as_built` what it has then.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.hidden import PHYSICS
from slipwise_benchmarks.parts import Buffer, Pad, pad_table
from slipwise_benchmarks.rig_ode import rest_loads
from slipwise_benchmarks.settings import GRAVITY, Settings, drawn_law, pads_of, rated

Array = NDArray[np.float64]
#: What a campaign of such a rig says of its rig.
DRAWN = "drawn"
#: Mass and area between the pads of the girder that hidden sizes are typical of [kg, m^2].
_MASS, _AREA = 1.0e4, 15.0
#: Every pad carries more than this share of the mean at rest [1].
_LEAST = 0.45
#: Frequencies round which a sine is drawn: of rigs that swing more slowly, or not at all, these [Hz].
_SLOWEST, _FASTEST = 1.9, 4.0
#: How effects are called that a rig without buffers cannot have.
_OF_BUFFERS = ("buffer_", "key_")


def draw_rig(rng: np.random.Generator) -> Settings:
    """Draw a rig as its laboratory knows it; heave is between 35 and 60 Hz, inertia that of a box."""
    while True:
        rig = _draw(rng)
        loads = rest_loads(_table(rig), rig.mass, (rig.centre_x, rig.centre_y))
        if loads.min() > _LEAST * loads.mean():
            return rig


def _draw(rng: np.random.Generator) -> Settings:
    mass = float(np.exp(rng.uniform(np.log(1.0e3), np.log(1.0e5))))
    size = (mass / _MASS) ** (1.0 / 3.0)
    along, across = size * rng.uniform(1.5, 5.0), size * rng.uniform(1.5, 5.0)
    height = along * rng.uniform(0.1, 0.35) if rng.random() < 0.7 else along * rng.uniform(0.35, 1.0)
    depth = min(2.0 * height, along)
    pads = _pads(rng, mass, along, across)
    count = len(pads)
    centre_x, centre_y = rng.uniform(-0.04, 0.04, 2) * (along, across) * (rng.random() < 0.3)
    buffers = _buffers(rng, mass, height, along, across, (centre_x, centre_y), curved=pads[0].curvature > 0.0)
    return rated("block").changed(
        mass=mass,
        height=height,
        centre_x=centre_x,
        centre_y=centre_y,
        spacing_x=2.0 * max(abs(pad.x) for pad in pads),
        spacing_y=2.0 * max(abs(pad.y) for pad in pads),
        inertia_roll=mass / 12.0 * (across**2 + depth**2),
        inertia_pitch=mass / 12.0 * (along**2 + depth**2),
        inertia_yaw=mass / 12.0 * (along**2 + across**2),
        pad_area=np.mean([pad.area for pad in pads]),
        pad_stiffness=np.mean([pad.stiffness for pad in pads]),
        pad_damping=np.mean([pad.damping for pad in pads]),
        buffer_stiffness=sum(buffer.stiffness_x for buffer in buffers),
        pads=pads,
        buffers=buffers,
        seating=(0.0,) * count,
        patch=(0.0,) * count,
        pad_factor=(1.0,) * count,
        law_pads=(1.0,) * count,
        size=mass / _MASS,
        pad_size=4.0 * mass / _MASS / count,
        length=np.sqrt(along * across / _AREA),
    )


def _pads(rng: np.random.Generator, mass: float, along: float, across: float) -> tuple[Pad, ...]:
    """Draw three to eight pads in two rows, not quite straight, their middle that of the table."""
    count = int(rng.integers(3, 9))
    first = (count + 1) // 2
    rows = [np.linspace(-0.5, 0.5, n) if n > 1 else np.zeros(1) for n in (first, count - first)]
    places = np.concatenate(
        [np.stack([row, np.full(row.size, y)], axis=1) for row, y in zip(rows, (0.5, -0.5), strict=True)]
    )
    if rng.random() < 0.5 and count > 4:
        places = places[:, ::-1]
    if rng.random() < 0.6:
        places = places + rng.uniform(-0.06, 0.06, places.shape)
    places = places * (along, across)
    unlike = 1.0 + rng.uniform(-0.15, 0.15, (2, count)) * (rng.random() < 0.5)
    share = mass / count
    stiffness = share * (2.0 * np.pi * rng.uniform(35.0, 60.0)) ** 2 * unlike[0]
    damping = 2.0 * rng.uniform(0.03, 0.06) * np.sqrt(stiffness.mean() * share) * unlike[0]
    area = share * GRAVITY / rng.uniform(10.0e6, 25.0e6) * unlike[1]
    heights = rng.uniform(-1.0, 1.0, count) * 0.1 * share * GRAVITY / stiffness.mean() * (rng.random() < 0.25)
    curvature = 1.0 / rng.uniform(0.5, 3.0) if rng.random() < 0.25 else 0.0
    middle = stiffness @ places / stiffness.sum()
    columns = np.column_stack([places - middle, area, stiffness, damping, heights]).tolist()
    return tuple(
        Pad(name, x, y, size, spring, dashpot, high, curvature)
        for name, (x, y, size, spring, dashpot, high) in zip("ABCDEFGH", columns, strict=False)
    )


def _buffers(
    rng: np.random.Generator, mass: float, height: float, along: float, across: float, centre: tuple[float, float],
    curved: bool,
) -> tuple[Buffer, ...]:  # fmt: skip
    """Draw none to four buffers round the centre of gravity, on which the girder swings at 1.5 to 4 Hz."""
    places = {
        1: [(0.0, 0.0)],
        2: [(0.0, 0.3), (0.0, -0.3)],
        3: [(0.0, 0.0), (0.0, 0.3), (0.0, -0.3)],
        4: [(0.3, 0.3), (-0.3, 0.3), (0.3, -0.3), (-0.3, -0.3)],
    }
    count = int(rng.integers(1, 5))
    stiffness = mass * (2.0 * np.pi * rng.uniform(1.5, 4.0)) ** 2 / count
    aside = stiffness * (rng.uniform(0.5, 1.5) if rng.random() < 0.5 else 1.0)
    z = height * rng.uniform(0.0, 0.2) if rng.random() < 0.3 else 0.0
    if rng.random() > (0.3 if curved else 0.75):
        return ()
    return tuple(
        Buffer(str(i), centre[0] + x * along, centre[1] + y * across, z, stiffness, aside)
        for i, (x, y) in enumerate(places[count], start=1)
    )


def as_built(rig: Settings, rng: np.random.Generator) -> Settings:
    """Give what a rig is when it stands: some per cent off what its laboratory knows, as the bench's other rigs are."""
    mass = rig.mass * (1.0 + rng.normal(0.0, 0.004))
    spring, buffer = 1.0 + rng.normal(0.0, 0.05), 1.0 + rng.normal(0.0, 0.04)
    pads = tuple(pad._replace(stiffness=spring * pad.stiffness) for pad in rig.pads)
    buffers = tuple(
        b._replace(stiffness_x=buffer * b.stiffness_x, stiffness_y=buffer * b.stiffness_y) for b in rig.buffers
    )
    return rig.changed(
        mass=mass,
        height=rig.height * (1.0 + rng.normal(0.0, 0.01)),
        inertia_roll=rig.inertia_roll * rng.uniform(0.9, 1.1),
        inertia_pitch=rig.inertia_pitch * rng.uniform(0.9, 1.1),
        inertia_yaw=rig.inertia_yaw * rng.uniform(0.9, 1.1),
        pads=pads,
        pad_stiffness=spring * rig.pad_stiffness,
        buffers=buffers,
        buffer_stiffness=buffer * rig.buffer_stiffness,
        **drawn_law(rig, rng),
    )


def _table(rig: Settings) -> Array:
    return pad_table(rig.pads, rig.mass, rig.seating, (rig.pad_factor, rig.patch, rig.law_pads))


def natural_frequency(rig: Settings) -> float:
    """Give the frequency [Hz] on buffers and curved plates round which a sine is drawn."""
    per_mass = rig.buffer_stiffness / rig.mass + GRAVITY * float(np.mean([pad.curvature for pad in pads_of(rig)]))
    return float(np.clip(np.sqrt(per_mass) / (2.0 * np.pi), _SLOWEST, _FASTEST))


def possible_on(rig: Settings) -> tuple[str, ...]:
    """Give the effects of the catalogue that a rig can have."""
    pads = len(rig.pads) or 4
    without = {"uneven_seating"} if pads == 3 else set()
    if rig.pads and len({buffer.y for buffer in rig.buffers}) < 2:
        without |= {"buffer_mismatch"}
    there = bool(rig.buffer_stiffness)
    return tuple(name for name in PHYSICS if name not in without and (there or not name.startswith(_OF_BUFFERS)))


def with_cells_for(rig: Settings, logger: Logger) -> Logger:
    """Give a chain with load cells whose range, and noise, is made for the load of a pad."""
    larger = {"load": rig.pad_size, "force": rig.pad_size}
    return replace(logger, noise={kind: level * larger.get(kind, 1.0) for kind, level in logger.noise.items()})
