"""How far measured and predicted friction may differ by noise alone, and noise that is not white brought to white."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d

from slipwise.relations.evaluation_times import Instants
from slipwise.relations.run_data import FAST, FitRun
from slipwise.signals.ends import in_frequency
from slipwise.simulation.predict import PadForces

Array = NDArray[np.float64]
#: Uncertainty of the timing of a reversal: shear of pad and cell, cards of the logger [s].
TIMING = 1e-4
#: Periods of the logger's filter over which it spreads what it makes of a reversal, before and after [1].
_SPREAD = 0.5


def reversal_noise(run: FitRun, plain: Array, shifted: Array) -> Array:
    """Return the uncertainty of friction where pads reverse (n, p) [N]: errors of velocity and timing.

    Args:
        run: its step and filter.
        plain: (n, p) predicted by the law [N].
        shifted: (n, p) predicted with velocities that are wrong by as much as they may be [N].
    """
    timing = np.hypot(TIMING * run.scales.time, run.unseen / np.sqrt(12.0))
    squared = (shifted - plain) ** 2 + (timing * np.gradient(plain, run.dt, axis=0)) ** 2
    if run.filtered is not None:
        reach = int(np.ceil(_SPREAD / (run.filtered.frequency * run.dt)))
        # a few newtons beside a reversal, the same at every reversal, are below one sample's noise but bend the fit
        squared = maximum_filter1d(squared, 2 * reach + 1, axis=0)
    return np.sqrt(squared)


def pad_noise(run: FitRun, plain: Array, reversal: Array) -> Array:
    """Return the noise of measured less predicted friction (n, p) [N]: of gauges, loads and reversals.

    Args:
        run: its gauges.
        plain: (n, p) predicted by the law [N].
        reversal: (n, p) of `reversal_noise` [N].
    """
    gauge, loads = run.gauge_noise
    friction = np.abs(plain) / np.maximum(run.load, 0.05 * run.load.mean())
    return np.sqrt(np.maximum(gauge**2 + (0.6 * friction * loads) ** 2 + reversal**2, 1e-24))


def noise_across(run: FitRun, state: Instants, law_forces: PadForces) -> Array:
    """Return the noise of measured less predicted force along y (n, p) [N]: gauges, loads, direction, timing."""
    gauge = np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])
    loads = run.gauge_noise[1]
    force = law_forces.force[:: run.fine, :, 1]
    friction = np.abs(force) / np.maximum(run.load, 0.05 * run.load.mean())
    speed = np.maximum(np.hypot(*np.moveaxis(state.velocity[:: run.fine], 2, 0)), FAST * run.scales.speed)
    direction = law_forces.bound[:: run.fine] * run.states.pad_velocity_error.max() / speed
    timing = TIMING * run.scales.time * np.gradient(force, run.dt, axis=0)
    return np.sqrt(gauge**2 + (0.6 * friction * loads) ** 2 + direction**2 + timing**2)


def whitened(left: Array, run: FitRun, level: float, ringing: Array, driven: Array | None = None) -> Array:
    """Bring the residual (n,) of a balance to white noise of its gauges' own level, at every frequency.

    Args:
        left: measured less predicted [N].
        run: its times.
        level: noise of the gauges themselves [N].
        ringing: (m,) spectrum of what rings with gauges' noise in it, fixed when the fit was weighed [N^2].
        driven: (m,) spectrum of noise that a hypothesis adds, which masks what was there before [N^2].
    """
    before = 1.0 / (1.0 + ringing / level**2)
    now = before if driven is None else 1.0 / (1.0 + (ringing + driven) / level**2)
    frequency = np.fft.rfftfreq(len(left), run.dt)
    white = in_frequency(left, run.dt, lambda f: np.sqrt(np.interp(f, frequency, now)), 256)
    return white if driven is None else with_masked_noise(white, float(1.0 - np.mean(now / before)))


def with_masked_noise(part: Array, masked: float) -> Array:
    """Count noise that an effect masks as if it were still there: the sum of squares grows by it, each sample alike.

    Noise that it adds is taken out in the same way, as far as there is any.

    Put on every sample by itself it would make residuals jump as they change sign, and slopes of that are noise.
    """
    total = float(part @ part)
    if total == 0.0:
        return part
    return part * np.sqrt(max(1.0 + masked * np.count_nonzero(part) / total, 0.0))
