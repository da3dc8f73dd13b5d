"""The balances of a rig as equations: which unknown quantities stand in each, and which effects break it.

    pad p       friction F_p = law(load N_p, slip, yaw)                  ports area, shear, stick, train, pad
    across p    the same along y
    buffer b    force B_b = spring(slip, yaw)                            port buffer
    girder      m a_x + sum F + sum B = push of the storeys              hooks drag, balance
    heave       sum N = m (g + a_z)                                      hooks lift, balance
    pitch       moments of N, F, B, and of N that moves over the pads    hooks rig, balance
    roll        moments of N
    warp ...    what the seating makes of N
    storeys     push of the storeys = springs of their columns
    motion      a_x - a_x,table = d2(slip)/dt2
    upright     a_z - a_z,table = shortening of the pads under N
    yaw         moments of F and B about the vertical
    edges       a_z is the mean of what both edges measure
    <channel>   what a gauge reads is the quantity that it measures      port gauge

A quantity has the name of the channel that would measure it. One that no gauge measures is eliminated by an equation,
which then checks nothing; a derivative counts as its quantity. Rated numbers are taken as known: how much of an effect
they could mimic is a matter of size, not of structure.

Source: `relations.girder` and `relations.rigid_balances`, whose equations these are.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from slipwise.channels import part_of
from slipwise.effects import PAD_HOOKS, BalanceStates, Effect
from slipwise.rig import Specimen, storey_names
from slipwise.rig.load_basis import warps

#: Values of the rig that a `rig` hook may change -> equations in which they stand, beside what `balance` says.
_OF_RIG: dict[str, tuple[str, ...]] = {
    "mass": ("girder", "heave"),
    "inertia": ("pitch", "roll"),
    "centre_height": ("pitch",),
    "centre_x": ("pitch",),
    "centre_y": ("roll",),
    "storeys": ("storeys",),
}
_OF_PADS = PAD_HOOKS | {"stretch"}
_OF_BUFFERS = frozenset({"deflection", "spring"})
#: Samples of the states with which a `balance` hook is asked which balances it changes, and their step [s].
_SAMPLES, _STEP = 256, 2e-3
#: A strength that is typically zero is asked for at this share of its bound [1].
_SOME = 0.1


@dataclass(frozen=True)
class BalanceEquations:
    """Equations of a rig without its gauges.

    Attributes:
        specimen: the rig.
        unknowns: equation -> quantities that stand in it.
    """

    specimen: Specimen
    unknowns: Mapping[str, frozenset[str]]

    @property
    def quantities(self) -> tuple[str, ...]:
        """Every quantity of the equations, sorted."""
        return tuple(sorted(frozenset[str]().union(*self.unknowns.values())))

    def measured_by(self, channel: str) -> str:
        """Return the quantity of the equations that a channel measures; "" where it measures none."""
        name = channel.replace("slip_v", "slip_")
        if part_of(name)[0] == "pad" and name.endswith("_P"):
            name = name.removesuffix("P") + "N"
        # what the keys carry has no cell in any relation of the program
        return name if name in self.quantities and part_of(name)[0] != "buffer" else ""

    def with_gauges(self, channels: Iterable[str]) -> dict[str, frozenset[str]]:
        """Return the equations with one more for every gauge that measures a quantity of them, by the channel."""
        read = {c: frozenset({quantity}) for c in channels if (quantity := self.measured_by(c))}
        return {**self.unknowns, **read}


def keep_laws_of_pads(equations: BalanceEquations) -> BalanceEquations:
    """Return the laws of the pads alone, the girder taken not to turn: all that is left without its balances."""
    laws = {name: of - {"yaw"} for name, of in equations.unknowns.items() if name.startswith("pad ")}
    return replace(equations, unknowns=laws)


def list_equations(specimen: Specimen) -> BalanceEquations:
    """Return the equations of a rig: of one slider whose slip is prescribed, the law of friction alone."""
    out: dict[str, set[str]] = {}
    loads, along, across = ([f"pad_{pad}_{kind}" for pad in specimen.pads] for kind in ("N", "Fx", "Fy"))
    held = [f"buffer_{buffer.name}_Fx" for buffer in specimen.buffers]
    turns = {"yaw"} if specimen.free else set[str]()
    for pad, load, force, sideways in zip(specimen.pads, loads, along, across, strict=True):
        out[f"pad {pad}"] = {load, force, "slip_x", *turns}
        if specimen.free:
            out[f"across {pad}"] = {load, sideways, "slip_x", "slip_y", *turns}
    if not specimen.free:
        return BalanceEquations(specimen, {name: frozenset(of) for name, of in out.items()})
    for buffer, force in zip(specimen.buffers, held, strict=True):
        out[f"buffer {buffer.name}"] = {force, "slip_x", *turns}
    floors = [f"{storey}_ax" for storey in storey_names(specimen.storeys)]
    out["girder"] = {*along, *held, *floors, "girder_ax"}
    out["girder across"] = {*across, "girder_ay", "slip_y"}
    out["heave"] = {*loads, "girder_az"}
    out["pitch"] = {*loads, *along, *held, *floors, "slip_x"}
    out["roll"] = {*loads}
    out |= {name: {*loads} for name in warps(specimen)}
    if floors:
        out["storeys"] = {*floors, "girder_ax", *loads}
    out["motion"] = {"girder_ax", "table_ax", "slip_x"}
    out["motion across"] = {"girder_ay", "table_ay", "slip_y"}
    out["upright"] = {"girder_az", "table_az", *loads}
    out["yaw"] = {*along, *held, "yaw"}
    out["edges"] = {"girder_az", "girder_az_1", "girder_az_2"}
    return BalanceEquations(specimen, {name: frozenset(of) for name, of in out.items()})


def list_broken(effect: Effect, equations: BalanceEquations) -> tuple[str, ...]:
    """Return the equations that do not hold where an effect is, as its hooks say; none where no balance knows it.

    Args:
        effect: no fault of a gauge: that breaks the equation of its channel.
        equations: of the rig.
    """
    specimen, hooks, out = equations.specimen, effect.hooks.keys(), set[str]()
    if not hooks.isdisjoint(_OF_PADS):
        kinds = ("across",) if "across" in effect.all_needs else ("pad", "across")
        out |= {f"{kind} {pad}" for kind in kinds for pad in specimen.pads}
    if not hooks.isdisjoint(_OF_BUFFERS):
        out |= {f"buffer {buffer.name}" for buffer in specimen.buffers}
    out |= {"heave"} if "lift" in hooks else set()
    out |= {"girder"} if "drag" in hooks else set()
    values = _some_values(effect)
    target = {"target": ""} if effect.single else {}
    if "rig" in hooks:
        out |= _broken_by_other_rig(specimen, effect.hooks["rig"](specimen, **target, **values))
    if "balance" in hooks and specimen.free:
        changed = effect.hooks["balance"](_some_states(specimen), **target, **values)
        out |= {name for name, more in changed.items() if np.any(more)}
    return tuple(name for name in equations.unknowns if name in out)


def _some_values(effect: Effect) -> dict[str, float]:
    """Return values at which every strength of an effect is there."""
    typical = effect.typical()
    absent = [p for p in effect.parameters if p.neutral is not None and typical[p.name] == p.neutral]
    return typical | {p.name: float(p.neutral or 0.0) + _SOME * (p.high - float(p.neutral or 0.0)) for p in absent}


def _broken_by_other_rig(rated: Specimen, other: Specimen) -> set[str]:
    out = {name for value, of in _OF_RIG.items() if getattr(rated, value) != getattr(other, value) for name in of}
    for before, after in zip(rated.buffers, other.buffers, strict=True):
        if replace(after, z=before.z) != before:
            out.add(f"buffer {before.name}")
        if after.z != before.z:
            out.add("pitch")
    return out


def _some_states(specimen: Specimen) -> BalanceStates:
    """Return states in which everything moves: nothing but noise, of the size of a test."""
    rng, pads, buffers = np.random.default_rng(0), len(specimen.pads), len(specimen.buffers)
    own = specimen.mass * specimen.gravity / pads

    def noise(*shape: int) -> np.ndarray:
        return rng.standard_normal((_SAMPLES, *shape))

    return BalanceStates(
        time=np.linspace(0.0, _STEP * (_SAMPLES - 1), _SAMPLES),
        specimen=specimen,
        slip=0.01 * noise(2),
        velocity=0.1 * noise(2),
        load=own * (1.0 + 0.1 * noise(pads)),
        pad_force=0.1 * own * noise(pads, 2),
        girder_acceleration=noise(3),
        table_acceleration=noise(3),
        buffer_force=0.1 * own * noise(2),
        buffer_size=np.abs(0.1 * own * noise(buffers)),
        heave_rate=0.01 * noise(),
    )


def make_incidence(equations: Mapping[str, frozenset[str]]) -> np.ndarray:
    """Return whether a quantity stands in an equation (e, u), equations and quantities in their order."""
    known = sorted(frozenset[str]().union(*equations.values()))
    return np.array([[quantity in of for quantity in known] for of in equations.values()], bool)
