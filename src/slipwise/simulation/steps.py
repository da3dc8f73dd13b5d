"""Runs a model under a table motion, chunk by chunk, in either engine."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import mujoco
import numpy as np
from mujoco.batch import Batch
from mujoco.batch import SimulationError as BatchError
from numpy.typing import NDArray

from slipwise.model import Model
from slipwise.rig import Rig
from slipwise.rig.statics import at_rest
from slipwise.simulation.kernel import Kernel, fill, installed, places
from slipwise.simulation.kernel.places import MAX_DOFS

Array = NDArray[np.float64]
#: Steps between two looks at progress and at the health of a simulation.
CHUNK = 2000


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
    numbers[places.LOAD : places.LOAD + n_pads] = at_rest(rig.specimen).load
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


@contextmanager
def without_springs(rig: Rig) -> Iterator[mujoco.MjModel]:
    """Give the model without the buffers' own springs: the law's buffers take their place.

    The springs stay in the file so that it behaves in any viewer.
    """
    kept = np.array(rig.model.tendon_stiffness)
    rig.model.tendon_stiffness[list(rig.tendons)] = 0.0
    try:
        yield rig.model
    finally:
        rig.model.tendon_stiffness[:] = kept


def run_compiled(
    law: Kernel, rig: Rig, numbers: Array, control: Array, each: Callable[[int, Array], bool], threads: int = 1
) -> str:
    """Step simulations with the compiled law; several at once when `numbers` has several rows.

    Args:
        law: the compiled kernel.
        rig: the compiled specimen.
        numbers: (n_sims, size) of `numbers_for`; holds the final memory afterwards.
        control: (n_sims, n_steps, 4) table acceleration [m/s^2, rad/s^2].
        each: called after every chunk with the index of its first step and sensordata (n_sims, n, n_sensors); stop if
            it answers False.
        threads: that step simulations side by side.

    Returns:
        "" or what MuJoCo reported when it stopped.
    """
    with without_springs(rig) as model:
        batch = Batch(model, len(numbers), threads)
        batch.bind("qpos")[:] = start_state(rig)
        batch.bind("userdata")[:] = numbers
        with installed(law):
            for first in range(0, control.shape[1], CHUNK):
                part = control[:, first : first + CHUNK]
                try:
                    out = batch.rollout(part.shape[1], part, record=("sensordata",))
                except BatchError as error:
                    return str(error)
                if not each(first, out["sensordata"]):
                    break
                if np.any(batch.warning):
                    return _warning(batch.warning.reshape(len(numbers), -1).sum(axis=0))
        numbers[:] = batch.bind("userdata")
    return ""


def run_python(law: Kernel, rig: Rig, numbers: Array, control: Array, each: Callable[[int, Array], bool]) -> str:
    """Step one simulation with the law in plain Python; arguments as `run_compiled`, with one simulation."""
    with without_springs(rig) as model:
        data = mujoco.MjData(model)
        data.qpos[:] = start_state(rig)
        data.userdata[:] = numbers[0]
        with installed(law):
            for first in range(0, control.shape[1], CHUNK):
                part = control[0, first : first + CHUNK]
                out = np.empty((1, len(part), model.nsensordata))
                for i, command in enumerate(part):
                    data.ctrl[:] = command
                    mujoco.mj_step(model, data)
                    out[0, i] = data.sensordata
                if not each(first, out):
                    break
                warnings = np.array([w.number for w in data.warning])
                if warnings.any():
                    return _warning(warnings)
        numbers[0] = data.userdata
    return ""


def _warning(counts: Array) -> str:
    names = [w.name.removeprefix("mjWARN_").lower() for w in mujoco.mjtWarning.__members__.values()]
    return "MuJoCo warned: " + ", ".join(name for name, count in zip(names, counts, strict=False) if count)
