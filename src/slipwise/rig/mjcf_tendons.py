"""What the tendons of a rig's MJCF file say: where pads and buffers act on the girder, and how stiff buffers are."""

from collections.abc import Mapping

import mujoco

from slipwise.rig.mjcf import Mjcf
from slipwise.rig.mjcf_parts import buffers_of, is_free, pads_of
from slipwise.rig.mjcf_places import buffer_places, pad_places

#: Arms and coefficients that differ by less are the same [m or 1].
_SAME = 1e-6


def buffer_stiffness(file: Mjcf) -> tuple[float, ...]:
    """Give the horizontal stiffness of each buffer [N/m].

    Raises:
        InputError: a buffer is not as stiff along y as along x.
    """
    model = file.model
    out = []
    for buffer in buffers_of(file):
        x, y = (float(model.tendon_stiffness[model.tendon(f"buffer_{buffer}_{axis}").id]) for axis in "xy")
        if x != y:
            raise file.refused(
                f"buffer {buffer} has a stiffness of {y:g} N/m along y, {x:g} N/m along x; a buffer is round, give "
                "both tendons the same",
                "tendon",
                f"buffer_{buffer}_y",
            )
        out.append(x)
    return tuple(out)


def buffer_height(file: Mjcf) -> float:
    """Give the height of the buffers' force above the sliding plane [m], from the arm about the girder's pitch axis."""
    buffers = buffers_of(file)
    if not buffers:
        return 0.0
    arm = _coefficients(file.model, f"buffer_{buffers[0]}_x").get("girder_pitch", 0.0)
    height = float(file.model.body("girder").pos[2]) + arm
    return 0.0 if abs(height) <= _SAME else height


def check_arms(file: Mjcf) -> None:
    """Hold the coefficients of all tendons to the places of pads and buffers, from which a replay computes them.

    Slip over a place is v = v_girder + turning rates x arm. An arm in plan may be counted from the girder, or from the
    middle of the table, which is the same for a girder that stands there.

    Raises:
        InputError: a coefficient is another; the message gives the right one.
    """
    if not is_free(file.model):
        for axis in "xy":
            _hold(file, f"pad_{pads_of(file)[0]}_{axis}", {f"table_{axis}": (-1.0,)})
        return
    girder_x, girder_y, height = (float(v) for v in file.model.body("girder").pos)
    arms = {f"pad_{pad}": (*place, 0.0) for pad, place in zip(pads_of(file), pad_places(file), strict=True)}
    lift = buffer_height(file)
    arms |= {f"buffer_{b}": (*place, lift) for b, place in zip(buffers_of(file), buffer_places(file), strict=True)}
    for part, (x, y, z) in arms.items():
        _hold(
            file,
            f"{part}_x",
            {"girder_x": (1.0,), "girder_pitch": (z - height,), "girder_yaw": (girder_y - y, -y)},
        )
        _hold(
            file,
            f"{part}_y",
            {"girder_y": (1.0,), "girder_roll": (height - z,), "girder_yaw": (x - girder_x, x)},
        )


def _hold(file: Mjcf, tendon: str, wanted: Mapping[str, tuple[float, ...]]) -> None:
    given = _coefficients(file.model, tendon)
    for joint in {**given, **wanted}:
        possible, value = wanted.get(joint, (0.0,)), given.get(joint, 0.0)
        if not any(abs(value - right) <= _SAME for right in possible):
            raise file.refused(
                f"the tendon {tendon!r} has the coefficient {value:g} of the joint {joint}; from the places of girder, "
                f"pad and buffer it is {possible[0]:g}",
                "tendon",
                tendon,
            )


def _coefficients(model: mujoco.MjModel, tendon: str) -> dict[str, float]:
    """Give joint -> coefficient of a fixed tendon."""
    out: dict[str, float] = {}
    at = model.tendon(tendon).id
    start = int(model.tendon_adr[at])
    for wrap in range(start, start + int(model.tendon_num[at])):
        joint = model.joint(int(model.wrap_objid[wrap])).name
        out[joint] = out.get(joint, 0.0) + float(model.wrap_prm[wrap])
    return out
