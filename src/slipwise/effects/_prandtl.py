"""Prandtl's element: a spring that slips at its limit, driven by a sampled rate."""

import numpy as np

from slipwise.arrays import Array
from slipwise.jobs.machine_code import kept

#: Steps per sample: the way between two samples may be longer than the spring's.
_STEPS = 4


@kept()
def _followed(rate, dt, share):  # pragma: no cover - compiled
    """Follow dz/dt = rate, |z| <= 1, along straight lines between samples."""
    z = 0.0
    for i in range(1, len(rate)):
        for part in range(_STEPS):
            at = (part + 0.5) / _STEPS
            z = min(max(z + (rate[i - 1] + at * (rate[i] - rate[i - 1])) * dt / _STEPS, -1.0), 1.0)
        share[i] = z


def prandtl(rate: Array, dt: float) -> Array:
    """Return the share z of the limit, (n,) within -1 to 1.

    Args:
        rate: (n,) of the way in lengths of the spring [1/s].
        dt: sampling step [s].

    Source: Prandtl (1928), elastic-plastic element.
    """
    share = np.zeros_like(rate)
    _followed(np.ascontiguousarray(rate), dt, share)
    return share
