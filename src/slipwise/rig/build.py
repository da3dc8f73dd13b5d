"""From a specimen to a MuJoCo model that is ready to be shaken.

The model is always the one that `mjcf/writer.py` writes of the specimen, whatever file it was read from: so what a file
holds and a specimen does not cannot act without a record. `mjcf/comparison.py` refuses files that hold such things.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from slipwise.errors import SettingError
from slipwise.rig.mjcf.writer import mjcf_text, storey_names
from slipwise.rig.specimen import Specimen
from slipwise.rig.storeys import fixed_base_frequencies
from slipwise.short_repr import short_repr

#: Impedance of the pads' contacts: constant and low, so that a contact is a spring (see `_pad_contact`).
_IMPEDANCE = 0.001
#: Largest step times angular frequency of the stiffest mode: beyond it explicit springs gain energy.
_STABLE = 0.6
#: Shortest time constant of a constraint over the step: MuJoCo takes no less.
_SHORTEST_STOP = 2.0
#: Armature of the table's joints [kg]: it makes the table follow its command whatever the girder does.
_ARMATURE = 1e10
TABLE_AXES: tuple[str, ...] = ("ax", "ay", "az", "apitch")


@short_repr
@dataclass(frozen=True)
class Rig:
    """A compiled specimen.

    Attributes:
        specimen: what it was compiled from.
        model: MuJoCo's model; `model.nuserdata` and the user sensor hold what the callbacks need.
        tendons: ids of the tendons, pads (x, y) in order, then buffers (x, y).
        jacobian: (n_tendons, nv) slip rate of each tendon per generalised velocity.
        pad_geoms: ids of the pads' geoms.
        user_sensor: address of the user sensor in sensordata.
        sag: how far the girder sinks into its pads under its weight [m].
    """

    specimen: Specimen
    model: mujoco.MjModel
    tendons: tuple[int, ...]
    jacobian: NDArray[np.float64]
    pad_geoms: tuple[int, ...]
    user_sensor: int
    sag: float

    @cached_property
    def sensors(self) -> Mapping[str, slice]:
        """Where each sensor stands in sensordata, by name: to ask MuJoCo takes as long as a step, for each chunk."""
        found = (self.model.sensor(i) for i in range(self.model.nsensor))
        return {s.name: slice(int(s.adr[0]), int(s.adr[0]) + int(s.dim[0])) for s in found}


def pad_frequencies(specimen: Specimen) -> dict[str, float]:
    """Return the frequencies of heave, pitch and roll on the pads [Hz], each by itself, the girder taken as rigid."""
    stiffness, mass = stiffness_at_rest(specimen), np.array([specimen.carried_mass, *specimen.inertia[:2]])
    values = np.sqrt(np.diag(stiffness) / mass) / (2.0 * np.pi)
    heave, roll, pitch = (float(value) for value in values)
    return {"heave": heave, "pitch": pitch, "roll": roll} if specimen.free else {"heave": heave}


def stiffness_at_rest(specimen: Specimen) -> NDArray[np.float64]:
    """Return the stiffness of all pads against heave, roll and pitch of the girder (3, 3) [N/m, N, N m]."""
    arms = np.array(specimen.pad_places) - [specimen.centre_x, specimen.centre_y]
    shape = np.stack([-np.ones(len(arms)), -arms[:, 1], arms[:, 0]], axis=1)
    return shape.T @ (np.array(specimen.springs)[:, None] * shape)


def largest_step(specimen: Specimen) -> float:
    """Return the largest time step [s] that the pads' stiffness allows: that of the stiffest mode, coupled as it is."""
    if not specimen.free:
        return _STABLE / (2.0 * np.pi * pad_frequencies(specimen)["heave"])
    scale = 1.0 / np.sqrt([specimen.mass, *specimen.inertia[:2]])
    stiffest = np.linalg.eigvalsh(stiffness_at_rest(specimen) * scale[:, None] * scale).max()
    fastest = max(
        (fixed_base_frequencies(specimen.storeys, axis)[-1] for axis in "xy" if specimen.storeys), default=0.0
    )
    return float(_STABLE / max(np.sqrt(stiffest), 2.0 * np.pi * fastest))


def check_step(specimen: Specimen, dt: float) -> None:
    """Refuse a step [s] that is too large for the pads.

    Raises:
        SettingError: it is; the message gives the largest one.
    """
    allowed = largest_step(specimen)
    if not 0.0 < dt <= allowed:
        raise SettingError(
            f"a step of {dt * 1e3:g} ms does not suit pads of {specimen.pad_stiffness / 1e6:g} kN/mm: "
            f"at most {np.floor(allowed * 1e5) / 1e2:g} ms (or softer pads)"
        )


