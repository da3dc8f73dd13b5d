"""Every attribute of a rig's parts: read, without effect on the motion, or as the shipped rigs have it.

A replay runs the shipped model with the specimen's values in it. So whatever a file gives must be a value of the
specimen, or be what the shipped model has. The compiled models are compared field by field, which sees defaults,
includes and frames as MuJoCo does: a field that is not named here, one of a later MuJoCo too, must agree.
"""

from collections.abc import Iterator, Mapping
from functools import cache

import mujoco
import numpy as np

from slipwise.errors import InputError
from slipwise.rig.files import models_folder, shipped_file
from slipwise.rig.mjcf import Mjcf
from slipwise.rig.mjcf_parts import ACTUATORS, buffers_of, is_free, names_of, pads_of

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
    ("girder", "damping"): "drag on the girder is an effect, guide_drag",
}
_WORDS_OF = {
    "integrator": mujoco.mjtIntegrator,
    "cone": mujoco.mjtCone,
    "jacobian": mujoco.mjtJacobian,
    "solver": mujoco.mjtSolver,
}


@cache
def _shipped(free: bool) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(models_folder() / shipped_file(free)))


def check_attributes(file: Mjcf) -> None:
    """Refuse an attribute that a replay would leave out.

    Raises:
        InputError: the message names the element, the attribute and what is possible.
    """
    _check_options(file)
    model, shipped = file.model, _shipped(is_free(file.model))
    joints = names_of(shipped, "joint")
    for name in ("table", "girder"):
        _compare(file, "body", name, name, [("body", model.body(name).id, shipped.body(name).id)])
    for name in joints:
        ours, theirs = shipped.joint(name), model.joint(name)
        dofs = (int(theirs.dofadr[0]), int(ours.dofadr[0]))
        _compare(file, "joint", name, name.split("_")[0], [("jnt", theirs.id, ours.id), ("dof", *dofs)])
        for key, words in (("qpos0", "ref"), ("qpos_spring", "springref")):
            if given := float(getattr(model, key)[theirs.qposadr[0]]):
                raise file.refused(f"the joint {name!r} has {words} = {given:g}; possible is 0", "joint", name)
    _check_bits(file)
    for pad in pads_of(file):
        for part in ("pad", "plate"):
            name = f"{part}_{pad}"
            _compare(file, "geom", name, part, [("geom", model.geom(name).id, shipped.geom(f"{part}_A").id)])
    like = {f"pad_{pad}": "pad_A" for pad in pads_of(file)} | {f"buffer_{b}": "buffer_1" for b in buffers_of(file)}
    for part, known in like.items():
        for axis in "xy":
            name = f"{part}_{axis}"
            ids = ("tendon", model.tendon(name).id, shipped.tendon(f"{known}_{axis}").id)
            _compare(file, "tendon", name, part.split("_")[0], [ids])
    for name in ACTUATORS:
        _check_actuator(file, shipped, name)


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


def _check_options(file: Mjcf) -> None:
    """Take options as the shipped rigs have them or as MuJoCo has them where nothing is said."""
    given, shipped, unsaid = file.model.opt, _shipped(is_free(file.model)).opt, mujoco.MjOption()
    for name in (n for n in dir(given) if not n.startswith("_")):
        value, ours, default = getattr(given, name), getattr(shipped, name), getattr(unsaid, name)
        if name == "gravity":
            if value[0] or value[1] or not value[2] < 0.0:
                raise file.refused(
                    f"the option gravity = {_text(value)} must point down, as 0 0 -9.80665", "option", key=name
                )
        elif name in ("disableflags", "enableflags"):
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


def _check_actuator(file: Mjcf, shipped: mujoco.MjModel, name: str) -> None:
    model = file.model
    ours, theirs = shipped.actuator(name), model.actuator(name)
    drives = model.joint(int(theirs.trnid[0])).name if int(theirs.trntype[0]) == int(ours.trntype[0]) else ""
    wanted = shipped.joint(int(ours.trnid[0])).name
    if drives != wanted:
        raise file.refused(f"the actuator {name} must drive the joint {wanted}", "actuator", name)
    if np.any(theirs.biasprm[1:] != ours.biasprm[1:]):
        raise file.refused(
            f"the actuator {name!r} has biasprm = {_text(theirs.biasprm)}; its first number, the weight, is set by a "
            "replay: give no gain on position or velocity",
            "actuator",
            name,
        )
    _compare(file, "actuator", name, name, [("actuator", theirs.id, ours.id)], also=frozenset({"trnid"}))


def _compare(
    file: Mjcf,
    kind: str,
    name: str,
    part: str,
    rows: list[tuple[str, int, int]],
    also: frozenset[str] = frozenset(),
) -> None:
    """Compare one part with the shipped one: rows of prefix of the fields, index in the file, index in the shipped."""
    shipped = _shipped(is_free(file.model))
    for prefix, at, ours in rows:
        for field in fields_of(shipped, prefix):
            if field in NOT_FELT[prefix] or field in READ.get(part, ()) or field in also:
                continue
            given = getattr(file.model, f"{prefix}_{field}")[at]
            possible = getattr(shipped, f"{prefix}_{field}")[ours]
            if not np.array_equal(given, possible):
                written = _WRITTEN.get(f"{prefix}_{field}", _WRITTEN.get(field, field))
                instead = _INSTEAD.get((part, field), f"leave it as {shipped_file(is_free(file.model))} has it")
                raise file.refused(
                    f"the {kind} {name!r} has {written} = {_text(given)}, which would not be simulated; possible is "
                    f"{_text(possible)}: {instead}",
                    kind,
                    name,
                )


def fields_of(model: mujoco.MjModel, prefix: str) -> Iterator[str]:
    """Return the fields of a kind of part of a compiled model, without their prefix."""
    return (name.removeprefix(f"{prefix}_") for name in dir(model) if name.startswith(f"{prefix}_"))


def _text(value: object) -> str:
    return " ".join(f"{number:g}" for number in np.ravel(np.asarray(value, dtype=float)))
