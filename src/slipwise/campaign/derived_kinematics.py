"""Channels that follow from others of a run: slip from its speed, acceleration of the table from its displacement."""

from collections.abc import Mapping

import numpy as np
from scipy.integrate import cumulative_trapezoid

from slipwise.arrays import Array
from slipwise.signals.second_derivative import second_derivative

#: A speed rests before a run for at least so many samples, within this share of its peak; its mean there is drift.
_REST, _STILL = 12, 0.003


def completed(time: Array, channels: Mapping[str, Array]) -> tuple[dict[str, Array], tuple[str, ...]]:
    """Add slip_x, slip_y where only their speeds are there, and table_ax ... where only displacements are.

    Args:
        time: (n,) [s].
        channels: each (n,), SI.

    Returns:
        The channels with those that were added, and what was done, in words.
    """
    out, words = dict(channels), []
    for axis in "xy":
        slip, speed = f"slip_{axis}", f"slip_v{axis}"
        if speed in channels and slip not in channels:
            values, drift = _integrated(time, channels[speed])
            out[slip] = values
            taken = (
                f"a drift of {1e3 * drift:.3g} mm/s, its mean at rest, removed" if drift else "no rest shows its drift"
            )
            words.append(f"{slip} is integrated from {speed}, {taken}")
    step = float(np.median(np.diff(time)))
    even = np.ptp(np.diff(time)) < 0.01 * step
    for axis in "xyz":
        place, acceleration = f"table_d{axis}", f"table_a{axis}"
        finite = place in channels and bool(np.isfinite(channels[place]).all())
        if finite and acceleration not in channels and even and len(time) > 8:
            out[acceleration], frequency = second_derivative(channels[place], step)
            words.append(f"{acceleration} is {place} differentiated twice, below {frequency:.3g} Hz")
    return out, tuple(words)


def _integrated(time: Array, speed: Array) -> tuple[Array, float]:
    """Integrate a speed (n,) by trapezoids from zero; what it reads at rest before the run is taken for drift [m/s]."""
    peak, first = float(np.abs(speed).max(initial=0.0)), speed[:_REST]
    still = max(_STILL * peak, 6.0 * float(first.std()))
    moving = np.flatnonzero(np.abs(speed - first.mean()) > still)
    # The last part before that may be the onset.
    rest = speed[: int(0.75 * moving[0]) if len(moving) else len(speed)]
    drift = float(rest.mean()) if len(rest) >= _REST and abs(rest.mean()) < 0.1 * peak else 0.0
    return cumulative_trapezoid(speed - drift, time, initial=0.0), drift
