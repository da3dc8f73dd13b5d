"""What nobody recorded between two samples: when, within a step, friction jumped that no logger had smoothed.

Friction turns round within a fraction of a millisecond. A record without an anti-aliasing filter shows a jump J from
one sample to the next, and not at which instant u of the step it was; the girder's pitch rings with it by J S(t - u),
where S is its answer to a step. The balance takes the jump to be as smooth as the sampling allows, and errs by

    e(t)^2 = J^2  mean over u of (S(t - u) - S_sampled(t))^2

Source: aliasing, Oppenheim, Schafer, Discrete-Time Signal Processing; step answer of a base-excited oscillator, Harris'
Shock and Vibration Handbook.
"""

import numpy as np
from scipy.signal import fftconvolve

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun
from slipwise.rig import Specimen
from slipwise.rig.storeys import frame_modes
from slipwise.signals.pitch import pass_through_pitch
from slipwise.signals.sampled_jumps import squared_jumps

#: Instants of a step at which a jump may be.
_INSTANTS = 32
#: Samples on either side of a jump over which its sampled answer is followed beside its ringing.
_BESIDE = 24


def compute_jump_noise_in_pitch(specimen: Specimen, run: FitRun, frequency: float, damping: float) -> Array:
    """Return the error of the predicted pitch load for lack of the instants at which friction jumped (n,) [N].

    Args:
        specimen: with the lever of friction in pitch.
        run: whose pads' forces were sampled without a filter.
        frequency: of the girder's pitch on its pads [Hz].
        damping: its fraction of critical [1].
    """
    noise = float(np.linalg.norm(run.gauge_noise[0]))
    squared = np.append(squared_jumps(run.force.sum(axis=1), noise), 0.0)
    lever = specimen.centre_height / specimen.half_spacing[0]
    missed = locate_missed_instant(run.dt, frequency, damping)
    return lever * np.sqrt(np.maximum(fftconvolve(squared, missed, mode="same"), 0.0))


def compute_jump_noise_in_push(specimen: Specimen, run: FitRun) -> Array:
    """Return the error of the predicted push for lack of the instants at which friction jumped (n,) [N].

    The girder's acceleration jumps with the pads' forces.

    Args:
        specimen: with the storeys.
        run: whose pads' forces were sampled without a filter.
    """
    noise = float(np.linalg.norm(run.gauge_noise[0]))
    squared = np.append(squared_jumps(run.force.sum(axis=1), noise), 0.0) / specimen.mass**2
    out = np.zeros(len(squared))
    for mode in frame_modes(specimen.storeys):
        missed = locate_missed_instant(run.dt, mode.frequency, mode.damping)
        out += mode.share**4 * np.maximum(fftconvolve(squared, missed, mode="same"), 0.0)
    return np.sqrt(out)


def locate_missed_instant(dt: float, frequency: float, damping: float) -> Array:
    """Return the mean squared error of the sampled answer around a unit jump after the middle sample, (odd,) [1]."""
    turn = 2.0 * np.pi * frequency
    reach = int(3.0 / (turn * max(damping, 0.01) * dt)) + _BESIDE
    place = np.arange(-reach, reach + 1)
    sampled = pass_through_pitch((place > 0).astype(np.float64), dt, frequency, damping)
    after = place[:, None] * dt - (np.arange(_INSTANTS) + 0.5) / _INSTANTS * dt
    rung = np.sqrt(max(1.0 - damping**2, 1e-6))
    swing = turn * rung * after
    # P(s)/s: 1 - e^(-zwt) (cos w_d t - z/sqrt(1 - z^2) sin w_d t)
    decay = np.exp(-damping * turn * np.maximum(after, 0.0))
    exact = np.where(after > 0.0, 1.0 - decay * (np.cos(swing) - damping / rung * np.sin(swing)), 0.0)
    return ((exact - sampled[:, None]) ** 2).mean(axis=1)
