"""Writes the MJCF of a specimen: the file that any MuJoCo viewer opens, and the text from which a replay is built.

Everything stands in one file, what all rigs share (`models/common.xml`) included, so that it can be passed on.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from slipwise.rig.files import models_folder
from slipwise.rig.specimen import Specimen
from slipwise.rig.storeys import Storey

#: What the table reaches beyond the pads, the girder's deck above the sliding plane, half the thickness of deck and
#: floors, and half that of a column [m]: for the eye alone.
_MARGIN, _DECK, _HALF_DECK, _HALF_FLOOR, _COLUMN = 0.25, 0.08, 0.06, 0.03, 0.04
#: Thickness of plates and soles, half of it [m].
_PLATE = 0.01
#: Inertia of a floor about its own middle over the girder's [1].
_SMALL = 1e-6
_DRIVEN = ("table_x slide 1 0 0", "table_y slide 0 1 0", "table_z slide 0 0 1", "table_pitch hinge 0 1 0")
_FREE = (
    "girder_x slide 1 0 0", "girder_y slide 0 1 0", "girder_z slide 0 0 1", "girder_roll hinge 1 0 0",
    "girder_pitch hinge 0 1 0", "girder_yaw hinge 0 0 1",
)  # fmt: skip


def mjcf_text(specimen: Specimen) -> str:
    """Write a specimen's MJCF; `load_specimen` reads the same specimen from it."""
    common = (models_folder() / "common.xml").read_text(encoding="utf-8")
    shared = common.partition("<mujoco>")[2].rpartition("</mujoco>")[0].rstrip()
    girder, inside = _girder(specimen), "      " if specimen.free else "    "
    free_girder = [f"{inside}{line}" for line in girder] if specimen.free else []
    guided_girder = [] if specimen.free else [f"{inside}{line}" for line in girder]
    lines = [
        f'<mujoco model="{_escaped(specimen.name)}">{shared}',
        *(["", f'  <option gravity="0 0 {-specimen.gravity!r}"/>']),
        "",
        "  <custom>",
        *(f"    {line}" for line in _custom(specimen)),
        "  </custom>",
        "",
        "  <worldbody>",
        '    <body name="table">',
        *(f"      {line}" for line in _table(specimen)),
        *free_girder,
        "    </body>",
        *guided_girder,
        "  </worldbody>",
        "",
        "  <tendon>",
        *(f"    {line}" for line in _tendons(specimen)),
        "  </tendon>",
        "",
        "  <actuator>",
        *(f"    {line}" for line in _actuators(specimen)),
        "  </actuator>",
        "</mujoco>",
    ]
    return "\n".join(lines) + "\n"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _joints(joints: Iterable[str], more: str = "") -> list[str]:
    parts = [joint.split(maxsplit=2) for joint in joints]
    return [f'<joint name="{name}" type="{kind}" axis="{axis}"{more}/>' for name, kind, axis in parts]


def _custom(specimen: Specimen) -> list[str]:
    out = [f'<text name="source {what}" data="{_escaped(words)}"/>' for what, words in specimen.sources.items()]
    out += [f'<text name="{word}" data="{getattr(specimen, word)}"/>' for word in ("pads_on", "stick_capacity")]
    out += [] if specimen.slides else [f'<text name="friction" data="{specimen.friction}"/>']
    values: dict[str, tuple[float, ...]] = {
        "pad_stiffness": tuple(p.stiffness for p in specimen.places),
        "pad_damping": tuple(p.damping for p in specimen.places),
        "plastic_pressure": (specimen.plastic_pressure,),
        "shear_strength": (specimen.shear_strength,),
    }
    if specimen.bending_mass:
        values |= {
            name: (getattr(specimen, name),) for name in ("bending_mass", "bending_frequency", "bending_damping")
        }
    if any(p.curvature for p in specimen.places):
        values["pad_curvature"] = tuple(p.curvature for p in specimen.places)
    for name, given in values.items():
        out.append(f'<numeric name="{name}" data="{_numbers(given[:1] if len(set(given)) == 1 else given)}"/>')
    return out


def _escaped(words: str) -> str:
    return words.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")


