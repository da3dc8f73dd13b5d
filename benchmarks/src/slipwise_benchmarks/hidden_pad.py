"""Hidden effects of pad friction and pad load: random laws and sizes round those typical of the rig.

Each function takes a generator, a scale (about 0.4 small, 1 medium, 2.5 large) and the base settings, and gives the
changed settings and the law's form in words.
"""

from typing import Any

import numpy as np
from scipy.linalg import null_space

from slipwise_benchmarks.settings import GRAVITY, Settings, pads_of

Change = tuple[dict[str, Any], str]


def _sign(rng: np.random.Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))


def breakaway(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Static excess of 0.01 to 0.06 over 4 to 20 mm/s; one form grows with the contact's age."""
    form = int(rng.integers(1, 4))
    change = {
        "breakaway_form": form,
        "breakaway": 0.024 * scale,
        "breakaway_speed": np.exp(rng.uniform(np.log(0.004), np.log(0.02))),
        "breakaway_ageing": rng.uniform(0.1, 0.3),
        "age_length": rng.uniform(5.0e-5, 5.0e-4),
    }
    return change, ("Gaussian in speed", "exponential in speed", "Gaussian with ageing")[form - 1]


def presliding(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Friction builds up over 0.05 to 0.4 mm."""
    form = int(rng.integers(1, 4))
    change = {"presliding_form": form, "presliding_length": 1.5e-4 * scale}
    return change, ("Dahl", "elastic-plastic, filled length", "elastic-plastic, constant stiffness")[form - 1]


def heating(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Friction falls with frictional work: about 20 % at the end of a run."""
    if rng.random() < 0.5:
        return {"heat_form": 1, "heat": 0.18 * scale, "heat_time": rng.uniform(3.0, 25.0)}, "first order in work"
    return {"heat_form": 2, "heat": 0.8 * scale}, "half-space kernel, Kumar's factor"


def run_in(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Friction settles with slid distance, from above (run-in) or from below (film that wears off)."""
    form = int(rng.integers(1, 3))
    change = {"wear_form": form, "wear": _sign(rng) * min(0.14 * scale, 0.5), "wear_length": rng.uniform(0.15, 1.2)}
    return change, ("exponential in distance", "hyperbolic in distance")[form - 1]


def rate_and_state(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Logarithmic direct and evolution effects of 0.003 to 0.015."""
    form = int(rng.integers(1, 3))
    direct = 0.006 * scale
    change = {
        "rate_form": form,
        "rate_direct": direct,
        "rate_evolution": direct * rng.uniform(0.3, 1.4),
        "age_length": np.exp(rng.uniform(np.log(3.0e-5), np.log(1.0e-3))),
    }
    return change, ("ageing law", "slip law")[form - 1]


def pressure_law(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Another dependence on pressure than (1 - exp(-k P)); part of it hides in k and alpha."""
    form = int(rng.integers(1, 4))
    typical = (0.2, 0.4, 0.2)[form - 1]
    return {"pressure_form": form, "pressure_size": _sign(rng) * typical * scale}, ("power", "quadratic", "tanh")[
        form - 1
    ]


def direction_asymmetry(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Friction towards +x differs from that towards -x by 2 c."""
    return {"asymmetry": _sign(rng) * 0.03 * scale}, "constant ratio"


def anisotropy(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Friction across differs from that along x: needs motion in y."""
    return {"anisotropy": 0.12 * scale * _sign(rng)}, "ellipse of forces along v"


def position_patch(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Another friction where a pad stands on a certain place of its plate; on one pad or on all."""
    form = int(rng.integers(1, 4))
    pads = len(pads_of(base))
    which = np.ones(pads) if rng.random() < 0.4 else np.eye(pads)[rng.integers(pads)]
    change = {
        "patch_form": form,
        "patch": tuple(_sign(rng) * min(0.12 * scale, 0.5) * which),
        "patch_place": rng.uniform(-8.0e-3, 8.0e-3),
        "patch_width": rng.uniform(2.5e-3, 6.0e-3),
    }
    return change, ("Gaussian", "raised cosine", "plateau")[form - 1]


def pad_spread(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Pads of unlike friction, the same on average."""
    spread = rng.normal(size=len(pads_of(base)))
    spread -= spread.mean()
    return {"pad_factor": tuple(1.0 + 0.05 * scale * spread / spread.std())}, "factor on each pad"


def slide_tilt(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Sliding plane out of level: a force N beta, the same in both directions."""
    return {"tilt": _sign(rng) * 0.0025 * scale}, "constant slope"


def slide_curvature(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Plates that are dished, or spheres of another radius than rated, by 5 to 30 %."""
    rated = max((pad.curvature for pad in pads_of(base)), default=0.0)
    typical = 0.12 * rated if rated else 0.2
    return {"curvature": typical * scale * _sign(rng)}, "constant radius"


def uneven_seating(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Pads that do not stand in one plane: warps of the loads of 3 to 20 % of the rest load."""
    higher = _sign(rng) * min(0.08 * scale, 0.25) * 0.25 * base.mass * GRAVITY / base.pad_stiffness
    if not base.pads:
        return {"seating": (higher, -higher, -higher, higher)}, "one diagonal higher"
    places = [(1.0, pad.x, pad.y) for pad in base.pads]
    warps = null_space(np.array(places).T)
    heights = warps @ rng.normal(size=warps.shape[1])
    sag = 4.0 * higher / len(base.pads)
    return {"seating": tuple(sag * heights / np.abs(heights).max())}, "out of any plane"


def mass_eccentricity(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Centre of gravity off its place by 1 to 8 cm in 3 m, in x, y or both."""
    angle = rng.uniform(0.0, 2.0 * np.pi)
    off = 0.03 * scale * base.length
    x, y = base.centre_x + off * np.cos(angle), base.centre_y + off * np.sin(angle)
    return {"centre_x": x, "centre_y": y}, "constant"


PAD_EFFECTS = {
    "breakaway": breakaway,
    "presliding": presliding,
    "heating": heating,
    "run_in": run_in,
    "rate_and_state": rate_and_state,
    "pressure_law": pressure_law,
    "direction_asymmetry": direction_asymmetry,
    "anisotropy": anisotropy,
    "position_patch": position_patch,
    "pad_spread": pad_spread,
    "slide_tilt": slide_tilt,
    "slide_curvature": slide_curvature,
    "uneven_seating": uneven_seating,
    "mass_eccentricity": mass_eccentricity,
}
