"""Which parts the MJCF file of a rig must have, and which it may not: what is not simulated must not be in it."""

import re

import mujoco

from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.mjcf.inertia import bodies_of_girder
from slipwise.rig.places import MOST_PADS

#: The joints of the two bodies, in order; a girder whose slip is prescribed has the second kind only.
TABLE_JOINTS = ("table_x", "table_y", "table_z", "table_pitch")
FREE_JOINTS = ("girder_x", "girder_y", "girder_z", "girder_roll", "girder_pitch", "girder_yaw")
GUIDED_JOINTS = ("girder_z",)
ACTUATORS = ("table_ax", "table_ay", "table_az", "table_apitch")
#: Numbers and words that a file may give: `<numeric>`, the first four needed, and `<text>`.
NUMBERS = ("pad_stiffness", "pad_damping", "plastic_pressure", "shear_strength")
OF_EACH_PAD = ("pad_stiffness", "pad_damping", "pad_curvature")
MORE_NUMBERS = ("pad_curvature", "bending_mass", "bending_frequency", "bending_damping")
WORDS = ("pads_on", "stick_capacity", "friction")
#: What pads and buffers are called, by the convention of names.
_STOREY = re.compile(r"storey_[1-9][0-9]*")
_PAD, _BUFFER = re.compile(r"pad_([A-Za-z0-9]+)"), re.compile(r"buffer_([A-Za-z0-9]+)_[xy]")
#: What acts on a body and has no place in a rig: list in the compiled spec -> what it is called.
_FORBIDDEN = {
    "equalities": "equality constraint",
    "pairs": "contact pair",
    "excludes": "contact exclusion",
    "flexes": "flex",
    "plugins": "plugin",
}
#: Mass that a body beside the girder may have: the table's own is not felt [kg].
_NOTHING = 1e-6
#: Density that MJCF gives a geom of which nothing is said [kg/m^3].
_UNSAID = 1000.0
_FROM_GEOMS = int(mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE)


def names_of(model: mujoco.MjModel, kind: str) -> list[str]:
    """Return the names of all bodies, joints, geoms ... of a compiled model, in order."""
    count = {"joint": "njnt", "actuator": "nu"}.get(kind, f"n{kind}")
    return [getattr(model, kind)(i).name for i in range(getattr(model, count))]


def is_free(model: mujoco.MjModel) -> bool:
    """Return whether the girder can move along the table; if not, its slip is prescribed."""
    return not set(names_of(model, "joint")).isdisjoint({*FREE_JOINTS} - {*GUIDED_JOINTS})


def check_parts(file: Mjcf) -> None:
    """Refuse a rig with parts that would be left out without a word, or without parts that are needed.

    Raises:
        InputError: the message names the part and what is possible.
    """
    for name in ("table", "girder"):
        if name not in names_of(file.model, "body"):
            raise file.refused(f"it lacks the body {name}; a rig has the bodies table and girder, as in bridge1.xml")
    _check_number_of_pads(file)
    _check_bodies(file)
    _check_joints(file)
    _check_geoms(file)
    _check_tendons_and_actuators(file)
    _check_custom(file)
    for group, words in _FORBIDDEN.items():
        for element in getattr(file.spec, group):
            raise file.refused(
                f"the {words} {element.name!r} would not be simulated; a rig has none: remove it, what it does may be "
                "an effect (`slipwise effects`)",
                info=element.info,
            )


def pads_of(file: Mjcf) -> tuple[str, ...]:
    """Return the names of the pads that the file has, in its order."""
    return tuple(match[1] for name in names_of(file.model, "geom") if (match := _PAD.fullmatch(name)))


def buffers_of(file: Mjcf) -> tuple[str, ...]:
    """Return the names of the buffers that the file has, in its order."""
    found = (_BUFFER.fullmatch(name) for name in names_of(file.model, "tendon"))
    return tuple(dict.fromkeys(match[1] for match in found if match))


def _check_number_of_pads(file: Mjcf) -> None:
    pads, free = pads_of(file), is_free(file.model)
    fewest, most = (3, MOST_PADS) if free else (1, 1)
    if not fewest <= len(pads) <= most:
        what = f"that is free has 3 to {MOST_PADS} pads" if free else "whose slip is prescribed has one pad"
        raise file.refused(
            f"it has the pads {', '.join(pads) or '(none)'}; a girder {what}: geoms pad_A ... with tendons pad_A_x, "
            "pad_A_y",
            "geom",
            f"pad_{pads[-1]}" if pads else "",
        )


def _check_bodies(file: Mjcf) -> None:
    model, free = file.model, is_free(file.model)
    fixed = bodies_of_girder(model)
    for i in range(1, model.nbody):
        body = model.body(i)
        mass = float(body.mass[0])
        if body.name in ("table", "girder"):
            parent, wanted = (
                model.body(int(body.parentid[0])).name,
                "table" if body.name == "girder" and free else "world",
            )
            if parent != wanted:
                raise file.refused(
                    f"the body {body.name} lies in {parent!r}; move it into {wanted!r}", "body", body.name
                )
        elif _STOREY.fullmatch(body.name) and free:
            continue  # `storeys.py` holds it to what a storey is
        elif body.jntnum[0] or (mass > _NOTHING and i not in fixed):
            what = f"has a mass of {mass:g} kg, which would not be counted" if mass > _NOTHING else "has joints"
            raise file.refused(
                f"the body {body.name or i!r} {what}; give its mass and inertia to the girder, or fix it to the "
                "girder; besides it only storeys move: storey_1, storey_2 ... as in building.xml",
                "body",
                body.name,
            )


