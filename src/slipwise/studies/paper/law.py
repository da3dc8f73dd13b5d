"""Eqs. (1) to (8) on their own: limits, numbers, and the exact leftover of rocking in the sum of the pads."""

import numpy as np

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.simulation.predict import predictor
from slipwise.studies.paper.finding import FAILS, HOLDS, LIMITS, UNCHECKED, Finding, Study
from slipwise.studies.paper.settings import PaperSettings, paper_model

#: Faster than this [m/s] speed adds nothing more.
FAST = 1e3
PRESSURES = (1e-6, 2.0, 5.0, 10.0, 16.88, 25.0, 50.0)
SWINGS = (0.05, 0.1, 0.2, 0.3, 0.5, 0.6, 0.8, 1.0)


def mu(model: Model, pressure: Array | float, speed: Array | float) -> Array:
    """Return the coefficient of friction that the model's law carries at pressures [Pa] and speeds [m/s]."""
    pressure, speed = np.broadcast_arrays(np.asarray(pressure, dtype=float), np.asarray(speed, dtype=float))
    count = max(pressure.size, 2)  # a record needs two instants to have a step
    load = np.resize(pressure, count) * model.built_specimen().pad_area
    velocity = np.zeros((count, 4, 2))
    velocity[:, :, 0] = np.resize(speed, count)[:, None]
    time = np.arange(count, dtype=np.float64) * 1e-3
    bound = predictor(model).pads(time, np.repeat(load[:, None], 4, axis=1), velocity, np.zeros_like(velocity)).bound
    return (bound[:, 0] / load)[: pressure.size].reshape(pressure.shape)


def per_load(model: Model, pressure: Array, speed: float = FAST) -> Array:
    """Return dF/dN at pressures [Pa]: what a change of load does to friction [1]."""
    step = 1e-4 * pressure
    up, down = pressure + step, pressure - step
    return (mu(model, up, speed) * up - mu(model, down, speed) * down) / (2.0 * step)


def leftover(model: Model, swing: Array, speed: float = FAST) -> Array:
    """Return what rocking takes from the sum of the pads: pairs at P0 (1 +- swing) against P0, as a fraction [1]."""
    rated = model.built_specimen().rated_pressure
    light, heavy = rated * np.maximum(1.0 - swing, 1e-9), rated * (1.0 + swing)
    pair = 0.5 * (mu(model, light, speed) * light + mu(model, heavy, speed) * heavy)
    return 1.0 - pair / (mu(model, np.full_like(swing, rated), speed) * rated)


def vertical_loss(model: Model, accelerations: Array) -> Array:
    """Return the mean change of friction under a Gaussian vertical acceleration of these rms values [m/s^2] [1]."""
    specimen = model.built_specimen()
    nodes, weights = np.polynomial.hermite_e.hermegauss(40)
    out = []
    for rms in accelerations:
        pressure = specimen.rated_pressure * np.maximum(1.0 + rms * nodes / specimen.gravity, 1e-9)
        mean = float(np.sum(weights * mu(model, pressure, FAST) * pressure) / np.sum(weights))
        out.append(mean / float(mu(model, specimen.rated_pressure, FAST) * specimen.rated_pressure) - 1.0)
    return np.array(out)


def edge_slope(model: Model, *, p_delta: bool) -> float:
    """Return the edge slope of a pad's trapezoid while sliding fast [N/m].

    dF/dx = dF/dN dN/dx, dN/dx = K (h - z_b)/(2 b), and m g/(2 b) more with the weight moving over the pads (P-delta).
    """
    specimen = model.built_specimen()
    spacing = 2.0 * specimen.half_spacing[0]
    lever = specimen.centre_height - specimen.buffer_height
    swing = sum(specimen.buffer_stiffness) * lever / (2.0 * spacing)
    if p_delta:
        swing += specimen.weight / (2.0 * spacing)
    return float(per_load(model, np.array([specimen.rated_pressure]))[0]) * swing


def _within(error: float) -> str:
    return f"within {abs(error):.0e}" if error else "exactly"