def _table(specimen: Specimen) -> list[str]:
    half = np.abs(np.array([*specimen.pad_places, *specimen.buffer_places])).max(axis=0) + _MARGIN
    out = _joints(_DRIVEN, ' class="driven"')
    size = f'size="{_numbers([*half, 0.1])}"'
    out.append(f'<geom name="table" type="box" {size} pos="0 0 -0.255" material="table" class="visual" mass="1"/>')
    for bit, pad in enumerate(specimen.places):
        at = f"{_numbers([pad.x, pad.y])}"
        out += [
            f'<geom name="pad_{pad.name}" class="pad" contype="{1 << bit}" size="{pad.radius!r}" '
            f'pos="{at} {pad.z - pad.radius!r}"/>',
            f'<geom name="disc_{pad.name}" class="disc" size="{pad.radius!r} 0.004" pos="{at} -0.004"/>',
            f'<geom name="cell_{pad.name}" class="cell" pos="{at} -0.105"/>',
        ]
    for buffer in specimen.buffers:
        at = _numbers([buffer.x, buffer.y])
        out.append(
            f'<geom name="buffer_{buffer.name}" type="cylinder" size="0.12 0.06" pos="{at} -0.095" material="rubber" '
            'class="visual"/>'
        )
    return out


def _girder(specimen: Specimen) -> list[str]:
    """Write the girder's body, whose frame stands at its centre of gravity."""
    centre = np.array([specimen.centre_x, specimen.centre_y, specimen.centre_height])
    places = np.array(specimen.pad_places)
    low, high = places.min(axis=0), places.max(axis=0)
    middle, half = 0.5 * (low + high) - centre[:2], np.maximum(0.5 * (high - low), 0.3)
    inside = _joints(_FREE if specimen.free else _FREE[2:3])
    inside.append(f'<inertial pos="0 0 0" mass="{specimen.mass!r}" diaginertia="{_numbers(specimen.inertia)}"/>')
    look = 'material="girder" class="visual"'
    deck = _numbers([*middle, _DECK - centre[2]])
    inside.append(f'<geom name="deck" type="box" size="{_numbers([*half, _HALF_DECK])}" pos="{deck}" {look}/>')
    thick = min(0.12, 0.5 * centre[2])
    weight = f'size="{_numbers([*0.5 * half, thick])}" pos="0 0 0" material="steel"'
    inside.append(f'<geom name="weight" type="box" {weight} class="visual"/>')
    inside += _upright("post", np.zeros(2), 0.15 * half, _DECK + _HALF_DECK - centre[2], -thick)
    for bit, pad in enumerate(specimen.places):
        at = _numbers([pad.x - centre[0], pad.y - centre[1], _PLATE - centre[2]])
        inside.append(f'<geom name="plate_{pad.name}" class="plate" conaffinity="{1 << bit}" pos="{at}"/>')
        inside.append(f'<geom name="sole_{pad.name}" class="sole" pos="{at}"/>')
    for buffer in specimen.buffers:
        at = _numbers([buffer.x - centre[0], buffer.y - centre[1], -centre[2]])
        name = f'name="key_{buffer.name}"'
        inside.append(f'<geom {name} type="cylinder" size="0.025 0.05" pos="{at}" material="steel" class="visual"/>')
    inside.append('<site name="girder_centre" pos="0 0 0" size="0.03" rgba="0.8 0.1 0.1 1"/>')
    if specimen.free:
        for edge, x in ((1, specimen.edge_distance), (2, -specimen.edge_distance)):
            inside.append(f'<site name="girder_edge_{edge}" pos="{x!r} 0 0" size="0.02" rgba="0.1 0.1 0.8 1"/>')
    inside += _frame(specimen, specimen.storeys, 1, float(centre[2]), _DECK + _HALF_DECK)
    return [f'<body name="girder" pos="{_numbers(centre)}">', *(f"  {line}" for line in inside), "</body>"]


def _upright(name: str, at: np.ndarray, half: np.ndarray, foot: float, head: float) -> list[str]:
    """Write what stands between two heights [m], for the eye; nothing where there is no room."""
    if head <= foot:
        return []
    size, middle = _numbers([*half, 0.5 * (head - foot)]), _numbers([*at, 0.5 * (head + foot)])
    return [f'<geom name="{name}" type="box" size="{size}" pos="{middle}" material="steel" class="visual"/>']


def storey_names(storeys: Sequence[Storey]) -> tuple[str, ...]:
    """Return what the storeys are called, in the MJCF and in channels, from below: "storey_1" ..."""
    return tuple(f"storey_{number}" for number in range(1, len(storeys) + 1))


