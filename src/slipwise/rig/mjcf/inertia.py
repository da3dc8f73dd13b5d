"""What the girder of an MJCF file weighs: the body itself with all bodies that are fixed to it."""

from dataclasses import dataclass

import mujoco
import numpy as np

from slipwise.arrays import Array
from slipwise.rig.mjcf.file import Mjcf

#: Products of inertia below this share of the largest moment are rounding [1].
_SAME = 1e-6


@dataclass(frozen=True)
class GirderBody:
    """The girder as one rigid body.

    Attributes:
        mass: [kg].
        centre: of gravity, from the middle of the sliding plane (3,) [m].
        inertia: (3, 3) about it, along the axes of the table [kg m^2].
    """

    mass: float
    centre: Array
    inertia: Array


def bodies_of_girder(model: mujoco.MjModel) -> list[int]:
    """Return the girder's body and those that are fixed to it, by their ids."""
    girder = model.body("girder").id
    inside = [girder]
    for body in range(girder + 1, model.nbody):
        if model.body_jntnum[body]:
            continue  # a storey moves by itself
        if model.body_parentid[body] in inside:
            inside.append(body)
    return inside


def girder_body(file: Mjcf) -> GirderBody:
    """Join the girder and the bodies that are fixed to it: I = sum (I_i + m_i (d_i^2 1 - d_i d_i^T))."""
    model, girder = file.model, file.model.body("girder")
    bodies = bodies_of_girder(model)
    if len(bodies) == 1:
        return GirderBody(float(girder.mass[0]), girder.pos + girder.ipos, _turned(girder.inertia, girder.iquat))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    masses = model.body_mass[bodies]
    centre = masses @ data.xipos[bodies] / masses.sum()
    inertia = np.zeros((3, 3))
    for body, mass in zip(bodies, masses, strict=True):
        axes, off = data.ximat[body].reshape(3, 3), data.xipos[body] - centre
        inertia += axes @ np.diag(model.body_inertia[body]) @ axes.T
        inertia += mass * (off @ off * np.eye(3) - np.outer(off, off))
    return GirderBody(float(masses.sum()), centre, inertia)


def _turned(moments: Array, quaternion: Array) -> Array:
    if np.array_equal(quaternion, [1.0, 0.0, 0.0, 0.0]):
        return np.diag(moments)
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    axes = matrix.reshape(3, 3)
    return axes @ np.diag(moments) @ axes.T


def principal_inertia(file: Mjcf, body: GirderBody) -> tuple[float, float, float]:
    """Return the girder's moments of inertia about the axes x, y, z through its centre of gravity [kg m^2].

    Raises:
        InputError: its principal axes are others.
    """
    whole, moments = body.inertia, np.diag(body.inertia)
    if np.abs(whole - np.diag(moments)).max() > _SAME * moments.max():
        xy, xz, yz = whole[0, 1], whole[0, 2], whole[1, 2]
        raise file.refused(
            f"the girder has products of inertia {xy:g}, {xz:g}, {yz:g} kg m^2 (xy, xz, yz), which would not be "
            "simulated; its principal axes are those of the table: give diaginertia",
            "inertial",
            "",
            "girder",
        )
    return float(moments[0]), float(moments[1]), float(moments[2])