def build(specimen: Specimen, dt: float, nuserdata: int) -> Rig:
    """Compile a specimen. No callback may be installed meanwhile: MuJoCo would call it.

    Args:
        specimen: the rig and its values.
        dt: time step [s].
        nuserdata: numbers that the callbacks keep in `data.userdata`.

    Raises:
        SettingError: the step is too large for the pads' stiffness, the girder would sink through its pads, or the
            values are not those of a body.
    """
    check_step(specimen, dt)
    sag = specimen.weight / sum(specimen.springs)
    thinnest = min(place.radius for place in specimen.places)
    if sag > thinnest:
        raise SettingError(
            f"{specimen.name}: the girder would sink {sag * 1e3:g} mm into its pads, whose radius is "
            f"{thinnest * 1e3:g} mm; give a larger pad_stiffness or a smaller mass"
        )
    spec = mujoco.MjSpec.from_string(mjcf_text(specimen))
    spec.option.timestep = dt
    spec.nuserdata = nuserdata
    # The first vertical mode is even about the middle: it takes mass from heave, nothing from pitch and roll.
    spec.body("girder").mass = specimen.mass - specimen.bending_mass
    if specimen.pads_on == "girder":
        _swap_pads(spec, specimen)
    if specimen.free:
        _shorten_stops(spec, dt)
    _drive_table(spec, specimen)
    if specimen.bending_mass > 0.0:
        _add_bending(spec, specimen)
    _add_sensors(spec, specimen)
    try:
        _pad_contact(spec, specimen)
        model = spec.compile()
    except ValueError as error:
        raise SettingError(f"{specimen.name}: MuJoCo cannot build a rig with these values: {error}") from None
    names = [f"pad_{pad}_{axis}" for pad in specimen.pads for axis in "xy"]
    names += [f"buffer_{buffer.name}_{axis}" for buffer in specimen.buffers for axis in "xy"]
    tendons = tuple(int(model.tendon(name).id) for name in names)
    return Rig(
        specimen=specimen,
        model=model,
        tendons=tendons,
        jacobian=_jacobian(model, tendons),
        pad_geoms=tuple(int(model.geom(f"pad_{pad}").id) for pad in specimen.pads),
        user_sensor=int(model.sensor("pads").adr[0]),
        sag=sag,
    )


def _swap_pads(spec: mujoco.MjSpec, specimen: Specimen) -> None:
    """Let the pads travel with the girder and slide on plates of the table."""
    table, girder = spec.body("table"), spec.body("girder")
    centre = np.array(girder.pos)
    for bit, (pad, radius) in enumerate((place.name, place.radius) for place in specimen.places):
        face, plate = spec.geom(f"pad_{pad}"), spec.geom(f"plate_{pad}")
        low = np.array(face.pos) + [0.0, 0.0, radius]
        shared = {"condim": 1, "group": 3, "mass": 0.0, "contype": 0, "conaffinity": 0}
        ball = {**shared, "contype": 1 << bit, "type": mujoco.mjtGeom.mjGEOM_SPHERE, "size": np.array(face.size)}
        floor = {**shared, "conaffinity": 1 << bit, "type": mujoco.mjtGeom.mjGEOM_BOX, "size": np.array(plate.size)}
        spec.delete(face)
        spec.delete(plate)
        girder.add_geom(name=f"pad_{pad}", pos=low - centre + [0.0, 0.0, radius], **ball)
        table.add_geom(name=f"plate_{pad}", pos=[low[0], low[1], low[2] - floor["size"][2]], **floor)


def _shorten_stops(spec: mujoco.MjSpec, dt: float) -> None:
    """Make the time constant of dry friction as short as the step allows, so that a finer step is a better answer.

    It brings a slider to rest within that time, and turns round that much before the slip does.
    """
    for tendon in spec.tendons:
        tendon.solref_friction[0] = _SHORTEST_STOP * dt


def _drive_table(spec: mujoco.MjSpec, specimen: Specimen) -> None:
    """Set the gains so that a control is an acceleration, and carry the weight."""
    table_mass = 1.0
    for axis in TABLE_AXES:
        actuator = spec.actuator(f"table_{axis}")
        turning = axis == "apitch"
        moved = 0.0 if turning else table_mass + (specimen.carried_mass if specimen.free or axis == "az" else 0.0)
        actuator.gainprm[0] = _ARMATURE + moved
        if axis == "az":
            actuator.biasprm[0] = (specimen.carried_mass + table_mass) * specimen.gravity
    for joint in ("table_x", "table_y", "table_z", "table_pitch"):
        spec.joint(joint).armature = _ARMATURE


