"""The law called as MuJoCo calls it from C: with the address of `mjData`.

Only compiled code can run these functions; the Python engine reads the same fields through MuJoCo's bindings (see
`callbacks`).
"""

from typing import Any, NamedTuple

import mujoco
import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.numpy_support import carray

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.contact import INACTIVE, apply_pad_load, begin_step
from slipwise.simulation.kernel.curved_face import set_faces
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.mjdata import Offsets
from slipwise.simulation.kernel.places import CURVED, N_DOFS, N_PADS, PAD_GEOM
from slipwise.simulation.kernel.step import control_step, sensor_step

#: A length given to arrays whose length MuJoCo knows: no rig has as many numbers.
_LONG = 1 << 24
_ACCELERATION = int(mujoco.mjtStage.mjSTAGE_ACC)


class Fields(NamedTuple):
    """Where the fields stand: those of `mjData` in words of 8 bytes (`ncon` of 4), those of `mjContact` in 4 bytes."""

    size: int
    time: int
    ncon: int
    contact: int
    userdata: int
    qvel: int
    ctrl: int
    qpos: int
    qacc: int
    qfrc_applied: int
    qfrc_constraint: int
    ten_length: int
    ten_velocity: int
    efc_frictionloss: int
    efc_pos: int
    efc_vel: int
    efc_J: int  # noqa: N815 - MuJoCo's name
    efc_aref: int
    efc_force: int
    sensordata: int
    contact_size: int
    geom1: int
    geom2: int
    efc_address: int


def fields(found: Offsets) -> Fields:
    """Count the offsets of MuJoCo's structs in words."""
    data = {name: offset // (4 if name == "ncon" else 8) for name, offset in found.data.items()}
    contact = {name: offset // 4 for name, offset in found.contact.items()}
    return Fields(
        size=max(found.data.values()) // 8 + 1,
        contact_size=found.contact_size // 4,
        **data,
        **contact,
    )


def _pointer(typingctx: Any, address: Any) -> Any:  # noqa: ARG001 - numba's signature
    """Turn an integer address into a pointer that `numba.carray` takes."""

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], cgutils.voidptr_t)

    return types.voidptr(types.intp), codegen


_as_pointer: Any = intrinsic(_pointer)


@compilable
def _numbers(address: Any) -> Array:
    """Return the floating-point numbers that stand at an address."""
    return carray(_as_pointer(address), (_LONG,), np.float64)


@compilable
def control_at(effects: Dispatch, at: Fields, data: int) -> None:
    """Do `control_step` on the `mjData` at the address `data`, once the pads' loads are known.

    Only a contact that has a row of constraints is near enough to bear anything. The row itself is kept from acting.
    """
    words = carray(_as_pointer(data), (at.size,), np.int64)
    u = _numbers(words[at.userdata])
    applied = _numbers(words[at.qfrc_applied])
    position = _numbers(words[at.efc_pos])
    velocity = _numbers(words[at.efc_vel])
    jacobian = _numbers(words[at.efc_J])
    reference = _numbers(words[at.efc_aref])
    begin_step(u, effects.first_pad, effects.pad_block, applied)
    if u[CURVED] > 0.0:
        set_faces(effects, u, _numbers(words[at.ten_length]), _numbers(words[at.ten_velocity]))
    dofs = int(u[N_DOFS])
    for i in range(carray(_as_pointer(data), (2 * at.size,), np.int32)[at.ncon]):
        contact = carray(_as_pointer(words[at.contact] + 4 * i * at.contact_size), (at.contact_size,), np.int32)
        row = contact[at.efc_address]
        if row >= 0:
            reference[row] = INACTIVE
            for pad in range(int(u[N_PADS])):
                z = effects.first_pad + pad * effects.pad_block
                geom = int(u[z + PAD_GEOM])
                if contact[at.geom1] == geom or contact[at.geom2] == geom:
                    push = jacobian[row * dofs : (row + 1) * dofs]
                    apply_pad_load(u, z, -float(position[row]), -float(velocity[row]), push, applied)
    control_step(
        effects,
        u,
        _numbers(data)[at.time],
        _numbers(words[at.ten_length]),
        _numbers(words[at.ten_velocity]),
        _numbers(words[at.qvel]),
        _numbers(words[at.efc_frictionloss]),
        applied,
    )


@compilable
def sensor_at(effects: Dispatch, at: Fields, data: int, stage: int) -> None:
    """Do `sensor_step` on the `mjData` at the address `data`, once its accelerations are known."""
    if stage != _ACCELERATION:
        return
    words = carray(_as_pointer(data), (at.size,), np.int64)
    sensor_step(
        effects,
        _numbers(words[at.userdata]),
        _numbers(data)[at.time],
        _numbers(words[at.ten_length]),
        _numbers(words[at.ten_velocity]),
        _numbers(words[at.efc_force]),
        _numbers(words[at.ctrl]),
        _numbers(words[at.qacc]),
        _numbers(words[at.qpos]),
        _numbers(words[at.qfrc_constraint]),
        _numbers(words[at.sensordata]),
    )
