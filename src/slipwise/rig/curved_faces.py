"""How a girder on curved sliders rises as it slips: on a sphere of radius R by R - sqrt(R^2 - r^2), r^2 = x^2 + y^2."""

from collections.abc import Callable

import numpy as np

from slipwise.arrays import Array
from slipwise.rig.specimen import Specimen

#: Share of the radius up to which a face is a sphere [1].
_SPHERE = 0.9


def risen(slip: Array, specimen: Specimen) -> Array:
    """Return how far a girder stands higher than in the middle, mean of its pads by their stiffness, (n,) [m].

    Args:
        slip: (n, 2) of the girder over the table [m].
        specimen: as built.
    """
    return _mean(specimen, lambda curvature: _rise(curvature, np.hypot(*slip.T)), len(slip))


def rise_rate(slip: Array, velocity: Array, specimen: Specimen) -> Array:
    """Return the rate of that rise, (n,) [m/s].

    Args:
        slip: (n, 2) of the girder over the table [m].
        velocity: (n, 2) of it [m/s].
        specimen: as built.
    """
    outward = np.sum(slip * velocity, axis=1)

    def rate(curvature: float) -> Array:
        sine = np.minimum(abs(curvature) * np.hypot(*slip.T), _SPHERE)
        return curvature * outward / np.sqrt(1.0 - sine**2)

    return _mean(specimen, rate, len(slip))


def _rise(curvature: float, away: Array) -> Array:
    sine = np.minimum(abs(curvature) * away, _SPHERE)
    return sine**2 / (1.0 + np.sqrt(1.0 - sine**2)) / curvature


def _mean(specimen: Specimen, of: Callable[[float], Array], count: int) -> Array:
    out = np.zeros(count)
    for curvature in {place.curvature for place in specimen.places} - {0.0}:
        share = sum(place.stiffness for place in specimen.places if place.curvature == curvature)
        out += share / sum(specimen.springs) * of(curvature)
    return out
