"""What a table motion can hardly be: gravity in a gauge, a table that travels metres, a unit that is another."""

import warnings

import numpy as np

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion.table_motion import AXES, TableMotion
from slipwise.motion.trace import Baseline, Trace

#: Standard gravity [m/s^2], and how near to it a mean must be to be gravity's [1].
_GRAVITY, _NEAR = 9.80665, 0.1
#: Tables of laboratories travel less [m], and records are smaller [m/s^2].
_TRAVEL, _PEAK = 2.0, 5.0 * _GRAVITY


def check_gravity(trace: Trace, axis: str, baseline: Baseline | None) -> None:
    """Refuse a component in which gravity stands; whoever asks for no baseline is only warned.

    Args:
        trace: the component as recorded.
        axis: what it becomes.
        baseline: what the user asked for, None if nothing.

    Raises:
        InputError: its mean is near plus or minus 1 g, and nobody takes it out or keeps it on purpose.
    """
    mean = float(trace.acceleration.mean())
    if abs(abs(mean) - _GRAVITY) > _NEAR * _GRAVITY or (baseline or trace.baseline) != "none":
        return
    words = (
        f"{trace.source.name}: the mean of {trace.name} (table {axis}) is {mean:.4g} m/s^2, "
        f"{mean / _GRAVITY:+.3g} g: gravity is in it"
    )
    if baseline is None:
        raise InputError(f"{words}; --baseline mean takes it out (--baseline none shakes the table with it)")
    warnings.warn(f"{words}, and the table is shaken with it", SlipwiseWarning, stacklevel=4)


def warn_of_peak(motion: TableMotion) -> None:
    """Warn of a peak beyond 5 g."""
    for axis, peak in zip(AXES, motion.peaks, strict=True):
        if peak > _PEAK:
            warnings.warn(
                f"{motion.title}: the table reaches {peak / _GRAVITY:.3g} g in {axis}; is the unit right?",
                SlipwiseWarning,
                stacklevel=2,
            )


def warn_of_travel(motion: TableMotion) -> None:
    """Warn of a table that would have to travel more than 2 m, integrated from rest as the motion stands."""
    far = np.abs(_travel(motion)).max(axis=0)
    beyond = [f"{metres:.3g} m in {axis}" for axis, metres in zip(AXES, far, strict=True) if metres > _TRAVEL]
    if beyond:
        warnings.warn(
            f"{motion.title}: as it stands the table travels {', '.join(beyond)}: an offset or a drift is in the "
            "motion; --baseline linear takes an offset out, --stroke '150 mm' tells how far it goes without the drift",
            SlipwiseWarning,
            stacklevel=2,
        )


def _travel(motion: TableMotion) -> np.ndarray:
    """Integrate twice from rest (n, 3) [m] by trapezoids, without scipy, which takes long to load."""
    values = motion.acceleration
    for _ in range(2):
        steps = 0.5 * motion.dt * (values[1:] + values[:-1])
        values = np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    return values
