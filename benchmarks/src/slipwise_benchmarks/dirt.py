"""Dirt: the small imperfections that every laboratory has at once, by the catalogue's names.

Each function takes a generator, a scale (1: usual; 0.2 to 5) and the base settings. Those of the rig give changed
settings, those of gauges give faults.
"""

from typing import Any

import numpy as np

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.gauges import NOISE, RICH, sensor
from slipwise_benchmarks.settings import PADS, Settings

_FORCES = tuple(f"pad_{pad}_Fx" for pad in PADS)
_LOADS = tuple(f"pad_{pad}_N" for pad in PADS)
#: Channels that share a card of the logger.
CARDS: tuple[tuple[str, ...], ...] = (("slip_x",), ("girder_ax", "girder_az"), _FORCES, _LOADS)
#: What a gauge's zero is off by, usually, in sensor noises [1].
_ZERO = 0.7


def _sign(rng: np.random.Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))


def pad_spread(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """Each pad's friction is some tenths of a per cent off; what all share is the base's."""
    spread = rng.normal(size=4)
    spread -= spread.mean()
    return {"pad_factor": tuple(1.0 + 0.005 * scale * spread / spread.std())}


def uneven_seating(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """Pads stand about a micrometre higher or lower than their neighbours."""
    higher = _sign(rng) * 1.0e-6 * scale
    return {"seating": (higher, -higher, -higher, higher)}


def mass_eccentricity(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """The weights do not stand quite in the middle: by millimetres."""
    angle = rng.uniform(0.0, 2.0 * np.pi)
    return {"centre_x": 2.0e-3 * scale * np.cos(angle), "centre_y": 2.0e-3 * scale * np.sin(angle)}


def slide_tilt(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """The plates are out of level by tenths of a millimetre in a metre."""
    return {"tilt": _sign(rng) * 2.0e-4 * scale}


def direction_asymmetry(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """The sheet has a lay: friction differs a little between to and fro."""
    return {"asymmetry": _sign(rng) * 2.0e-3 * scale}


def buffer_mismatch(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """Two buffers are never quite alike."""
    return {"mismatch": _sign(rng) * 0.01 * scale}


def buffer_damping(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """Rubber damps: a tenth of a per cent of critical beside what it should."""
    damping = 2.0 * 0.001 * scale * np.sqrt(base.buffer_stiffness * base.mass)
    return {"buffer_damping_form": 1, "buffer_damping": damping}


def table_pitch(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """The table tips by some thousandths of a degree per g."""
    per = _sign(rng) * np.radians(0.003 * scale) / 9.81
    form = int(rng.integers(1, 3))
    return {"pitch_form": form, "pitch_per_acceleration": per, "pitch_frequency": rng.uniform(10.0, 20.0)}


def girder_bending(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """A stiff girder bends too: a per cent of its mass in a mode of 15 to 30 Hz."""
    change = {"bending_mass": 0.01 * scale * base.mass, "bending_frequency": rng.uniform(15.0, 30.0)}
    return {**change, "bending_damping": rng.uniform(0.01, 0.03)}


def channel_gain(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Every gauge is calibrated to some tenths of a per cent."""
    return [Fault("channel_gain", (name,), 2.0e-3 * scale * rng.normal()) for name in RICH if name[:5] != "table"]


def channel_offset(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Every cell and the slip gauge has a zero that is a little off."""
    names = [name for name in RICH if name.startswith(("pad_", "slip_"))]
    return [Fault("channel_offset", (name,), _ZERO * NOISE[sensor(name)] * scale * rng.normal()) for name in names]


def channel_drift(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Two gauges that warm up."""
    names = rng.choice([*_FORCES, *_LOADS, "slip_x"], size=2, replace=False)
    sizes = [_sign(rng) * 0.1 * NOISE[sensor(str(name))] * scale for name in names]
    return [Fault("channel_drift", (str(n),), s, "linear") for n, s in zip(names, sizes, strict=True)]


def load_crosstalk(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Each friction cell feels some hundredths of a per cent of its load."""
    form = "zeroed at rest" if rng.random() < 0.5 else "not zeroed"
    return [Fault("load_crosstalk", (name,), 5.0e-4 * scale * rng.normal(), form) for name in _FORCES]


def channel_delay(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Cards of one logger sample one after the other, some hundredths of a millisecond apart."""
    return [Fault("channel_delay", card, 5.0e-5 * scale * rng.uniform(-1.0, 1.0)) for card in CARDS]


def channel_filter(rng: np.random.Generator, scale: float) -> list[Fault]:
    """One card's amplifiers are slower than the others'."""
    card = CARDS[rng.integers(len(CARDS))]
    return [Fault("channel_filter", card, float(np.clip(1500.0 / scale, 60.0, 2400.0)), "first order")]


def cell_inertia(rng: np.random.Generator, scale: float) -> list[Fault]:
    """A plate of some kilograms between pad and cell."""
    return [Fault("cell_inertia", (*_FORCES, *_LOADS), 1.5 * scale, "subtracted")]


#: effect -> how often a laboratory has it [1], and its law.
RIG_DIRT = {
    "pad_spread": (1.0, pad_spread),
    "uneven_seating": (0.9, uneven_seating),
    "mass_eccentricity": (0.9, mass_eccentricity),
    "slide_tilt": (0.8, slide_tilt),
    "direction_asymmetry": (0.2, direction_asymmetry),
    "buffer_mismatch": (0.8, buffer_mismatch),
    "buffer_damping": (0.7, buffer_damping),
    "table_pitch": (0.7, table_pitch),
    "girder_bending": (0.4, girder_bending),
}
GAUGE_DIRT = {
    "channel_gain": (1.0, channel_gain),
    "channel_offset": (0.9, channel_offset),
    "channel_drift": (0.4, channel_drift),
    "load_crosstalk": (0.8, load_crosstalk),
    "channel_delay": (0.7, channel_delay),
    "channel_filter": (0.25, channel_filter),
    "cell_inertia": (0.3, cell_inertia),
}
