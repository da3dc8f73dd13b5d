"""Which parts the MJCF file of a rig must have, and which it may not: what is not simulated must not be in it."""

import re
from pathlib import Path

import mujoco

from slipwise.channels import BUFFERS, PADS
from slipwise.errors import InputError

_SIMULATED = {"pad": PADS, "buffer": BUFFERS}
_ACTUATORS = ("table_ax", "table_ay", "table_az", "table_apitch")
#: Mass that a body beside the girder may have: the table's own is not felt [kg].
_NOTHING = 1e-6


def check_parts(model: mujoco.MjModel, path: Path) -> None:
    """Refuse a rig with parts that would be left out without a word, or without parts that are needed.

    Args:
        model: as MuJoCo reads the file.
        path: of the file, for messages.

    Raises:
        InputError: the message names the part and what is possible.
    """
    geoms = [model.geom(i).name for i in range(model.ngeom)]
    tendons = [model.tendon(i).name for i in range(model.ntendon)]
    for kind, known in _SIMULATED.items():
        named = {m[1] for name in (*geoms, *tendons) if (m := re.fullmatch(rf"{kind}_([A-Za-z0-9]+?)(?:_[xy])?", name))}
        if more := sorted(named - set(known)):
            raise InputError(
                f"{path.name} has {kind}s {', '.join(more)}, which would not be simulated; a rig has the {kind}s "
                f"{', '.join(known)} at most: join them to as many"
            )
    actuators = {model.actuator(i).name for i in range(model.nu)}
    if absent := [name for name in _ACTUATORS if name not in actuators]:
        raise InputError(
            f"{path.name} lacks the actuators {', '.join(absent)} of the table; copy them from bridge1.xml"
        )
    for i in range(1, model.nbody):
        body = model.body(i)
        mass = float(body.mass[0])
        if body.name not in ("table", "girder") and mass > _NOTHING:
            raise InputError(
                f"{path.name}: the body {body.name or i!r} has a mass of {mass:g} kg, which would not be counted; "
                "give its mass and inertia to the girder, the only body that is weighed"
            )
