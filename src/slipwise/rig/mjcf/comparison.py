"""Every attribute of a rig's parts: read, without effect on the motion, or as it is written of the specimen.

A replay runs the model that is written of the specimen. So whatever a file gives must be a value of the specimen, or be
what that model has. The compiled models are compared field by field, which sees defaults, includes and frames as MuJoCo
does: a field that is not named here, one of a later MuJoCo too, must agree.
"""

from collections.abc import Iterator, Mapping

import mujoco
import numpy as np

from slipwise.errors import InputError
from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.mjcf.parts import ACTUATORS, is_free, names_of, pads_of
from slipwise.rig.mjcf.writer import mjcf_text
from slipwise.rig.specimen import Specimen

#: Fields of each kind of part that follow from others, or only show.
NOT_FELT: Mapping[str, frozenset[str]] = {
    "jnt": frozenset("actuatorid bodyid dofadr group plasticadr qposadr user".split()),
    "dof": frozenset("M0 Madr bodyid invweight0 jntid length parentid simplenum treeid".split()),
    "body": frozenset(
        "bvhadr bvhnum conaffinity contype dofadr dofnum geomadr geomnum invweight0 jntadr jntnum margin parentid"
        " rootid sameframe simple subtreemass treeid user weldid".split()
    ),
    "geom": frozenset("aabb bodyid castshadow dataid group matid rbound rgba sameframe user".split()),
    "tendon": frozenset(
        "actuatorid adr group invweight0 length0 matid num plasticadr rgba treeid treenum user width".split()
    ),
    "actuator": frozenset("acc0 actadr ctrladr group historyadr length0 outadr user".split()),
}
#: Fields that are read into the specimen (by `load.py`), or that a replay sets: the table's mass is not felt.
READ: Mapping[str, frozenset[str]] = {
    "table": frozenset("mass inertia ipos iquat".split()),
    "girder": frozenset("mass inertia ipos iquat pos".split()),
    "pad": frozenset("conaffinity contype pos quat size".split()),
    "plate": frozenset("conaffinity contype pos".split()),
    "buffer": frozenset("lengthspring stiffness".split()),
    "table_az": frozenset(["biasprm"]),
    "storey": frozenset("damping stiffness".split()),
}
#: How MJCF writes a field that has another name in the compiled model.
_WRITTEN = {
    "solref_fri": "solreffriction",
    "solimp_fri": "solimpfriction",
    "solref_lim": "solreflimit",
    "solimp_lim": "solimplimit",
    "lengthspring": "springlength",
    "dof_solref": "solreffriction",
    "dof_solimp": "solimpfriction",
}
#: What says the same in a rig, by part and attribute.
_INSTEAD = {
    ("pad", "friction"): "a pad's friction is given by the numerics plastic_pressure and shear_strength",
    ("pad", "solref"): "a pad's spring is given by the numerics pad_stiffness and pad_damping",
    ("pad", "solimp"): "a pad's spring is given by the numerics pad_stiffness and pad_damping",
    ("pad", "frictionloss"): "a pad's friction is given by the numerics plastic_pressure and shear_strength",
    ("buffer", "damping"): "a buffer's damping is an effect, buffer_damping",
    ("buffer", "frictionloss"): "friction of a shear key is an effect, key_friction",
    ("buffer", "range"): "play of a shear key is an effect, key_clearance",
    ("girder", "frictionloss"): "friction of a guide is an effect, guide_drag",
    ("storey", ""): "a storey's joints slide along x and y and have stiffness and damping: leave the rest out",
    ("girder", "damping"): "drag on the girder is an effect, guide_drag",
}
_WORDS_OF = {
    "integrator": mujoco.mjtIntegrator,
    "cone": mujoco.mjtCone,
    "jacobian": mujoco.mjtJacobian,
    "solver": mujoco.mjtSolver,
}


def check_gravity(file: Mjcf) -> None:
    """Refuse gravity that does not point down.

    Raises:
        InputError: it does not.
    """
    value = file.model.opt.gravity
    if value[0] or value[1] or not value[2] < 0.0:
        raise file.refused(
            f"the option gravity = {_text(value)} must point down, as 0 0 -9.80665", "option", key="gravity"
        )


def check_attributes(file: Mjcf, specimen: Specimen) -> None:
    """Refuse an attribute that a replay would leave out.

    Args:
        file: as MuJoCo compiles it.
        specimen: that is read from it.

    Raises:
        InputError: the message names the element, the attribute and what is possible.
    """
    ours = mujoco.MjModel.from_xml_string(mjcf_text(specimen))
    _check_options(file, ours)
    for name in ("table", "girder"):
        _compare(file, ours, "body", name)
    for name in names_of(ours, "joint"):
        _compare(file, ours, "joint", name)
        at = int(file.model.joint(name).qposadr[0])
        for key, words in (("qpos0", "ref"), ("qpos_spring", "springref")):
            if given := float(getattr(file.model, key)[at]):
                raise file.refused(f"the joint {name!r} has {words} = {given:g}; possible is 0", "joint", name)
    _check_bits(file)
    for pad in pads_of(file):
        _compare(file, ours, "geom", f"pad_{pad}")
        _compare(file, ours, "geom", f"plate_{pad}")
    for name in names_of(ours, "tendon"):
        _compare(file, ours, "tendon", name)
    for name in ACTUATORS:
        _check_actuator(file, ours, name)


