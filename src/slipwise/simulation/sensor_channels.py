"""From MuJoCo's sensors to the channels of a record; all of one instant."""

from collections.abc import Callable

import numpy as np

from slipwise.arrays import Array
from slipwise.rig import Rig, storey_names

Reader = Callable[[str], Array]


def sensor(rig: Rig, name: str, sensordata: Array) -> Array:
    """Return the columns of one sensor, (..., dim)."""
    return sensordata[..., rig.sensors[name]]


def has_sensor(rig: Rig, name: str) -> bool:
    """Return whether the model has a sensor of this name."""
    return name in rig.sensors


def to_channels(rig: Rig, sensordata: Array, control: Array, dt: float, pitching: bool) -> dict[str, Array]:
    """Turn what a simulation read into channels, each (n,) in SI.

    Args:
        rig: that was shaken.
        sensordata: (n, n_sensors).
        control: (n, 4) command of the table.
        dt: step of the simulation [s].
        pitching: whether the table turns at any time of the run, which then has a channel for it.
    """
    specimen = rig.specimen
    out: dict[str, Array] = {f"table_a{axis}": control[:, i] for i, axis in enumerate("xyz")}

    def one(name: str) -> Array:
        return sensor(rig, name, sensordata)[:, 0] if has_sensor(rig, name) else np.zeros(len(sensordata))

    for axis in "xyz":
        out[f"table_d{axis}"] = one(f"at_table_{axis}")
    if pitching:
        out["table_pitch"] = one("at_table_pitch")
    # MuJoCo's accelerations are those of a frame in free fall: at rest they read +g.
    centre = sensor(rig, "girder_centre", sensordata) - [0.0, 0.0, specimen.gravity]
    for i, axis in enumerate("xyz"):
        out[f"girder_a{axis}"] = centre[:, i]
    for edge in ("1", "2"):
        if has_sensor(rig, f"girder_edge_{edge}"):
            out[f"girder_az_{edge}"] = sensor(rig, f"girder_edge_{edge}", sensordata)[:, 2] - specimen.gravity
    for storey in storey_names(specimen.storeys):
        for i, axis in enumerate("xy"):
            out[f"{storey}_a{axis}"] = sensor(rig, storey, sensordata)[:, i]
    half_step = 0.5 * dt
    if specimen.free:
        turning = sensor(rig, "turning", sensordata)
        out.update(_motion(rig, one, half_step, centre - control[:, :3], turning))
    else:
        out.update(_prescribed(one, half_step, control))
    user = sensor(rig, "pads", sensordata)
    for i, (pad, area) in enumerate(zip(specimen.pads, specimen.pad_areas, strict=True)):
        out[f"pad_{pad}_N"] = user[:, 3 * i]
        out[f"pad_{pad}_Fx"] = user[:, 3 * i + 1]
        out[f"pad_{pad}_Fy"] = user[:, 3 * i + 2]
        out[f"pad_{pad}_P"] = user[:, 3 * i] / area
    for i, buffer in enumerate(specimen.buffers):
        for j, axis in enumerate("xy"):
            out[f"buffer_{buffer.name}_F{axis}"] = user[:, 3 * len(specimen.pads) + 2 * i + j]
    return {name: np.ascontiguousarray(values) for name, values in out.items()}


def _motion(rig: Rig, one: Reader, half_step: float, acceleration: Array, turning: Array) -> dict[str, Array]:
    """Slip at the middle of the sliding plane, and the girder's turning, relative to the table.

    The integrator's velocities stand half a step behind its positions: acceleration (n, 3) brings them to one instant.
    """
    specimen = rig.specimen
    h, cx, cy = specimen.centre_height, specimen.centre_x, specimen.centre_y
    at = {name: one(f"at_girder_{name}") for name in ("x", "y", "z", "roll", "pitch", "yaw")}
    columns = (*acceleration.T[:2], *turning.T)
    names = ("x", "y", "roll", "pitch", "yaw")
    rate = {n: one(f"rate_girder_{n}") + half_step * a for n, a in zip(names, columns, strict=True)}
    return {
        "yaw": at["yaw"],
        "pitch": at["pitch"],
        "roll": at["roll"],
        "heave": at["z"],
        "slip_x": at["x"] - h * at["pitch"] + cy * at["yaw"],
        "slip_y": at["y"] + h * at["roll"] - cx * at["yaw"],
        "slip_vx": rate["x"] - h * rate["pitch"] + cy * rate["yaw"],
        "slip_vy": rate["y"] + h * rate["roll"] - cx * rate["yaw"],
    }


def _prescribed(one: Reader, half_step: float, control: Array) -> dict[str, Array]:
    """Slip where the table moves under a weight that cannot follow."""
    return {
        "slip_x": -one("at_table_x"),
        "slip_y": -one("at_table_y"),
        "slip_vx": -one("rate_table_x") - half_step * control[:, 0],
        "slip_vy": -one("rate_table_y") - half_step * control[:, 1],
        "heave": one("at_girder_z") - one("at_table_z"),
    }