def _frame(specimen: Specimen, storeys: Sequence[Storey], number: int, below: float, foot: float) -> list[str]:
    """Write a storey, the others upon it, as bodies that slide on what is below.

    The origin of that stands at a height [m], `below`, and the foot of the columns at another, both above the slide.

    A floor is a mass without an inertia of its own, which MuJoCo must have: a millionth of the girder's.
    """
    if not storeys:
        return []
    storey, name = storeys[0], f"storey_{number}"
    joints = (
        ("x", "1 0 0", storey.stiffness_x, storey.damping_x),
        ("y", "0 1 0", storey.stiffness_y, storey.damping_y),
    )
    inside = [
        f'<joint name="{name}_{axis}" type="slide" axis="{along}" stiffness="{stiffness!r}" damping="{damping!r}"/>'
        for axis, along, stiffness, damping in joints
    ]
    inertia = _numbers([_SMALL * max(specimen.inertia)] * 3)
    half = np.maximum(0.8 * np.array(specimen.half_spacing), 0.2)
    size, ends = _numbers([*half, _HALF_FLOOR]), (foot - storey.z, -_HALF_FLOOR)
    corners = [(x, y) for x in (1.0, -1.0) for y in (1.0, -1.0)]
    columns = [
        _upright(f"{name}_column_{i}", (half - _COLUMN) * corner, np.full(2, _COLUMN), *ends)
        for i, corner in enumerate(corners, 1)
    ]
    inside += [
        f'<inertial pos="0 0 0" mass="{storey.mass!r}" diaginertia="{inertia}"/>',
        f'<geom name="{name}" type="box" size="{size}" material="girder" class="visual"/>',
        f'<site name="{name}" pos="0 0 0" size="0.03" rgba="0.8 0.1 0.1 1"/>',
        *(line for column in columns for line in column),
        *_frame(specimen, storeys[1:], number + 1, storey.z, storey.z + _HALF_FLOOR),
    ]
    return [f'<body name="{name}" pos="0 0 {storey.z - below!r}">', *(f"  {line}" for line in inside), "</body>"]


def _tendons(specimen: Specimen) -> list[str]:
    """Write the slip of the soffit over each pad and of each key: rate v = v_centre + turning x arm."""
    out: list[str] = []
    if not specimen.free:
        joints = {axis: {f"table_{axis}": -1.0} for axis in "xy"}
        return [_fixed(f"pad_{p.name}_{a}", 'class="friction"', joints[a]) for p in specimen.places for a in "xy"]
    centre = (specimen.centre_x, specimen.centre_y, specimen.centre_height)
    for pad in specimen.places:
        for axis, joints in arms(centre, (pad.x, pad.y, 0.0)).items():
            out.append(_fixed(f"pad_{pad.name}_{axis}", 'class="friction"', joints))
    for buffer in specimen.buffers:
        play = f' springlength="{-buffer.gap!r} {buffer.gap!r}"' if buffer.gap else ""
        for axis, joints in arms(centre, (buffer.x, buffer.y, buffer.z)).items():
            stiffness = buffer.stiffness_x if axis == "x" else buffer.stiffness_y
            out.append(_fixed(f"buffer_{buffer.name}_{axis}", f'stiffness="{stiffness!r}"{play}', joints))
    return out


def arms(centre: Sequence[float], place: Sequence[float]) -> dict[str, dict[str, float]]:
    """Return the girder's joints that move a place along x and y, each with what its rate is multiplied by [1 or m].

    Args:
        centre: about which the girder turns (3,) [m].
        place: where a pad or a buffer acts on it (3,) [m].
    """
    x, y, z = (at - middle for at, middle in zip(place, centre, strict=True))
    return {
        "x": {"girder_x": 1.0, "girder_pitch": z, "girder_yaw": -y},
        "y": {"girder_y": 1.0, "girder_roll": -z, "girder_yaw": x},
    }


def _fixed(name: str, attributes: str, joints: dict[str, float]) -> str:
    inside = "".join(f'<joint joint="{joint}" coef="{value!r}"/>' for joint, value in joints.items())
    return f'<fixed name="{name}" {attributes}>{inside}</fixed>'


def _actuators(specimen: Specimen) -> list[str]:
    bias = f' biastype="affine" biasprm="{specimen.weight!r} 0 0"'
    drives = (("ax", "x", ""), ("ay", "y", ""), ("az", "z", bias), ("apitch", "pitch", ""))
    return [f'<general name="table_{a}" joint="table_{joint}" gainprm="1e10"{more}/>' for a, joint, more in drives]
