"""What any rig can have: the bounds of every value of a specimen."""

from typing import Any

import numpy as np

#: What any rig can have, from a tribometer to a bridge at full size: low, high, unit. Assumed.
BOUNDS: dict[str, tuple[float, float, str]] = {
    "mass": (1e-3, 1e8, "kg"),
    "inertia": (1e-12, 1e14, "kg m^2"),
    "centre_height": (1e-4, 100.0, "m"),
    "centre_x": (-100.0, 100.0, "m"),
    "centre_y": (-100.0, 100.0, "m"),
    "pad_places": (-100.0, 100.0, "m"),
    "pad_radius": (1e-5, 10.0, "m"),
    "pad_stiffness": (1.0, 1e15, "N/m"),
    "pad_damping": (0.0, 1e15, "N s/m"),
    "pad_curvature": (-100.0, 100.0, "1/m"),
    "plastic_pressure": (1.0, 1e14, "Pa"),
    "shear_strength": (1e-3, 1e14, "Pa"),
    "buffer_stiffness": (0.0, 1e15, "N/m"),
    "buffer_places": (-100.0, 100.0, "m"),
    "buffer_height": (-100.0, 100.0, "m"),
    "buffer_gap": (0.0, 10.0, "m"),
    "storey_height": (-100.0, 1000.0, "m"),
    "storey_stiffness": (1.0, 1e15, "N/m"),
    "storey_damping": (0.0, 1e15, "N s/m"),
    "seating": (-1.0, 1.0, "m"),
    "edge_distance": (1e-4, 100.0, "m"),
    "bending_frequency": (1e-2, 1e5, "Hz"),
    "bending_damping": (0.0, 1.0, "of critical"),
    "gravity": (1e-2, 1e3, "m/s^2"),
}


def out_of_bounds(name: str, given: Any) -> str:
    """Say what is wrong with a value of a specimen, or nothing: a number or a tuple of them [SI]."""
    if name not in BOUNDS:
        return ""
    low, high, unit = BOUNDS[name]
    for value in np.ravel(given):
        if not low <= value <= high:
            return f"{name} = {value:g} {unit} cannot be; possible are {low:g} to {high:g} {unit}: look at its unit"
    return ""