def _check_joints(file: Mjcf) -> None:
    model = file.model
    wanted = {"table": TABLE_JOINTS, "girder": FREE_JOINTS if is_free(model) else GUIDED_JOINTS}
    for body, names in wanted.items():
        there = [model.joint(i).name for i in range(model.njnt) if model.body(int(model.jnt_bodyid[i])).name == body]
        for name in there:
            if name not in names:
                raise file.refused(
                    f"the joint {name!r} of the {body} would not be simulated; it has the joints {', '.join(names)}: "
                    "remove it",
                    "joint",
                    name,
                    body,
                )
        if there != list(names):
            absent = [name for name in names if name not in there]
            words = f"lacks the joints {', '.join(absent)}" if absent else "has its joints in another order"
            raise file.refused(f"the {body} {words}; it needs {', '.join(names)}, as in bridge1.xml", "body", body)


def _check_geoms(file: Mjcf) -> None:
    model, pads = file.model, pads_of(file)
    needed = {f"pad_{pad}": "table" for pad in pads} | {f"plate_{pad}": "girder" for pad in pads}
    needed |= {f"buffer_{buffer}": "table" for buffer in buffers_of(file)}
    names = names_of(model, "geom")
    for name, body in needed.items():
        if name not in names:
            raise file.refused(f"it lacks the geom {name}; each pad has pad_X and plate_X, each buffer buffer_X")
        on = model.body(int(model.geom_bodyid[names.index(name)])).name
        if on != body:
            riding = 'the text pads_on="girder" lets pads travel with it' if on == "girder" else "move it there"
            raise file.refused(f"the geom {name} is part of {on!r}; it belongs to the {body}: {riding}", "geom", name)
    touching = [f"{part}_{pad}" for pad in pads for part in ("pad", "plate")]
    for i, name in enumerate(names):
        if name not in touching and (model.geom_contype[i] or model.geom_conaffinity[i]):
            raise file.refused(
                f"the geom {name or i!r} would touch others, which is not simulated; only pads and plates do: give it "
                'contype="0" conaffinity="0"',
                "geom",
                name,
            )
    _check_geom_masses(file)


def _check_geom_masses(file: Mjcf) -> None:
    """Refuse a mass of a geom that MuJoCo does not count, because the body says its own."""
    if int(file.spec.compiler.inertiafromgeom) == _FROM_GEOMS or not file.spec.body("girder").explicitinertial:
        return
    for geom in (g for body in file.spec.bodies if body.explicitinertial and body.name != "table" for g in body.geoms):
        if geom.mass > 0.0 or geom.density not in (0.0, _UNSAID):
            given = f"mass of {geom.mass:g} kg" if geom.mass > 0.0 else f"density of {geom.density:g} kg/m^3"
            raise file.refused(
                f"the geom {geom.name!r} has a {given}, which would not be counted beside the girder's "
                "<inertial>; add its mass and inertia there",
                "geom",
                geom.name,
                info=geom.info,
            )


def _check_tendons_and_actuators(file: Mjcf) -> None:
    parts = [*(f"pad_{pad}" for pad in pads_of(file)), *(f"buffer_{buffer}" for buffer in buffers_of(file))]
    needed = {"tendon": [f"{part}_{axis}" for part in parts for axis in "xy"], "actuator": list(ACTUATORS)}
    for kind, names in needed.items():
        there = names_of(file.model, kind)
        if more := [name for name in there if name not in names]:
            raise file.refused(
                f"the {kind} {more[0]!r} would not be simulated; a rig has the {kind}s {', '.join(names)}: remove it",
                kind,
                more[0],
            )
        if absent := [name for name in names if name not in there]:
            raise file.refused(f"it lacks the {kind}s {', '.join(absent)}; copy them from bridge1.xml")


def _check_custom(file: Mjcf) -> None:
    model = file.model
    numbers = names_of(model, "numeric")
    if absent := [name for name in NUMBERS if name not in numbers]:
        raise file.refused(f"it lacks the numbers {', '.join(absent)}; give each as <numeric name=... data=...>")
    for name in numbers:
        possible = (1, len(pads_of(file))) if name in OF_EACH_PAD else (1,)
        if name not in (*NUMBERS, *MORE_NUMBERS) or len(model.numeric(name).data) not in possible:
            raise file.refused(
                f"the numeric {name!r} is not understood; possible, with one number each: "
                f"{', '.join((*NUMBERS, *MORE_NUMBERS))}; {' and '.join(OF_EACH_PAD)} may give one for every pad",
                "numeric",
                name,
            )
    for text in file.spec.texts:
        if text.name not in WORDS and not text.name.startswith("source "):
            raise file.refused(
                f"the text {text.name!r} is not understood; possible: {', '.join(WORDS)} and, for remarks, "
                "names that begin with 'source '",
                "text",
                text.name,
            )
