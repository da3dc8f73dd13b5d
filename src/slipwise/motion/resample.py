"""Resampling of a motion to the step of a simulation: band-limited, without phase shift and without aliasing.

Two steps. A windowed sinc, symmetric about each sample (so no phase is left), takes the motion to a grid of eight
points to the coarser step; a quintic spline then reads that grid at the wanted times. Refining passes frequencies up
to 0.95 of the old Nyquist frequency within 2e-4 of the amplitude. Coarsening passes up to 0.9 of the new one within
1e-4, and stops all above the new one by 80 dB: nothing folds back.

What it does to peaks. Refining keeps every recorded sample. The motion between samples is that of the band-limited
signal, so the largest value may lie between two samples and exceed the recorded one; it is the peak that the record
stands for. (Straight lines between samples would keep the peak, and put the difference into frequencies that were
never recorded.) Coarsening takes away what the new step cannot carry, and its share of the peak.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from slipwise.errors import SettingError
from slipwise.motion.table_motion import TableMotion

_FINER = 8
#: Zero crossings of the sinc to each side: with the window below, the transition takes 0.04 of the sampling rate.
_CROSSINGS = 64
#: Kaiser's beta for 80 dB. Source: Kaiser 1974, beta = 0.1102 (A - 8.7).
_BETA = 0.1102 * (80.0 - 8.7)
#: Samples beyond the ends, so that the spline feels no end: its memory falls by 0.43 a grid point.
_BEYOND = 5
_MOST_SAMPLES = 50_000_000


def resample(motion: TableMotion, dt: float) -> TableMotion:
    """Return the motion at another step.

    Args:
        motion: the motion.
        dt: the wanted step [s].

    Returns:
        The motion at times 0, dt, 2 dt, ... up to the end of the given one. Outside the record, where the filter
        reaches beyond its ends, the end values are taken to go on.

    Raises:
        SettingError: the step is not positive, longer than the motion, or gives more than 50 million samples.
    """
    if not (np.isfinite(dt) and dt > 0):
        raise SettingError(f"a step of {dt!r} s is not possible; give a positive one")
    samples = int(motion.duration / dt * (1 + 1e-12) + 1e-9) + 1
    if not 2 <= samples <= _MOST_SAMPLES:
        raise SettingError(
            f"{motion.title}: a step of {dt:g} s would give {samples} samples over {motion.duration:g} s; "
            f"between 2 and {_MOST_SAMPLES} are possible"
        )
    if abs(dt - motion.dt) * len(motion) < 1e-6 * motion.dt:
        return motion
    fine, finer = _refined(motion.acceleration, motion.dt, dt)
    places = (np.arange(samples) * (dt / motion.dt) + _BEYOND) * finer
    values = np.stack([map_coordinates(column, [places], order=5, mode="nearest") for column in fine.T], axis=1)
    direction = "band-limited interpolation" if dt < motion.dt else "zero-phase anti-alias filter"
    words = f"resampled from {motion.dt:.6g} s to {dt:.6g} s ({direction}, no phase shift)"
    return replace(motion, dt=dt, acceleration=values, treatment=(*motion.treatment, words))


def _refined(values: NDArray[np.float64], old: float, new: float) -> tuple[NDArray[np.float64], int]:
    """Return the values on a finer grid, without what the new step cannot carry; and how many times finer it is.

    The grid reaches `_BEYOND` samples beyond either end of the record.
    """
    # Relative to the old Nyquist frequency; below 1 the sinc is wider and a little lower, to stop at the new one.
    cutoff = 1.0 if new <= old else 0.96 * old / new
    # What passes a coarser step needs no finer grid than eight points to that step. Not below 2: at the same rate
    # a sinc gives the values back without filtering them.
    finer = max(int(np.ceil(_FINER * min(old / new, 1.0))), 2)
    reach = int(np.ceil(_CROSSINGS / cutoff)) + 1
    half = int(np.ceil(_CROSSINGS * finer / cutoff))
    window = np.zeros(2 * reach * finer)
    place = np.arange(-half, half + 1)
    window[reach * finer + place] = cutoff * np.sinc(cutoff * place / finer) * np.kaiser(2 * half + 1, _BETA)
    held = np.pad(values, ((reach - 1 + _BEYOND, reach + _BEYOND), (0, 0)), mode="edge")
    fine = np.empty((len(values) + 2 * _BEYOND, finer, values.shape[1]))
    for phase in range(finer):
        for axis in range(values.shape[1]):
            fine[:, phase, axis] = np.convolve(held[:, axis], window[phase::finer], mode="valid")
    return fine.reshape(-1, values.shape[1]), finer
