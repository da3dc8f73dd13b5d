"""What a simulation starts from: the law's numbers, the girder at rest, MuJoCo's model without what the law does."""

import copy

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.model import Model
from slipwise.rig import Rig
from slipwise.rig.statics import at_rest
from slipwise.simulation.kernel import Kernel, fill, places
from slipwise.simulation.kernel.places import MAX_DOFS

Array = NDArray[np.float64]
#: Of the solver; relative to the mean inertia, which the table's armature raises to 1e9 kg [1].
_TOLERANCE = 1e-22
#: Gap [m] below which the law is asked for the load of a pad: more than any girder is thrown.
_REACH = 0.5


def numbers_for(law: Kernel, rig: Rig, model: Model, dt: float) -> Array:
    """Fill the law's array with everything that a simulation needs, at rest."""
    numbers = fill(law.layout, model, dt)
    n_pads, n_tendons = len(rig.specimen.pads), len(rig.tendons)
    numbers[places.N_DOFS] = rig.model.nv
    numbers[places.USER_SENSOR] = rig.user_sensor
    axes = ("x", "y", "z", "roll", "pitch", "yaw")
    numbers[places.GIRDER_DOF : places.GIRDER_DOF + 6] = [_dof(rig.model, f"girder_{axis}") for axis in axes]
    if not rig.specimen.free:
        numbers[places.GIRDER_DOF] = -1.0
    numbers[places.PAD_GEOM : places.PAD_GEOM + n_pads] = rig.pad_geoms
    numbers[places.TENDON : places.TENDON + n_tendons] = rig.tendons
    numbers[places.FRICTION_ROW : places.FRICTION_ROW + 2 * n_pads] = _friction_rows(rig, 2 * n_pads)
    jacobian = np.zeros((n_tendons, MAX_DOFS))
    jacobian[:, : rig.model.nv] = rig.jacobian
    numbers[places.JACOBIAN : places.JACOBIAN + jacobian.size] = jacobian.ravel()
    numbers[places.PAD_STIFFNESS] = rig.specimen.pad_stiffness
    numbers[places.RATE_AGE] = dt
    numbers[places.PAD_DAMPING] = rig.specimen.pad_damping
    return numbers


def _dof(model: mujoco.MjModel, joint: str) -> int:
    names = [model.joint(i).name for i in range(model.njnt)]
    return int(model.jnt_dofadr[names.index(joint)]) if joint in names else -1


def _friction_rows(rig: Rig, count: int) -> list[int]:
    """Find the constraint rows of the pads' tendons: dry friction stands first, in the order of ids."""
    loaded = [i for i in range(rig.model.ntendon) if rig.model.tendon_frictionloss[i] > 0.0]
    joints = int(np.count_nonzero(np.asarray(rig.model.dof_frictionloss) > 0.0))
    return [joints + loaded.index(tendon) for tendon in rig.tendons[:count]]


def start_state(rig: Rig) -> Array:
    """Give the generalised positions at rest, (nq,)."""
    rest = at_rest(rig.specimen)
    data = mujoco.MjData(rig.model)
    data.joint("girder_z").qpos[0] = rest.heave
    if rig.specimen.free:
        data.joint("girder_roll").qpos[0] = rest.roll
        data.joint("girder_pitch").qpos[0] = rest.pitch
    return np.array(data.qpos)


def model_for_kernel(rig: Rig, dt: float) -> mujoco.MjModel:
    """Give a copy of the rig's model for a step dt [s] in which the law takes the place of buffers and of contacts.

    The buffers' springs are left out; they stay in the rig so that it behaves in any viewer. The law says what a
    contact carries and has to be asked before a pad touches.
    """
    model = copy.copy(rig.model)
    model.opt.timestep = dt
    # At a larger tolerance the solver takes the forces of the step before where they are 1 N wrong.
    model.opt.tolerance = min(model.opt.tolerance, _TOLERANCE)
    tendons = list(rig.tendons)
    model.tendon_stiffness[tendons] = 0.0
    model.tendon_solref_fri[tendons, 0] *= dt / rig.model.opt.timestep
    pads = list(rig.pad_geoms)
    model.geom_margin[pads] = model.body_margin[model.geom_bodyid[pads]] = _REACH
    return model