def _add_bending(spec: mujoco.MjSpec, specimen: Specimen) -> None:
    """Hang the girder's first vertical mode on the girder as a sprung mass."""
    omega = 2.0 * np.pi * specimen.bending_frequency
    mode = spec.body("girder").add_body(name="bending")
    mode.mass = specimen.bending_mass
    mode.inertia = [1e-3, 1e-3, 1e-3]
    mode.explicitinertial = True
    # springref: the mode hangs by its own weight, so that the run starts in equilibrium at zero.
    mode.add_joint(
        name="bending",
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[0.0, 0.0, 1.0],
        stiffness=specimen.bending_mass * omega**2,
        damping=2.0 * specimen.bending_damping * omega * specimen.bending_mass,
        springref=specimen.gravity / omega**2,
    )


def _add_sensors(spec: mujoco.MjSpec, specimen: Specimen) -> None:
    """Add the sensors from which every channel is made, all taken at the same instant.

    The integrator moves positions after the sensors are read: states taken from the data would be one step late.
    """
    kinds, body = mujoco.mjtSensor, mujoco.mjtObj
    size = 4 * len(specimen.pads) + 2 * len(specimen.buffers) + 3
    spec.add_sensor(name="pads", type=kinds.mjSENS_USER, dim=size, needstage=mujoco.mjtStage.mjSTAGE_ACC,
                    datatype=mujoco.mjtDataType.mjDATATYPE_REAL)  # fmt: skip
    sites = ["girder_centre"] + (["girder_edge_1", "girder_edge_2"] if specimen.free else [])
    for site in sites:
        spec.add_sensor(name=site, type=kinds.mjSENS_FRAMELINACC, objtype=body.mjOBJ_SITE, objname=site)
    for storey in storey_names(specimen.storeys):
        site = {"objtype": body.mjOBJ_SITE, "objname": storey}
        spec.add_sensor(name=storey, type=kinds.mjSENS_FRAMELINACC, **site)
    if specimen.free:
        spec.add_sensor(name="turning", type=kinds.mjSENS_FRAMEANGACC, objtype=body.mjOBJ_SITE, objname="girder_centre")
    for joint in [j.name for j in spec.joints]:
        for kind, prefix in ((kinds.mjSENS_JOINTPOS, "at"), (kinds.mjSENS_JOINTVEL, "rate")):
            spec.add_sensor(name=f"{prefix}_{joint}", type=kind, objtype=body.mjOBJ_JOINT, objname=joint)


def _pad_contact(spec: mujoco.MjSpec, specimen: Specimen) -> None:
    """Make every pad's contact a spring and a damper of stated stiffness.

    A contact of constant impedance d carries f = (b v + k r d) / R with k = -solref[0] / d^2, b = -solref[1] / d and
    R = A (1-d)/d, where A is the row's inverse mass. So solref = -(1-d) A (stiffness, damping) gives both exactly.
    """
    d = _IMPEDANCE
    pairs = {pad: _only_pair(spec, pad) for pad in specimen.pads}
    for pair in pairs.values():
        pair.solimp = [d, d, d, 0.5, 2.0]
        pair.solref = [-1.0, -1.0]
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("girder_z").qpos[0] = -2e-3 - 2.0 * max(abs(s) for s in specimen.seating)
    mujoco.mj_forward(model, data)
    for contact in data.contact:
        inverse_mass = float(data.efc_R[contact.efc_address]) * d / (1.0 - d)
        touching = {model.geom(contact.geom1).name, model.geom(contact.geom2).name}
        pad = next(place for place in specimen.places if f"pad_{place.name}" in touching)
        pairs[pad.name].solref = [-(1 - d) * inverse_mass * pad.stiffness, -(1 - d) * inverse_mass * pad.damping]


def _only_pair(spec: mujoco.MjSpec, pad: str) -> mujoco.MjsPair:
    """Let a pad and its plate meet as a named pair: MuJoCo then looks at no other, however many pads there are."""
    geoms = [spec.geom(f"pad_{pad}"), spec.geom(f"plate_{pad}")]
    for geom in geoms:
        geom.contype = geom.conaffinity = 0
    return spec.add_pair(name=f"pad_{pad}", geomname1=geoms[0].name, geomname2=geoms[1].name, condim=1)


def _jacobian(model: mujoco.MjModel, tendons: tuple[int, ...]) -> NDArray[np.float64]:
    """Collect the constant coefficients of the fixed tendons, (n_tendons, nv)."""
    out = np.zeros((len(tendons), model.nv))
    for row, tendon in enumerate(tendons):
        start = int(model.tendon_adr[tendon])
        for wrap in range(start, start + int(model.tendon_num[tendon])):
            out[row, model.jnt_dofadr[model.wrap_objid[wrap]]] = model.wrap_prm[wrap]
    return out
