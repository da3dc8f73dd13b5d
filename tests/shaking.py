"""Table motions and readings that several physics tests share."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.model import Model, base_model
from slipwise.simulation.simulator import Replay, simulate

G = 9.80665
#: Eq. (8) at the rated pressure and high speed.
FAST = 0.113085
SHARED = Path(__file__).parents[2] / "shared"


def needs_shared(*parts: str) -> Path:
    """Give a path under ../shared, or skip the test and say so."""
    path = SHARED.joinpath(*parts)
    if not path.exists():
        pytest.skip(f"needs ../shared/{'/'.join(parts)}, which is not here")
    return path


def sine(
    frequency: float, amplitude: float, seconds: float, dt: float = 5e-4, vertical: tuple[float, float] = (0.0, 0.0)
):
    """Table acceleration (n, 3): a sine along x [m/s^2] that ramps in over four cycles, and one along z."""
    t = np.arange(round(seconds / dt)) * dt
    ramp = np.clip(t * frequency / 4.0, 0.0, 1.0)
    out = np.zeros((len(t), 3))
    out[:, 0] = amplitude * ramp * np.sin(2 * np.pi * frequency * t)
    out[:, 2] = vertical[1] * np.clip(t * max(vertical[0], 1.0) / 4.0, 0.0, 1.0) * np.sin(2 * np.pi * vertical[0] * t)
    return out


def coulomb(rig: str, mu: float = FAST, **changes: object) -> Model:
    """A rig with Coulomb friction of a given coefficient."""
    model = base_model(rig, ())
    strength = model.specimen.plastic_pressure * mu
    return replace(model, specimen=replace(model.specimen, shear_strength=strength, **changes))


def shaken(model: Model, acceleration: np.ndarray, **settings: object) -> Replay:
    """Shake with the record at every step."""
    dt = settings.pop("dt", 5e-4)
    return simulate(model, acceleration, dt=dt, output_dt=settings.pop("output_dt", dt), **settings)


def last_cycles(replay: Replay, frequency: float, cycles: int = 4) -> np.ndarray:
    """Mask of the last full cycles of a record."""
    time = replay.record.time
    return time > time[-1] - cycles / frequency


def half_range(values: np.ndarray) -> float:
    return float(np.ptp(values) / 2.0)
