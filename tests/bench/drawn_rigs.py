"""Rigs of any size for the bench: four pads, 1 to 100 t, h/b of 0.1 to 1, other spans, with a specimen.toml each."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from bench.campaign import draw_motions, shake
from bench.gauges import USUAL, draw_logger, measure
from bench.motions import Motion
from bench.settings import GRAVITY, PADS, Settings, rated
from bench.write import write_campaign

#: Pressure on the pads of the reference rig [Pa], and its mass [kg].
_PRESSURE, _MASS = 16.9e6, 1.0e4
#: A pad that carries less than this share of its load at rest is near lifting [1].
_LEAST = 0.1


def draw_rig(rng: np.random.Generator) -> Settings:
    """Draw a rig: its pads bear what those of the reference rig do, buffers swing it at 1.5 to 4 Hz, or there are none.

    Heave is between 35 and 60 Hz. The spring of heave and the inertia of a box decide its pitch.
    """
    mass = float(np.exp(rng.uniform(np.log(1.0e3), np.log(1.0e5))))
    size = (mass / _MASS) ** (1.0 / 3.0)
    along, across = size * rng.uniform(1.5, 5.0), size * rng.uniform(1.5, 5.0)
    height = along * rng.uniform(0.1, 0.35) if rng.random() < 0.7 else along * rng.uniform(0.35, 1.0)
    depth = min(2.0 * height, along)
    stiffness = 0.25 * mass * (2.0 * np.pi * rng.uniform(35.0, 60.0)) ** 2
    buffers = mass * (2.0 * np.pi * rng.uniform(1.5, 4.0)) ** 2 if rng.random() < 0.7 else 0.0
    return rated("bridge1").changed(
        mass=mass,
        height=height,
        spacing_x=along,
        spacing_y=across,
        inertia_roll=mass / 12.0 * (across**2 + depth**2),
        inertia_pitch=mass / 12.0 * (along**2 + depth**2),
        inertia_yaw=mass / 12.0 * (along**2 + across**2),
        pad_area=mass * GRAVITY / 4.0 / _PRESSURE,
        pad_stiffness=stiffness,
        pad_damping=2.0 * rng.uniform(0.03, 0.06) * np.sqrt(stiffness * 0.25 * mass),
        buffer_stiffness=buffers,
        buffer_place=0.3 * across,
    )


def specimen_toml(rig: Settings) -> str:
    """Write the rig as its laboratory would: what it knows, rounded, and not what the bench hides."""
    inertia = ", ".join(f'"{value:.4g} kg m^2"' for value in (rig.inertia_roll, rig.inertia_pitch, rig.inertia_yaw))
    radius = float(np.sqrt(rig.pad_area / np.pi))
    lines = [
        f'mass = "{rig.mass:.4g} kg"',
        f"inertia = [{inertia}]",
        f'centre_height = "{rig.height:.4g} m"',
        f'pad = {{ radius = "{radius:.5g} m", stiffness = "{rig.pad_stiffness:.3g} N/m" }}',
        *(
            f'pads.{pad} = {{ x = "{x * rig.spacing_x / 2:.5g} m", y = "{y * rig.spacing_y / 2:.5g} m" }}'
            for pad, x, y in zip(PADS, (1, -1, 1, -1), (1, 1, -1, -1), strict=True)
        ),
    ]
    if rig.buffer_stiffness:
        stiffness = f'stiffness = "{rig.buffer_stiffness / 2:.4g} N/m"'
        for number, side in (("1", 1.0), ("2", -1.0)):
            lines.append(f'buffers.{number} = {{ x = "0 m", y = "{side * rig.buffer_place:.5g} m", {stiffness} }}')
    return "\n".join(lines) + "\n"


def make_clean(folder: Path, seed: int) -> Settings:
    """Write a campaign of a drawn rig that lacks nothing, with its specimen.toml, and give the rig."""
    rngs = np.random.default_rng(seed).spawn(4)
    rig = draw_rig(rngs[0])
    motions: dict[str, Motion] = draw_motions("bridge1", rig, rngs[1], rich=False)
    runs = shake(rig, motions, 0.0)
    for _ in range(8):
        lowest = min(float(run[f"pad_{pad}_N"].min()) for run in runs.values() for pad in PADS)
        if lowest > _LEAST * rig.mass * GRAVITY / 4.0:
            break
        motions = {name: motion.scaled(0.8, 0.9) for name, motion in motions.items()}
        runs = shake(rig, motions, 0.0)
    logger = draw_logger(rngs[2], rich=False)
    heavier = {kind: rig.mass / _MASS if kind in ("load", "force") else 1.0 for kind in logger.noise}
    logger = replace(logger, noise={kind: level * heavier[kind] for kind, level in logger.noise.items()})
    recorded = {name: measure(run, USUAL, logger, (), rngs[3], i) for i, (name, run) in enumerate(runs.items())}
    write_campaign(folder, "specimen.toml", logger, recorded)
    (folder / "specimen.toml").write_text(specimen_toml(rig), encoding="utf-8")
    return rig
