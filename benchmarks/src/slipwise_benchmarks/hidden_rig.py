"""Hidden effects of buffers, key, girder and table, and effects outside the catalogue."""

import numpy as np

from slipwise_benchmarks.hidden_pad import Change, _sign
from slipwise_benchmarks.settings import Settings


def buffer_damping(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """1 to 8 % of critical damping in the rubber."""
    form = int(rng.integers(1, 3))
    damping = 2.0 * 0.03 * scale * np.sqrt(base.buffer_stiffness * base.mass)
    return {"buffer_damping_form": form, "buffer_damping": damping}, ("linear", "power 0.6 of speed")[form - 1]


def buffer_hysteresis(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """A loop of 0.5 to 3 kN that does not depend on speed."""
    form = int(rng.integers(1, 3))
    change = {
        "hysteresis_form": form,
        "hysteresis_force": 1.3e3 * scale * base.size,
        "hysteresis_length": rng.uniform(1.0e-3, 5.0e-3),
    }
    return change, ("Bouc-Wen, exponent 1", "Bouc-Wen, exponent 2")[form - 1]


def buffer_hardening(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Stiffer by 5 to 35 % at 20 mm."""
    return {"hardening": 0.14 * scale, "hardening_power": rng.choice([1.0, 2.0, 3.0, 4.0])}, "power of the excursion"


def buffer_softening(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Mullins: stiffer until the rubber has been stretched; its memory outlives the rest between runs."""
    form = int(rng.integers(1, 3))
    change = {
        "softening_form": form,
        "softening": min(0.2 * scale, 0.45),
        "softening_length": rng.uniform(5.0e-3, 1.5e-2),
    }
    return change, ("exponential in the largest excursion", "linear in the largest excursion")[form - 1]


def buffer_mismatch(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Buffers of unlike stiffness: the girder yaws."""
    return {"mismatch": _sign(rng) * min(0.1 * scale, 0.3)}, "constant"


def buffer_height(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """The key passes its force above the sliding plane."""
    return {"buffer_height": min(0.12 * scale * base.length, 0.8 * base.height)}, "constant"


def key_clearance(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """The key has play of 0.2 to 1.5 mm either side, with or without damping as it closes."""
    impact = rng.uniform(2.0e5, 8.0e5) * base.size if rng.random() < 0.5 else 0.0
    return {"clearance": 6.0e-4 * scale, "key_impact": impact}, "gap with impact" if impact else "gap alone"


def key_friction(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Steel on steel in the key carries vertical force up to 0.05 to 0.3 of the buffer's."""
    form = int(rng.integers(1, 3))
    length = 2.0e-4 if form == 1 else rng.uniform(2.0e-6, 6.0e-6)
    change = {"key_form": form, "key_friction": min(0.12 * scale, 0.35), "key_scale": length}
    return change, ("smooth in speed", "elastic-plastic")[form - 1]


def girder_bending(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """First vertical mode between 7 and 24 Hz with 5 to 60 % of the mass; a few gauges sit at midspan."""
    midspan = 4.0 / np.pi if rng.random() < 0.2 else 0.0
    change = {
        "bending_mass": min(0.2 * scale, 0.7) * base.mass,
        "bending_frequency": rng.uniform(7.0, 24.0),
        "bending_damping": rng.uniform(0.008, 0.03),
        "bending_gauge": midspan,
    }
    return change, "gauge at midspan" if midspan else "gauge at the supports"


def guide_drag(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """A guide that drags with speed on the girder's side, at the height of its centre of gravity."""
    form = int(rng.integers(1, 3))
    return {"drag_form": form, "drag": 5.0e3 * scale * base.size}, ("linear", "quadratic in speed")[form - 1]


def table_pitch(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """The table tips by about 0.02 to 0.15 degrees per g, with its own or with the girder's acceleration."""
    form = int(rng.integers(1, 3))
    per = _sign(rng) * np.radians(0.06 * scale) / 9.81
    change = {"pitch_form": form, "pitch_per_acceleration": per, "pitch_frequency": rng.uniform(10.0, 20.0)}
    return change, ("follows the table's acceleration", "follows the girder's acceleration")[form - 1]


RIG_EFFECTS = {
    "buffer_damping": buffer_damping,
    "buffer_hysteresis": buffer_hysteresis,
    "buffer_hardening": buffer_hardening,
    "buffer_softening": buffer_softening,
    "buffer_mismatch": buffer_mismatch,
    "buffer_height": buffer_height,
    "key_clearance": key_clearance,
    "key_friction": key_friction,
    "girder_bending": girder_bending,
    "guide_drag": guide_drag,
    "table_pitch": table_pitch,
}


def superstructure(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Columns of another stiffness than rated, by 6 to 40 %, in all storeys."""
    factor = 1.0 + _sign(rng) * min(0.15 * scale, 0.4)
    storeys = tuple(floor._replace(stiffness=factor * floor.stiffness) for floor in base.storeys)
    return {"storeys": storeys}, "stiffness of all columns"


#: Effects of rigs that carry a frame.
FRAME_EFFECTS = {"superstructure": superstructure}

#: kind -> (form, typical size, lowest and highest scale, lowest and highest place)
UNKNOWN_KINDS: dict[str, tuple[int, float, tuple[float, float], tuple[float, float]]] = {
    "washboard": (1, 0.12, (3.0e-3, 9.0e-3), (0.0, 6.0)),
    "acceleration_friction": (2, 0.012, (2.0, 5.0), (0.0, 0.0)),
    "clock_friction": (3, 0.10, (1.5, 4.0), (0.0, 0.0)),
    "load_rate_friction": (4, 0.10, (1.5e5, 4.0e5), (0.0, 0.0)),
    "cubic_drag": (5, 0.030, (0.25, 0.4), (0.0, 0.0)),
    "away_from_centre": (6, 0.09, (2.0e-3, 5.0e-3), (0.0, 0.0)),
    "swinging_mass": (7, 600.0, (4.0, 8.0), (0.0, 0.0)),
    "rubbing_bar": (8, 2.5e3, (5.0e-3, 2.0e-2), (-1.0e-2, 1.0e-2)),
    "late_contact_area": (9, 1.0, (0.0, 0.0), (0.012, 0.018)),
}


def unknown(kind: str, rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """One of `UNKNOWN_KINDS`: laws that no catalogue has."""
    form, typical, widths, places = UNKNOWN_KINDS[kind]
    size, place = typical * scale, rng.uniform(*places)
    width = rng.uniform(*widths)
    if kind == "late_contact_area":
        size, place = 1.0, place * scale
    elif kind == "swinging_mass":
        size = min(size, 1.5e3) * base.size
    elif kind == "rubbing_bar":
        size *= base.size
    elif kind == "load_rate_friction":
        width *= base.pad_size
    change = {"unknown_form": form, "unknown_size": size, "unknown_scale": width, "unknown_place": place}
    return change, kind
