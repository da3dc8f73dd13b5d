"""What the tendons of a rig's MJCF file say: where pads and buffers act on the girder, and how stiff buffers are."""

from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.mjcf.parts import buffers_of, is_free, pads_of
from slipwise.rig.mjcf.places import buffer_places, pad_places
from slipwise.rig.mjcf.writer import arms
from slipwise.rig.places import Buffer

#: Arms and coefficients that differ by less are the same [m or 1].
_SAME = 1e-6


def buffers(file: Mjcf) -> tuple[Buffer, ...]:
    """Return the buffers: places, stiffness along x and y, height of their force, and the gap before they are touched.

    Raises:
        InputError: the gap of a buffer is not the same to both sides, or along x another than along y.
    """
    out = []
    for name, (x, y) in zip(buffers_of(file), buffer_places(file), strict=True):
        stiffness_x, stiffness_y = (_of_tendon(file, "stiffness", f"buffer_{name}_{axis}") for axis in "xy")
        gaps = [_gap(file, f"buffer_{name}_{axis}") for axis in "xy"]
        if gaps[0] != gaps[1]:
            raise file.refused(
                f"buffer {name} has a play of {gaps[1]:g} m along y, {gaps[0]:g} m along x; a buffer has one gap: give "
                "both tendons the same springlength",
                "tendon",
                f"buffer_{name}_y",
            )
        out.append(Buffer(name, x, y, _height(file, name), float(stiffness_x), float(stiffness_y), gaps[0]))
    return tuple(out)


def _of_tendon(file: Mjcf, field: str, tendon: str) -> NDArray[np.float64]:
    return getattr(file.model, f"tendon_{field}")[file.model.tendon(tendon).id]


def _gap(file: Mjcf, tendon: str) -> float:
    low, high = (float(length) for length in _of_tendon(file, "lengthspring", tendon))
    if low != -high or high < 0.0:
        raise file.refused(
            f"the tendon {tendon!r} has springlength = {low:g} {high:g}; a buffer stands at rest in the middle of its "
            "gap: give -gap and gap [m]",
            "tendon",
            tendon,
        )
    return high


def _height(file: Mjcf, buffer: str) -> float:
    """Return the height of a buffer's force above the sliding plane [m], from the arm about the girder's pitch axis."""
    arm = _coefficients(file.model, f"buffer_{buffer}_x").get("girder_pitch", 0.0)
    height = float(file.model.body("girder").pos[2]) + arm
    return 0.0 if abs(height) <= _SAME else round(height, 12)  # the arm is written from the centre of gravity


def check_arms(file: Mjcf) -> None:
    """Hold the coefficients of all tendons to the places of pads and buffers, from which a replay computes them.

    Slip over a place is v = v_girder + turning rates x arm. An arm in plan may be counted from the girder, or from the
    middle of the table, which is the same for a girder that stands there.

    Raises:
        InputError: a coefficient is another; the message gives the right one.
    """
    if not is_free(file.model):
        for axis in "xy":
            _hold(file, f"pad_{pads_of(file)[0]}_{axis}", {f"table_{axis}": -1.0}, {})
        return
    girder = [float(v) for v in file.model.body("girder").pos]
    acting = {f"pad_{pad}": (*place, 0.0) for pad, place in zip(pads_of(file), pad_places(file), strict=True)}
    acting |= {f"buffer_{b.name}": (b.x, b.y, b.z) for b in buffers(file)}
    for part, place in acting.items():
        in_plan = arms([0.0, 0.0, girder[2]], place)
        for axis, wanted in arms(girder, place).items():
            _hold(file, f"{part}_{axis}", wanted, in_plan[axis])


def _hold(file: Mjcf, tendon: str, wanted: Mapping[str, float], also: Mapping[str, float]) -> None:
    given = _coefficients(file.model, tendon)
    for joint in {**given, **wanted}:
        value, right = given.get(joint, 0.0), wanted.get(joint, 0.0)
        if min(abs(value - right), abs(value - also.get(joint, right))) > _SAME:
            raise file.refused(
                f"the tendon {tendon!r} has the coefficient {value:g} of the joint {joint}; from the places of girder, "
                f"pad and buffer it is {right + 0.0:g}",
                "tendon",
                tendon,
            )


def _coefficients(model: mujoco.MjModel, tendon: str) -> dict[str, float]:
    """Return joint -> coefficient of a fixed tendon."""
    out: dict[str, float] = {}
    at = model.tendon(tendon).id
    start = int(model.tendon_adr[at])
    for wrap in range(start, start + int(model.tendon_num[at])):
        joint = model.joint(int(model.wrap_objid[wrap])).name
        out[joint] = out.get(joint, 0.0) + float(model.wrap_prm[wrap])
    return out
