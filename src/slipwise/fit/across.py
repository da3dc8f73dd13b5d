"""Friction across the girder, where pads have gauges for it and the girder moves that way too.

    F_y = F_b v_y / |v| + what effects add

Where a pad is slow the direction of its velocity is noise, so only fast samples are held against the law.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.fit.data import FINE, FitRun
from slipwise.fit.pads import Instants, as_logged
from slipwise.predict import PadForces
from slipwise.signals import LowPass

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: Slower pads point nowhere [m/s].
_FAST = 0.01


def fast(run: FitRun) -> Mask:
    """Tell at which samples the direction of slip is known, (n, 1)."""
    return (run.sliding & (np.hypot(*run.states.velocity.T) > _FAST))[:, None]


def logged_across(run: FitRun, said: PadForces, by: LowPass | None) -> Array:
    """Give the pads' forces along y as the logger would have written them, (n, p) [N]."""
    return as_logged(said.force[:, :, 1], run, by, averaged=False)


def noise_across(run: FitRun, state: Instants, said: PadForces) -> Array:
    """Give the noise of measured less predicted force along y (n, p) [N]: gauges, loads, direction of slip."""
    gauge = np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])
    loads = np.array([run.noise.get(f"pad_{p}_N", 0.0) for p in run.pads])
    friction = np.abs(said.force[::FINE, :, 1]) / np.maximum(run.load, 0.05 * run.load.mean())
    speed = np.maximum(np.hypot(*np.moveaxis(state.velocity[::FINE], 2, 0)), _FAST)
    turned = said.bound[::FINE] * max(run.states.velocity_error) / speed
    return np.sqrt(gauge**2 + (0.6 * friction * loads) ** 2 + turned**2)