def study(settings: PaperSettings) -> Study:
    """Check the law in its limits and say what it implies."""
    model = paper_model("bridge1", settings)
    values = {**model["contact_area"].values, **model["shear_rate"].values}
    s, n, k, alpha = (values[name] for name in ("strength", "rate", "saturation", "slow"))
    rng = np.random.default_rng([settings.seed, 8])
    pressure, speed = rng.uniform(0.1e6, 60e6, 400), rng.uniform(0.0, 1.0, 400)
    composed = s * (1.0 - np.exp(-n * speed)) * (1.0 - np.exp(-k * pressure)) / pressure + alpha
    error = float(np.abs(mu(model, pressure, speed) / composed - 1.0).max())
    light = float(mu(model, 1.0, FAST) / (s * k * (1.0 - 0.5 * k) + alpha) - 1.0)
    heavy = float(mu(model, 2e9, FAST) / (alpha + s / 2e9) - 1.0)
    rated = model.specimen.rated_pressure
    swings = np.array(SWINGS)
    left = leftover(model, swings)
    falls = float(mu(model, 5e6, FAST) / mu(model, 25e6, FAST))
    findings = (
        Finding(
            "Eqs. (1) to (8)",
            "Friction is shear strength times real contact area; both depend on pressure, the strength on speed.",
            f"limits exact within {max(error, abs(heavy), abs(light)):.0e}",
            f"The two effects composed give eq. (8) within {error:.0e}. Small pressure: Coulomb's law with s'k + "
            "alpha, "
            f"within {abs(light):.0e}; large pressure: s' A + alpha N, {_within(heavy)}; at rest alpha.",
            HOLDS if max(error, abs(heavy), abs(light)) < 1e-12 else FAILS,
            "The limit for small pressure is approached as kP/2, which is taken off here.",
            ("n_unit",),
            {"composed": error, "small_pressure": light, "large_pressure": heavy},
        ),
        Finding(
            "Eq. (7)",
            "The second bracket is printed with exp(-kV).",
            "a misprint: exp(-kP)",
            f"With exp(-kP), as eqs. (3), (6) and (8) need, friction falls {falls:.2f} times from 5 to 25 MPa; as "
            "printed it "
            "would not depend on pressure at all.",
            FAILS,
            "A misprint: k has the unit of 1/pressure. exp(-kP) is used everywhere here.",
        ),
        Finding(
            "Friction of PTFE",
            "Friction grows with speed up to a point and then stays or falls a little; it falls with pressure.",
            f"mu {float(mu(model, rated, 0.0)):.3f} at rest, {float(mu(model, rated, FAST)):.4f} fast",
            f"mu at the rated pressure grows from {float(mu(model, rated, 0.0)):.3f} to "
            f"{float(mu(model, rated, FAST)):.4f}, "
            f"95 % of the way at {3.0 / n * 100:.0f} cm/s, and falls with pressure at every speed.",
            LIMITS,
            "Eq. (7) cannot fall again at high speed, knows neither temperature nor roughness, and has no peak at "
            "breakaway.",
            ("n_unit",),
            {"slow": float(mu(model, rated, 0.0)), "fast": float(mu(model, rated, FAST))},
        ),
        Finding(
            "Four parameters",
            "s', n, k, alpha = 1.379, 0.197, 0.102, 0.046; units are not stated.",
            f"MPa, {settings.n_unit}, 1/MPa taken",
            f"MPa, {settings.n_unit}, 1/MPa and 1: mu = {float(mu(model, rated, FAST)):.4f} fast, {alpha:.3f} slow; "
            f"dF/dN = {float(per_load(model, np.array([rated]))[0]):.4f}, so load moves friction by "
            f"{float(per_load(model, np.array([rated]))[0] / mu(model, rated, FAST)):.0%} of what Coulomb's law would.",
            UNCHECKED,
            "MPa and 1/MPa are certain by size; s/cm is likely (s/mm and s/in are settings).",
            ("n_unit",),
        ),
    )  # fmt: skip
    pressures = np.array(PRESSURES) * 1e6
    tables = {
        "mu and dF/dN at high speed": [
            {"P [MPa]": f"{p / 1e6:.2f}", "mu": f"{m:.4f}", "dF/dN": f"{d:.4f}"}
            for p, m, d in zip(pressures, mu(model, pressures, FAST), per_load(model, pressures), strict=True)
        ],
        "What rocking leaves in the sum of the pads": [
            {"swing of load": f"{a:.0%}", "lost": f"{b:.2%}"} for a, b in zip(swings, left, strict=True)
        ],
    }
    grid = np.linspace(0.5e6, 40e6, 80)
    curves = {
        "pressure": grid,
        "mu": {f"{v * 100:g} cm/s": mu(model, grid, v) for v in (0.0, 0.01, 0.05, 0.1, 1.0)},
        "swing": np.linspace(0.0, 1.0, 41),
        "leftover": leftover(model, np.linspace(0.0, 1.0, 41)),
        "rated": rated,
    }
    return Study("law", "The friction law (eqs. 1 to 8)", findings, tables, curves)
