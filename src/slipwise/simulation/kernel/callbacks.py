"""Installs the law as MuJoCo's callbacks, for as long as a simulation runs.

Callbacks are global to the process, and MuJoCo calls them while it compiles a model: they are installed after compiling
and always removed again. Nesting is refused, for the inner law would silently act on the outer simulation.
"""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import mujoco

from slipwise.errors import SettingError
from slipwise.simulation.kernel import places
from slipwise.simulation.kernel.contact import INACTIVE, apply_pad_load, begin_step
from slipwise.simulation.kernel.engine import Kernel

_CONTROL = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
_SENSOR = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int)


@contextmanager
def installed(law: Kernel) -> Iterator[None]:
    """Install a law's callbacks; they are gone again when the block ends.

    Raises:
        SettingError: callbacks are installed already.
    """
    if mujoco.get_mjcb_control() is not None or mujoco.get_mjcb_sensor() is not None:
        raise SettingError("a simulation with callbacks is running in this process already; let it end first")
    if law.callbacks is not None:
        control, sensor = _CONTROL(law.callbacks[0]), _SENSOR(law.callbacks[1])
    else:
        control, sensor = _python_callbacks(law)
    try:
        mujoco.set_mjcb_control(control)
        mujoco.set_mjcb_sensor(sensor)
        yield
    finally:
        mujoco.set_mjcb_control(None)
        mujoco.set_mjcb_sensor(None)


def _python_callbacks(law: Kernel) -> tuple[Any, Any]:
    """Make the callbacks of the Python engine: the same law on numpy views."""
    control_step, sensor_step = law.functions["control_step"], law.functions["sensor_step"]
    set_faces = law.functions["set_faces"]
    acceleration = int(mujoco.mjtStage.mjSTAGE_ACC)
    first_pad, size = law.layout.first_pad, law.layout.pad_block

    def control(model: Any, data: Any) -> None:
        u, contact = data.userdata, data.contact
        blocks = range(first_pad, first_pad + int(u[places.N_PADS]) * size, size)
        begin_step(u, first_pad, size, data.qfrc_applied)
        if u[places.CURVED] > 0.0:
            set_faces(u, data.ten_length, data.ten_velocity)
        push = data.efc_J.reshape(data.nefc, model.nv)
        for first, second, row in zip(contact.geom1, contact.geom2, contact.efc_address, strict=True):
            if row >= 0:
                data.efc_aref[row] = INACTIVE
                for z in blocks:
                    if int(u[z + places.PAD_GEOM]) in (first, second):
                        apply_pad_load(u, z, -data.efc_pos[row], -data.efc_vel[row], push[row], data.qfrc_applied)
        control_step(
            u, data.time, data.ten_length, data.ten_velocity, data.qvel, data.efc_frictionloss, data.qfrc_applied
        )

    def sensor(model: Any, data: Any, stage: int) -> None:
        if stage == acceleration:
            sensor_step(
                data.userdata, data.time, data.ten_length, data.ten_velocity, data.efc_force, data.ctrl, data.qacc,
                data.qpos, data.qfrc_constraint, data.sensordata,
            )  # fmt: skip

    return control, sensor
