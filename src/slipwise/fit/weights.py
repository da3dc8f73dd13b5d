"""How far measured and predicted may differ by noise alone, relation by relation."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from slipwise.fit.balances import heave_noise, pitch_noise
from slipwise.fit.data import FAST, FINE, FitRun
from slipwise.fit.pads import Instants
from slipwise.model import Model
from slipwise.predict import PadForces
from slipwise.rig import Specimen
from slipwise.signals.ends import in_frequency

Array = NDArray[np.float64]
#: Timing of a reversal that nobody can vouch for: shear of pad and cell, cards of the logger [s].
_TIMING = 1e-4


def pad_noise(run: FitRun, plain: Array, shifted: Array) -> Array:
    """Give the noise of measured less predicted friction (n, p) [N]: of gauges, loads, velocity and timing.

    Args:
        run: its gauges.
        plain: (n, p) what the law says [N].
        shifted: (n, p) what it says of velocities that err by as much as they may [N].
    """
    gauge, loads = _gauges(run)
    friction = np.abs(plain) / np.maximum(run.load, 0.05 * run.load.mean())
    spread = gauge**2 + (0.6 * friction * loads) ** 2 + (shifted - plain) ** 2
    spread = spread + (_TIMING * np.gradient(plain, run.dt, axis=0)) ** 2
    return np.sqrt(np.maximum(spread, 1e-24))


def noise_across(run: FitRun, state: Instants, said: PadForces) -> Array:
    """Give the noise of measured less predicted force along y (n, p) [N]: gauges, loads, direction, timing."""
    gauge = np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])
    loads = _gauges(run)[1]
    force = said.force[::FINE, :, 1]
    friction = np.abs(force) / np.maximum(run.load, 0.05 * run.load.mean())
    speed = np.maximum(np.hypot(*np.moveaxis(state.velocity[::FINE], 2, 0)), FAST)
    turned = said.bound[::FINE] * run.states.pad_velocity_error.max() / speed
    late = _TIMING * np.gradient(force, run.dt, axis=0)
    return np.sqrt(gauge**2 + (0.6 * friction * loads) ** 2 + turned**2 + late**2)


def balance_noise(specimen: Specimen, run: FitRun) -> dict[str, float]:
    """Give the noise of every balance of a girder, in its own unit."""
    gauge, loads = _gauges(run)
    total, force = float(np.sqrt(np.sum(loads**2))), float(np.sqrt(np.sum(gauge**2)))
    stiffness = sum(specimen.buffer_stiffness)
    beside = np.hypot(force, stiffness * 0.1 * run.noise["slip_x"]) / specimen.mass
    lever = specimen.centre_height / specimen.half_spacing[0] if len(specimen.pads) == 4 else 0.0
    levels = {
        "girder": np.hypot(run.noise.get("girder_ax", 0.0), beside),
        "heave": np.hypot(total, specimen.mass * run.noise.get("girder_az", 0.0)),
        "pitch": np.hypot(total, lever * force),
        "roll": total,
        "warp": total,
        "motion": 1.0,
    }
    return {name: max(float(level), 1e-12) for name, level in levels.items()}


def _gauges(run: FitRun) -> tuple[Array, Array]:
    """Give the noise of the pads' gauges of friction and load, (p,) each [N]."""
    gauge = np.array([run.noise[f"pad_{p}_Fx"] for p in run.pads])
    return gauge, np.array([run.noise.get(f"pad_{p}_N", 0.0) for p in run.pads])


def heave_scale(model: Model, run: FitRun) -> float:
    """Give by how much effects change the noise of the heave balance from what it was weighed with [1]."""
    factor = heave_noise(model, run)
    if factor == 1.0:
        return 1.0
    loads = float(np.linalg.norm(_gauges(run)[1]))
    vertical = model.specimen.mass * run.noise.get("girder_az", 0.0)
    return float(np.hypot(loads, factor * vertical) / np.hypot(loads, vertical))


def pitch_whitened(left: Array, model: Model, run: FitRun, level: float, values: Mapping[str, float]) -> Array:
    """Bring the pitch residual (n,) to the noise it was weighed with, at every frequency.

    Args:
        left: measured less predicted [N].
        model: whose effects may add noise of accelerometers.
        run: its gauges.
        level: noise of the balance by its load cells [N].
        values: of the fit.
    """
    frequency, power = pitch_noise(model, run, values)
    gain = 1.0 / np.sqrt(1.0 + power / level**2)
    white = in_frequency(left, run.dt, lambda f: np.interp(f, frequency, gain), 256)
    return with_hidden(white, float(1.0 - np.mean(gain**2)))


def with_hidden(part: Array, hidden: float) -> Array:
    """Count noise that an effect hides as if it were still there: the sum of squares grows by it, each sample alike.

    Put on every sample by itself it would make residuals jump as they change sign, and slopes of that are noise.
    """
    total = float(part @ part)
    return part * np.sqrt(1.0 + hidden * np.count_nonzero(part) / total) if total > 0.0 else part
