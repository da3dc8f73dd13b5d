"""How fast and how far a table must go to make a motion: by integration, with the baseline said."""

import warnings
from typing import Literal

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError, SlipwiseWarning
from slipwise.motion.table_motion import AXES, TableMotion

Drift = Literal["linear", "none"]


def table_velocity(motion: TableMotion, drift: Drift = "linear") -> Array:
    """Integrate the acceleration once (trapezoids).

    Args:
        motion: the motion.
        drift: "linear" takes the least-squares line from the velocity: a constant error of the acceleration and an
            unknown speed at the start. "none" starts from rest and takes nothing: right for synthetic motions.

    Returns:
        (n, 3) [m/s].

    Raises:
        SettingError: another word.
    """
    return _less_drift(_integral(motion.acceleration, motion.dt), drift)


def table_displacement(motion: TableMotion, drift: Drift = "linear") -> Array:
    """Integrate the acceleration twice; a line is taken from the velocity and from the displacement, or nothing.

    Returns:
        (n, 3) [m].

    Raises:
        SettingError: `drift` is neither "linear" nor "none".
    """
    velocity = table_velocity(motion, drift)
    return _less_drift(_integral(velocity, motion.dt), drift)


def velocity_peak(motion: TableMotion, drift: Drift = "linear") -> Array:
    """Return the largest absolute velocity of x, y, z (3,) [m/s]; see `table_velocity`."""
    return np.abs(table_velocity(motion, drift)).max(axis=0)


def displacement_peak(motion: TableMotion, drift: Drift = "linear") -> Array:
    """Return the largest absolute displacement of x, y, z (3,) [m]; see `table_displacement`."""
    return np.abs(table_displacement(motion, drift)).max(axis=0)


def warn_beyond_stroke(motion: TableMotion, stroke: float, drift: Drift | None = None) -> None:
    """Warn when the table would have to go farther than it can.

    Args:
        motion: the motion.
        stroke: largest displacement from the middle, in any direction [m].
        drift: as in `table_displacement`; by default "none" for a synthetic motion, "linear" for a recorded one.

    Raises:
        SettingError: the stroke is not positive.
    """
    if not (np.isfinite(stroke) and stroke > 0):
        raise SettingError(f"a stroke of {stroke!r} m is not possible; give a positive one")
    used: Drift = drift or ("linear" if motion.sources else "none")
    for axis, far in zip(AXES, displacement_peak(motion, used), strict=True):
        if far > stroke:
            warnings.warn(
                f"{motion.title}: the table would have to move {1e3 * far:.1f} mm in {axis}, its stroke is "
                f"{1e3 * stroke:.1f} mm (integrated, drift: {used}); scale the motion or shorten its time",
                SlipwiseWarning,
                stacklevel=2,
            )


def _integral(values: Array, dt: float) -> Array:
    from scipy.integrate import cumulative_trapezoid  # here, for it takes long to load and few replays need it

    return cumulative_trapezoid(values, dx=dt, axis=0, initial=0.0)


def _less_drift(values: Array, drift: Drift) -> Array:
    if drift == "none":
        return values
    if drift == "linear":
        from scipy.signal import detrend

        return detrend(values, axis=0, type="linear")
    raise SettingError(f"a treatment of drift {drift!r} does not exist; linear and none do")
