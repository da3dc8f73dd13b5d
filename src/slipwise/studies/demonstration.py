"""What one effect does, on a motion that every effect can be shown on: base against effect at typical size."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import PADS
from slipwise.effects import BalanceStates, Effect
from slipwise.model import Model, base_model, use
from slipwise.record import Record
from slipwise.relations.storeys import compute_push_from_rest
from slipwise.rig import Specimen, load_specimen
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import LoadModes, pad_loads
from slipwise.simulation.predict import Predictor, predictor, shaking

_DT = 1e-3
_SECONDS = 2.4
#: Horizontal stroke [m] and frequency [Hz]; the same across; vertical acceleration [m/s^2] and frequency [Hz].
_ALONG, _ACROSS, _UP = (0.01, 1.25), (0.001, 1.25), (1.5, 5.0)


@dataclass(frozen=True)
class Demonstration:
    """Two curves over one axis; SI.

    Attributes:
        x_name: what the axis is: "slip", "slip across" or "time".
        x_unit: SI unit.
        y_name: what the curves are.
        y_unit: SI unit.
        x: (n,).
        base: (n,) without the effect.
        changed: (n,) with it at typical size.
    """

    x_name: str
    x_unit: str
    y_name: str
    y_unit: str
    x: Array
    base: Array
    changed: Array


@dataclass(frozen=True)
class _Motion:
    time: Array
    slip: Array
    velocity: Array
    up: Array


def _ramp(time: Array) -> Array:
    return 0.5 - 0.5 * np.cos(np.pi * np.clip(time / 0.4, 0.0, 1.0))


@cache
def _motion() -> _Motion:
    time = np.arange(0.0, _SECONDS, _DT)
    ramp = _ramp(time)
    slip = np.stack([s * ramp * np.sin(2.0 * np.pi * f * time) for s, f in (_ALONG, _ACROSS)], axis=1)
    up = ramp * _UP[0] * np.sin(2.0 * np.pi * _UP[1] * time)
    return _Motion(time, slip, np.gradient(slip, _DT, axis=0), up)


def _everywhere(values: Array, count: int) -> Array:
    """Repeat (n, 2) for every pad or buffer, (n, count, 2)."""
    return np.repeat(values[:, None, :], count, axis=1)


def _forces(law: Predictor, load: Array) -> tuple[Array, Array]:
    m = _motion()
    pads = law.pads(m.time, load, _everywhere(m.velocity, 4), _everywhere(m.slip, 4)).force
    buffers = law.buffers(m.time, _everywhere(m.slip, 2), _everywhere(m.velocity, 2))
    return pads, buffers


def _loads(specimen: Specimen, pads: Array, buffers: Array) -> Array:
    """Loads of a rigid girder on its pads (n, 4), the vertical motion amplified by their springs."""
    m = _motion()
    w = np.sqrt(4.0 * specimen.pad_stiffness / specimen.mass)
    damping = 0.5 * specimen.pad_damping / specimen.pad_stiffness * w
    at = 2.0 * np.pi * _UP[1] / w
    heave = specimen.mass * (specimen.gravity + m.up / np.hypot(1.0 - at**2, 2.0 * damping * at))
    sides = []
    for axis, (half, centre) in enumerate(
        zip(specimen.half_spacing, (specimen.centre_x, specimen.centre_y), strict=True)
    ):
        friction, key = pads[:, :, axis].sum(axis=1), buffers[:, :, axis].sum(axis=1)
        moment = friction * specimen.centre_height + key * (specimen.centre_height - specimen.buffer_height)
        sides.append((moment + (m.slip[:, axis] + centre) * heave) / half)
    basis = basis_of(specimen)
    warp = np.tile(basis.warp @ (np.array(specimen.springs) * specimen.seating), (len(heave), 1))
    return pad_loads(LoadModes(heave, sides[0], sides[1], warp), basis)


@cache
def _base() -> tuple[Model, Array, Array, Array]:
    """Return the base model with its loads, pad forces and buffer forces; loads and friction agree after two rounds."""
    model = base_model("bridge1")
    load = np.full((len(_motion().time), 4), model.specimen.weight / 4.0)
    for _ in range(3):
        pads, buffers = _forces(predictor(model), load)
        load = _loads(model.specimen, pads, buffers)
    return model, load, pads, buffers


def demonstrate(effect: Effect, target: str = "pad_A_Fx") -> Demonstration:
    """Show an effect at typical size on the quantity that it changes most.

    Args:
        effect: of the catalogue or a user's own; a law of the base is shown against the model without it.
        target: channel that an instrument effect is shown on.
    """
    base, load, pads, buffers = _base()
    if effect.name in base:
        without = _forces(predictor(base.without(effect.name)), load)[0]
        return _most("slip", without, pads, "friction of pad {}")
    model = base.adding(use(effect, target if effect.target else ""))
    hooks = effect.hooks
    if hooks.keys() & {"area", "shear", "coefficient", "stick", "stretch", "pad", "face"}:
        return _most("slip", pads, _forces(predictor(model), load)[0], "friction of pad {}")
    if hooks.keys() & {"deflection", "spring"}:
        return _most("slip", buffers, _forces(predictor(model), load)[1], "force of buffer {}")
    if "table" in hooks:
        return _table(model)
    if "gauge" in hooks:
        return _gauge(model, load, pads, target)
    if "balance" in hooks:
        return _balance(model)
    if "storeys" in effect.needs:
        return _frame(effect)
    specimen = model.built_specimen()
    return _over("slip", "load of pad A", load[:, 0], _loads(specimen, pads, buffers)[:, 0])


def _frame(effect: Effect) -> Demonstration:
    """Show what a frame of two storeys pushes while its base swings to and fro, and after it has come to rest."""
    m, building = _motion(), load_specimen("building")
    swing = _ramp(m.time) * _ramp(0.5 * _SECONDS - m.time) * np.sin(2.0 * np.pi * _ALONG[1] * m.time)
    still = np.zeros_like(swing)
    changed = base_model(building).adding(use(effect)).built_specimen()
    before, after = (compute_push_from_rest(2.0 * swing, still, _DT, rig) for rig in (building, changed))
    return _over("time", "push of the storeys", before, after)


def _over(x: str, what: str, base: Array, changed: Array, unit: str = "N") -> Demonstration:
    m = _motion()
    axis = {"slip": m.slip[:, 0], "slip across": m.slip[:, 1], "time": m.time}[x]
    return Demonstration(x, "s" if x == "time" else "m", what, unit, axis, base, changed)


def _most(x: str, base: Array, changed: Array, what: str) -> Demonstration:
    """Choose the pad or buffer and the direction (n, count, 2) that change most."""
    difference = np.sqrt(np.mean((changed - base) ** 2, axis=0))
    which, axis = (int(i) for i in np.unravel_index(int(difference.argmax()), difference.shape))
    name = what.format(PADS[which] if "pad" in what else which + 1)
    if axis == 1:
        x, name = "slip across", f"{name} across"
    return _over(x, name, base[:, which, axis], changed[:, which, axis])


def _table(model: Model) -> Demonstration:
    m = _motion()
    given = np.zeros((len(m.time), 4))
    given[:, 0] = 4.0 * _ramp(m.time) * np.sin(2.0 * np.pi * _ALONG[1] * m.time)
    changed = shaking(model, given[:, :3], given[:, 0], _DT)
    axis = int(np.abs(changed - given).max(axis=0).argmax())
    words = ("along", "across", "up", "in pitch")[axis]
    return _over(
        "time", f"table's acceleration {words}", given[:, axis], changed[:, axis], "rad/s^2" if axis == 3 else "m/s^2"
    )


def _gauge(model: Model, load: Array, pads: Array, target: str) -> Demonstration:
    m = _motion()
    channels = {f"pad_{p}_N": load[:, i] for i, p in enumerate(PADS)}
    channels |= {f"pad_{p}_F{a}": pads[:, i, j] for i, p in enumerate(PADS) for j, a in enumerate("xy")}
    # The table as it would have to shake the girder for this slip.
    force = pads[:, :, 0].sum(axis=1) + _base()[3][:, :, 0].sum(axis=1)
    table = -force / model.specimen.mass - np.gradient(m.velocity[:, 0], _DT)
    record = Record(m.time, {**channels, "slip_x": m.slip[:, 0], "table_ax": table, "table_az": m.up})
    changed = record
    for entry in model.with_hook("gauge"):
        changed = entry.effect.hooks["gauge"](changed, entry.target, **entry.values)
    return _over("slip", f"{target} as read", record[target], changed[target])


def _balance(model: Model) -> Demonstration:
    base, load, pads, buffers = _base()
    m, specimen = _motion(), model.built_specimen()
    force = pads.sum(axis=1) + buffers.sum(axis=1)
    girder = np.stack([-force[:, 0] / specimen.mass, -force[:, 1] / specimen.mass, m.up], axis=1)
    states = BalanceStates(
        time=m.time,
        specimen=specimen,
        slip=m.slip,
        velocity=m.velocity,
        load=load,
        pad_force=pads,
        girder_acceleration=girder,
        table_acceleration=girder,
        buffer_force=buffers.sum(axis=1),
        buffer_size=np.linalg.norm(buffers, axis=2),
        heave_rate=-np.gradient(load.sum(axis=1), _DT) / (4.0 * specimen.pad_stiffness),
    )
    added: dict[str, Array] = {}
    for entry in model.with_hook("balance"):
        added |= entry.effect.hooks["balance"](states, target=entry.target, **entry.values)
    name = max(added, key=lambda n: float(np.abs(added[n]).max()))
    if name == "girder":
        return _over("slip", "horizontal force on the girder", force[:, 0], force[:, 0] + added[name])
    if name == "heave":
        total = load.sum(axis=1)
        return _over("time", "sum of the pads' loads", total, total + added[name])
    return _over("slip", "load of pad A", load[:, 0], load[:, 0] + added[name] / 4.0)
