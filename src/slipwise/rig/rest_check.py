"""At rest the pads must carry what moves: the loads of the compiled rig against the masses of the file."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.errors import SettingError
from slipwise.rig.build import Rig, build, largest_step
from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.specimen import Specimen
from slipwise.rig.statics import at_rest

#: What the sum of the loads may differ from the weight [1].
_SAME = 1e-6
_STEP = 5e-4
#: Vertical force that Newton's method leaves over the weight [1], and how often it may try.
_BALANCED, _ROUNDS = 1e-8, 20


def check_rest(file: Mjcf, specimen: Specimen) -> None:
    """Refuse a rig whose pads do not carry, at rest, the total mass of its moving bodies times g within 1e-6.

    The masses are those of the file as MuJoCo compiles it, the loads those of the contacts in the rig that is
    simulated.

    Raises:
        InputError: they do not, or the girder does not stand on its pads.
    """
    model = file.model
    moving = [i for i in range(1, model.nbody) if model.body(i).name != "table"]
    weight = float(model.body_mass[moving].sum()) * -float(model.opt.gravity[2])
    try:
        carried = loads_at_rest(build(specimen, min(_STEP, largest_step(specimen)), 0)).sum()
    except SettingError as error:
        raise file.refused(f"the pads cannot carry the girder: {error}", "body", "girder") from None
    if not abs(carried - weight) <= _SAME * weight:
        raise file.refused(
            f"at rest the pads carry {carried / 1e3:.7g} kN, all bodies that move weigh {weight / 1e3:.7g} kN; a mass "
            "that its pads do not carry is not simulated: give it to the girder",
            "body",
            "girder",
        )


def loads_at_rest(rig: Rig) -> NDArray[np.float64]:
    """Return the load of each pad's contact where the compiled rig is in equilibrium (n_pads,) [N].

    `at_rest` is exact for small turning; what it leaves is taken away by Newton's method on MuJoCo's own forces.
    """
    specimen, data = rig.specimen, mujoco.MjData(rig.model)
    rest = at_rest(specimen)
    start = {"girder_z": rest.heave}
    if specimen.free:
        start |= {"girder_roll": rest.roll, "girder_pitch": rest.pitch}
    joints = [rig.model.joint(name) for name in start]
    places, rates = ([int(getattr(joint, at)[0]) for joint in joints] for at in ("qposadr", "dofadr"))
    data.qpos[places] = list(start.values())
    arms = np.array(specimen.pad_places) - [specimen.centre_x, specimen.centre_y]
    shape = np.stack([-np.ones(len(arms)), -arms[:, 1], arms[:, 0]], axis=1)[:, : len(start)]
    loads, springs = np.zeros(len(arms)), np.array(specimen.springs)
    for _ in range(_ROUNDS):
        mujoco.mj_forward(rig.model, data)
        loads = _contact_loads(rig, data)
        left = data.qfrc_smooth[rates] + data.qfrc_constraint[rates]
        bears = loads > 0.0
        touching = shape[bears]
        if len(touching) < len(start) or abs(left[0]) < _BALANCED * specimen.weight:
            break
        data.qpos[places] += np.linalg.solve((touching.T * springs[bears]) @ touching, left)
    return loads


def _contact_loads(rig: Rig, data: mujoco.MjData) -> NDArray[np.float64]:
    """Return what the contacts carry upwards (n_pads,) [N]."""
    loads, force = np.zeros(len(rig.pad_geoms)), np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        pad = next((g for g in (contact.geom1, contact.geom2) if g in rig.pad_geoms), None)
        if pad is not None:
            mujoco.mj_contactForce(rig.model, data, i, force)
            loads[rig.pad_geoms.index(pad)] += abs(float(force[0] * contact.frame[2]))
    return loads
