"""The storeys of an MJCF file: bodies storey_1, storey_2 ... each on the one before, the first on the girder."""

import re

import mujoco
import numpy as np

from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.storeys import Storey

#: Moment of inertia of a floor about its own middle, over the girder's, that is not felt [1].
_SMALL = 1e-4
#: Places that differ by less are the same [m].
_SAME = 1e-7
_NAME = re.compile(r"storey_([1-9][0-9]*)")


def storey_bodies(model: mujoco.MjModel) -> list[str]:
    """Return the names of the bodies that are storeys, in the order of their numbers."""
    found = [name for i in range(model.nbody) if _NAME.fullmatch(name := model.body(i).name)]
    return sorted(found, key=lambda name: int(name.partition("_")[2]))


def read_storeys(file: Mjcf) -> tuple[Storey, ...]:
    """Read the storeys, from below.

    Raises:
        InputError: a storey stands elsewhere than on the one before, or has what is not simulated.
    """
    model, out = file.model, []
    height = float(model.body("girder").pos[2])
    for number, name in enumerate(storey_bodies(model), 1):
        body = model.body(name)
        _check_place(file, name, number)
        joints = [model.joint(i).name for i in range(model.njnt) if model.jnt_bodyid[i] == body.id]
        if joints != [f"{name}_x", f"{name}_y"]:
            raise file.refused(
                f"the {name} has the joints {', '.join(joints) or '(none)'}; a storey has {name}_x and {name}_y, as in "
                "building.xml",
                "body",
                name,
            )
        stiffness = [float(model.joint(joint).stiffness[0]) for joint in joints]
        height += float(body.pos[2])
        damping = [float(model.dof_damping[model.joint(joint).dofadr[0]]) for joint in joints]
        out.append(Storey(float(body.mass[0]), height, *stiffness, *damping))
    return tuple(out)


def _check_place(file: Mjcf, name: str, number: int) -> None:
    """Hold a storey to its place in the row, upright over the girder's centre of gravity, as a mass without size."""
    model, body = file.model, file.model.body(name)
    below = f"storey_{number - 1}" if number > 1 else "girder"
    parent = model.body(int(body.parentid[0])).name
    if name != f"storey_{number}" or parent != below:
        words = "storeys are numbered from 1 and each stands in the body of the one before, the first in the girder"
        raise file.refused(f"the body {name} lies in {parent!r}, not in {below!r}: {words}", "body", name)
    turned = not np.array_equal(body.quat, [1.0, 0.0, 0.0, 0.0])
    if turned or np.abs(body.pos[:2]).max() > _SAME or np.abs(body.ipos).max() > _SAME:
        raise file.refused(
            f"the body {name} stands beside the girder's centre of gravity, or turned; a storey is lumped above it: "
            'give pos="0 0 height" and an inertial at pos="0 0 0"',
            "body",
            name,
        )
    if np.max(body.inertia) > _SMALL * np.max(model.body("girder").inertia):
        raise file.refused(
            f"the body {name} has an inertia of {np.max(body.inertia):g} kg m^2, which would not be simulated; a floor "
            "is a mass: leave its moments small, as in building.xml, or give them to the girder",
            "body",
            name,
        )
