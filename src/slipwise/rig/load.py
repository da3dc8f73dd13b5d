"""From the MJCF file of a rig to a specimen: every value that a replay uses, and a check that nothing else counts."""

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.errors import SettingError, UnknownNameError
from slipwise.rig.mjcf import Mjcf, read_mjcf
from slipwise.rig.mjcf_attributes import check_attributes
from slipwise.rig.mjcf_parts import WORDS, buffers_of, check_parts, is_free, names_of, pads_of
from slipwise.rig.mjcf_places import buffer_places, centre_of_gravity, edge_distance, pad_places, pad_radius, seating
from slipwise.rig.mjcf_tendons import buffer_height, buffer_stiffness, check_arms
from slipwise.rig.rest_check import check_rest
from slipwise.rig.specimen import Specimen, find_rig, out_of_bounds

#: Products of inertia below this share of the largest moment are rounding [1].
_SAME = 1e-6


def load_specimen(rig: str | Path, beside: Path | None = None) -> Specimen:
    """Read a specimen's rated values from its MJCF file.

    Args:
        rig: a name of `RIGS` or the path of an MJCF file that names its parts as they do.
        beside: folder from which a relative path is meant.

    Raises:
        UnknownNameError: no such rig.
        InputError: the file is no MJCF, a part is missing in it, it holds what would not be simulated, or its pads do
            not carry its weight at rest. The message names the element.
    """
    file = read_mjcf(find_rig(rig, beside))
    check_parts(file)
    check_attributes(file)
    specimen = _specimen(file)
    check_rest(file, specimen)
    return specimen


def _specimen(file: Mjcf) -> Specimen:
    """Collect a specimen's values, each held to what a rig can have where its element can still be named."""
    model = file.model
    centre = centre_of_gravity(file)
    pads = pads_of(file)
    heights = seating(file)
    check_arms(file)
    numbers = {name: float(model.numeric(name).data[0]) for name in names_of(model, "numeric")}
    texts = {text.name: text.data for text in file.spec.texts}
    body = ("inertial", "", "girder") if file.spec.body("girder").explicitinertial else ("body", "girder", "")
    place = ("body", "girder", "")
    values: dict[str, tuple[Any, tuple[str, str, str]]] = {
        "mass": (float(model.body("girder").mass[0]), body),
        "inertia": (_inertia(file), body),
        "centre_height": (float(centre[2]), place),
        "centre_x": (float(centre[0]), place),
        "centre_y": (float(centre[1]), place),
        "pad_places": (pad_places(file), ("geom", f"pad_{pads[0]}", "")),
        "pad_radius": (pad_radius(file), ("geom", f"pad_{pads[0]}", "")),
        "seating": (heights, ("geom", f"pad_{pads[0]}", "")),
        "edge_distance": (edge_distance(file), ("site", "girder_edge_1", "")),
        "gravity": (-float(model.opt.gravity[2]), ("option", "", "")),
        "buffer_height": (buffer_height(file), ("tendon", "buffer_1_x", "")),
        "buffer_places": (buffer_places(file), ("geom", "buffer_1", "")),
        **{name: (number, ("numeric", name, "")) for name, number in numbers.items()},
        **{name: (texts[name], ("text", name, "")) for name in WORDS if name in texts},
    }
    for i, (buffer, stiffness) in enumerate(zip(buffers_of(file), buffer_stiffness(file), strict=True)):
        values[f"buffer_stiffness {i}"] = (stiffness, ("tendon", f"buffer_{buffer}_x", ""))
    for name, (value, element) in values.items():
        if wrong := out_of_bounds(name.split()[0], value):
            raise file.refused(wrong, *element)
    try:
        return Specimen(
            name=file.path.stem,
            path=file.path,
            pads=pads,
            free=is_free(model),
            buffer_stiffness=buffer_stiffness(file),
            sources={n.removeprefix("source "): data for n, data in texts.items() if n.startswith("source ")},
            **{name: value for name, (value, _) in values.items() if " " not in name},
        )
    except (SettingError, UnknownNameError) as error:
        heavy = "bending_mass" in numbers and numbers["bending_mass"] >= values["mass"][0]
        word = next((name for name in WORDS if name in texts), "")
        raise file.refused(str(error), *(("numeric", "bending_mass") if heavy else ("text", word))) from None


def _inertia(file: Mjcf) -> tuple[float, float, float]:
    """Give the girder's moments of inertia about the axes x, y, z through its centre of gravity [kg m^2].

    Raises:
        InputError: its principal axes are others.
    """
    girder = file.model.body("girder")
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, girder.iquat)
    axes: NDArray[np.float64] = turned.reshape(3, 3)
    whole = axes @ np.diag(girder.inertia) @ axes.T
    if np.abs(whole - np.diag(np.diag(whole))).max() > _SAME * np.diag(whole).max():
        xy, xz, yz = whole[0, 1], whole[0, 2], whole[1, 2]
        raise file.refused(
            f"the girder has products of inertia {xy:g}, {xz:g}, {yz:g} kg m^2 (xy, xz, yz), which would not be "
            "simulated; its principal axes are those of the table: give diaginertia",
            "inertial",
            "",
            "girder",
        )
    upright = np.array_equal(girder.iquat, [1.0, 0.0, 0.0, 0.0])
    moments = girder.inertia if upright else np.diag(whole)
    return float(moments[0]), float(moments[1]), float(moments[2])
