"""What a simulation starts from: the law's numbers, the girder at rest, MuJoCo's model without what the law does."""

import copy

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.rig import Rig
from slipwise.rig.statics import at_rest
from slipwise.simulation.kernel import Kernel, fill, places
from slipwise.simulation.kernel.layout import buffer_blocks, pad_blocks
from slipwise.simulation.kernel.places import MAX_DOFS

#: Of the solver; relative to the mean inertia, which the table's armature raises to 1e9 kg [1].
_TOLERANCE = 1e-22
#: Gap [m] below which the law is asked for the load of a pad: more than any girder is thrown.
_REACH = 0.5
#: Sensors of acceleration, along and about.
_ACCELERATION = (int(mujoco.mjtSensor.mjSENS_FRAMELINACC), int(mujoco.mjtSensor.mjSENS_FRAMEANGACC))


def numbers_for(law: Kernel, rig: Rig, model: Model, dt: float) -> Array:
    """Fill the law's array with everything that a simulation needs, at rest."""
    numbers = fill(law.layout, model, dt)
    count, dofs = len(rig.specimen.pads), rig.model.nv
    arms = min(dofs, MAX_DOFS)
    numbers[places.N_DOFS], numbers[places.N_ARMS] = dofs, arms
    numbers[places.USER_SENSOR] = rig.user_sensor
    axes = ("x", "y", "z", "roll", "pitch", "yaw")
    numbers[places.GIRDER_DOF : places.GIRDER_DOF + 6] = [_dof(rig.model, f"girder_{axis}") for axis in axes]
    if not rig.specimen.free:
        numbers[places.GIRDER_DOF] = -1.0
    numbers[places.RATE_AGE] = dt
    numbers[places.TABLE_DOF], numbers[places.TABLE_VELOCITY] = _dof(rig.model, "table_x"), np.nan
    numbers[places.TABLE_ARMATURE] = rig.model.dof_armature[_dof(rig.model, "table_x")]
    tendons = np.array(rig.tendons).reshape(-1, 2)
    jacobian = np.zeros((len(tendons), 2, MAX_DOFS))
    jacobian[:, :, :arms] = rig.jacobian.reshape(-1, 2, dofs)[:, :, :arms]
    jacobian = jacobian.reshape(len(tendons), 2 * MAX_DOFS)
    pads, buffers = pad_blocks(law.layout, numbers), buffer_blocks(law.layout, numbers)[: len(tendons) - count]
    pads[:, places.PAD_GEOM] = rig.pad_geoms
    pads[:, places.PAD_TENDON : places.PAD_TENDON + 2] = tendons[:count]
    pads[:, places.FRICTION_ROW : places.FRICTION_ROW + 2] = _friction_rows(rig, 2 * count).reshape(-1, 2)
    pads[:, places.PAD_JACOBIAN : places.PAD_JACOBIAN + 2 * MAX_DOFS] = jacobian[:count]
    buffers[:, places.BUFFER_TENDON : places.BUFFER_TENDON + 2] = tendons[count:]
    buffers[:, places.BUFFER_JACOBIAN : places.BUFFER_JACOBIAN + 2 * MAX_DOFS] = jacobian[count:]
    pads[:, places.EXCESS : places.EXCESS + 2] = np.nan
    if rig.specimen.free:
        readings = _acceleration_readings(rig)
        responses = _responses(rig, readings)
        first = law.layout.responses(rig.specimen)
        numbers[first : first + responses.size] = responses.ravel()
        numbers[places.RESPONSES] = first
        numbers[places.ACCELERATIONS], numbers[places.N_ACCELERATIONS] = readings.start, readings.stop - readings.start
    return numbers


def _acceleration_readings(rig: Rig) -> slice:
    """Return where the readings of acceleration stand in sensordata: one after another."""
    found = [s for name, s in rig.sensors.items() if rig.model.sensor(name).type[0] in _ACCELERATION]
    return slice(min(s.start for s in found), max(s.stop for s in found))


def _responses(rig: Rig, readings: slice) -> Array:
    """Work out what one newton of friction on each pad along x and y changes, (rows, dofs + rows + readings).

    Accelerations of the degrees of freedom [m/s^2, rad/s^2], of the rows' slip [m/s^2], and readings, at rest.
    """
    model, count = rig.model, 2 * len(rig.specimen.pads)
    data = mujoco.MjData(model)
    data.qpos[:] = start_state(rig)
    mujoco.mj_forward(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    dofs = -np.linalg.solve(inertia, rig.jacobian[:count].T).T
    read = np.zeros((readings.stop - readings.start, model.nv))
    for name, at in rig.sensors.items():
        sensor = model.sensor(name)
        if sensor.type[0] in _ACCELERATION:
            along, about = np.zeros((3, model.nv)), np.zeros((3, model.nv))
            mujoco.mj_jacSite(model, data, along, about, int(sensor.objid[0]))
            turns = sensor.type[0] == mujoco.mjtSensor.mjSENS_FRAMEANGACC
            read[at.start - readings.start : at.stop - readings.start] = about if turns else along
    return np.concatenate([dofs, dofs @ rig.jacobian[:count].T, dofs @ read.T], axis=1, dtype=np.float64)


def _dof(model: mujoco.MjModel, joint: str) -> int:
    names = [model.joint(i).name for i in range(model.njnt)]
    return int(model.jnt_dofadr[names.index(joint)]) if joint in names else -1


def _friction_rows(rig: Rig, count: int) -> NDArray[np.int64]:
    """Find the constraint rows of the pads' tendons: dry friction stands first, in the order of ids."""
    loaded = [i for i in range(rig.model.ntendon) if rig.model.tendon_frictionloss[i] > 0.0]
    joints = int(np.count_nonzero(np.asarray(rig.model.dof_frictionloss) > 0.0))
    return np.array([joints + loaded.index(tendon) for tendon in rig.tendons[:count]])


def start_state(rig: Rig) -> Array:
    """Return the generalised positions at rest, (nq,)."""
    rest = at_rest(rig.specimen)
    data = mujoco.MjData(rig.model)
    data.joint("girder_z").qpos[0] = rest.heave
    if rig.specimen.free:
        data.joint("girder_roll").qpos[0] = rest.roll
        data.joint("girder_pitch").qpos[0] = rest.pitch
    return np.array(data.qpos)


def model_for_kernel(rig: Rig, dt: float) -> mujoco.MjModel:
    """Return a copy of the rig's model for a step dt [s] in which the law takes the place of buffers and of contacts.

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
    model.pair_margin[:] = _REACH
    return model
