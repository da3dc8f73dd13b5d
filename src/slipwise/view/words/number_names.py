"""What fitted numbers are called, and the units in which people read them."""

from collections.abc import Mapping

#: Fitted numbers of the rig -> what they are called, unit in which they are shown.
CALLED: dict[str, tuple[str, str]] = {
    "rig.mass": ("mass of the girder", "t"),
    "rig.centre_height": ("height of the centre of gravity", "m"),
    "rig.buffer_stiffness": ("buffer stiffness, together", "kN/mm"),
    "rig.pitch_frequency": ("pitch of the girder on its pads", "Hz"),
    "rig.pitch_damping": ("its damping", "1"),
    "rig.yaw_inertia": ("inertia of the girder about the vertical", "t*m^2"),
    "rig.pitch_inertia": ("inertia of the girder in pitch", "t*m^2"),
    "rig.roll_inertia": ("inertia of the girder in roll", "t*m^2"),
    "rig.seat_stiffness": ("stiffness of the pads over rated, by their seats", "1"),
    "rig.pitch_slip": ("slip at the gauge for pitch load", "mm/kN"),
    "rig.stick_length": ("slip over which stick turns round", "um"),
    "rig.stick_damping": ("time by which its damper leads", "ms"),
    "rig.shear_strength": ("shear strength s", "MPa"),
    "rig.zero_force": ("zero of the friction gauge", "N"),
    "rig.logger": ("logger's filter of the friction channels", "Hz"),
}
_LATE = "rig.late_"


def called(key: str, unit: str, names: Mapping[str, tuple[str, str]] = CALLED) -> tuple[str, str]:
    """Return what a fitted number is called, and the unit in which it is shown.

    Args:
        key: "rig.mass", "heating.share" ...
        unit: its SI unit, for a number that has no other.
        names: key -> name and unit; those of the rig's numbers if not given.
    """
    if key.startswith(_LATE):
        return f"lag of the {key.removeprefix(_LATE)} channels", "us"
    return names.get(key, (key, unit))