def _check_bits(file: Mjcf) -> None:
    """Hold pads and plates to a bit of their own, by which each pad meets its plate and nothing else."""
    taken: dict[int, str] = {}
    for pad in pads_of(file):
        for name, key, other in ((f"pad_{pad}", "contype", "conaffinity"), (f"plate_{pad}", "conaffinity", "contype")):
            geom = file.model.geom(name)
            given, nothing = int(getattr(geom, key)[0]), int(getattr(geom, other)[0])
            single = given > 0 and given & (given - 1) == 0
            if not single or nothing or taken.setdefault(given, pad) != pad or taken[given] != pad:
                raise _wrong_bit(file, name, key, given)
        if file.model.geom(f"pad_{pad}").contype[0] != file.model.geom(f"plate_{pad}").conaffinity[0]:
            given = int(file.model.geom(f"plate_{pad}").conaffinity[0])
            raise _wrong_bit(file, f"plate_{pad}", "conaffinity", given)


def _wrong_bit(file: Mjcf, name: str, key: str, given: int) -> InputError:
    return file.refused(
        f"the geom {name!r} has {key} = {given}; possible is 1, 2, 4, 8 ..., another for every pad, as contype of "
        "the pad and as conaffinity of its plate alone, so that each meets its own",
        "geom",
        name,
    )


def _check_options(file: Mjcf, written: mujoco.MjModel) -> None:
    """Take options as they are written of the specimen or as MuJoCo has them where nothing is said."""
    given, unsaid = file.model.opt, mujoco.MjOption()
    for name in (n for n in dir(given) if not n.startswith("_") and n != "gravity"):
        value, ours, default = getattr(given, name), getattr(written.opt, name), getattr(unsaid, name)
        if name in ("disableflags", "enableflags"):
            _check_flags(file, name, int(value), int(ours) | int(default))
        elif not (np.array_equal(value, ours) or np.array_equal(value, default)):
            kind = _WORDS_OF.get(name)
            word = kind(value).name.split("_")[-1] if kind else _text(value)
            instead = "the step of a replay is its option --step" if name == "timestep" else "leave it out"
            raise file.refused(
                f"the option {name} = {word} is not that of a replay; possible is "
                f"{kind(ours).name.split('_')[-1] if kind else _text(ours)}: {instead}",
                "option",
                key=name,
            )


def _check_flags(file: Mjcf, name: str, given: int, possible: int) -> None:
    kind, word = (mujoco.mjtDisableBit, "disable") if name == "disableflags" else (mujoco.mjtEnableBit, "enable")
    for flag in kind.__members__.values():
        if given & ~possible & int(flag.value) and not flag.name.startswith("mjN"):
            called = flag.name.split("_")[-1].lower()
            raise file.refused(f'the flag {called}="{word}" is not that of a replay; leave it out', "flag", key=called)


def _check_actuator(file: Mjcf, written: mujoco.MjModel, name: str) -> None:
    model = file.model
    ours, theirs = written.actuator(name), model.actuator(name)
    drives = model.joint(int(theirs.trnid[0])).name if int(theirs.trntype[0]) == int(ours.trntype[0]) else ""
    wanted = written.joint(int(ours.trnid[0])).name
    if drives != wanted:
        raise file.refused(f"the actuator {name} must drive the joint {wanted}", "actuator", name)
    if np.any(theirs.biasprm[1:] != ours.biasprm[1:]):
        raise file.refused(
            f"the actuator {name!r} has biasprm = {_text(theirs.biasprm)}; its first number, the weight, is set by a "
            "replay: give no gain on position or velocity",
            "actuator",
            name,
        )
    _compare(file, written, "actuator", name, also=frozenset({"trnid"}))


def _compare(file: Mjcf, written: mujoco.MjModel, kind: str, name: str, also: frozenset[str] = frozenset()) -> None:
    """Hold a part to the one that is written of the specimen, but for what is read, not felt, or in `also`."""
    part = name if name in READ else name.split("_")[0]
    theirs, ours = getattr(file.model, kind)(name), getattr(written, kind)(name)
    rows = [(kind, theirs.id, ours.id)]
    if kind == "joint":
        rows = [("jnt", theirs.id, ours.id), ("dof", int(theirs.dofadr[0]), int(ours.dofadr[0]))]
    for prefix, at, own in rows:
        left_out = NOT_FELT[prefix] | READ.get(part, frozenset()) | also
        for field in (field for field in fields_of(written, prefix) if field not in left_out):
            given = getattr(file.model, f"{prefix}_{field}")[at]
            possible = getattr(written, f"{prefix}_{field}")[own]
            if not np.array_equal(given, possible):
                words = _WRITTEN.get(f"{prefix}_{field}", _WRITTEN.get(field, field))
                instead = _INSTEAD.get((part, field), _INSTEAD.get((part, ""), _as_shipped(file)))
                raise file.refused(
                    f"the {kind} {name!r} has {words} = {_text(given)}, which would not be simulated; possible is "
                    f"{_text(possible)}: {instead}",
                    kind,
                    name,
                )


def _as_shipped(file: Mjcf) -> str:
    return f"leave it as {'bridge1.xml' if is_free(file.model) else 'pad.xml'} has it"


def fields_of(model: mujoco.MjModel, prefix: str) -> Iterator[str]:
    """Return the fields of a kind of part of a compiled model, without their prefix."""
    return (name.removeprefix(f"{prefix}_") for name in dir(model) if name.startswith(f"{prefix}_"))


def _text(value: object) -> str:
    return " ".join(f"{number + 0.0:g}" for number in np.ravel(np.asarray(value, dtype=float)))
