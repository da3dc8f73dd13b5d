"""How a missing force may enter: what it is multiplied by where it acts, as a column over a run.

adds to mu            N s f          s: along the motion, -1 to 1, as the base law's own friction reverses
multiplies mu         F f            F: the base law's force
adds to friction      N_0 s f        whatever the load, N_0 the mean load
even force on pads    N f            whichever way the pad slides
girder                sign(v) f      a force on the girder that no pad carries, against its motion
girder by place       f              the same, whichever way it moves
multiplies buffers    k x f          a share of the springs' force
load                  f              an upward force on the girder
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.objective import Objective
from slipwise.relations.evaluation_times import Instants
from slipwise.residual_map.states import DrivingState, PadInstants
from slipwise.short_repr import short_repr

#: Speed [m/s] over which the sign of a girder's motion is smoothed.
_SLOW = 1e-3


@short_repr
@dataclass(frozen=True)
class Port:
    """Where a law acts.

    Attributes:
        name: as above.
        relation: of the fit whose residual it explains.
        parity: "odd" where the force turns with the velocity.
        unit: of f.
        carrier: per run (f, p) what f is multiplied by, in the unit of the relation's prediction.
    """

    name: str
    relation: str
    parity: str
    unit: str
    carrier: tuple[Array, ...]


@dataclass(frozen=True)
class Gate:
    """Which pads, and which way of sliding, a law acts on.

    Attributes:
        name: in words.
        side_x: +1 or -1 for the pads on that side; 0 for both.
        side_y: the same along y.
        way: +1 forth, -1 back, 0 both.
    """

    name: str
    side_x: int = 0
    side_y: int = 0
    way: int = 0

    def open(self, places: Sequence[tuple[float, float]], velocity: Array) -> Array:
        """Return 1 where it is open, (f, p), else 0.

        Args:
            places: of the pads, from the middle [m].
            velocity: (f, p) along x [m/s].
        """
        here = [
            (not self.side_x or self.side_x * x > 0.0) and (not self.side_y or self.side_y * y > 0.0) for x, y in places
        ]
        moving = self.way * velocity > 0.0 if self.way else np.ones(velocity.shape, dtype=bool)
        return np.where(moving & np.array(here), 1.0, 0.0)


EVERYWHERE = Gate("all")


def gates(places: Sequence[tuple[float, float]], names: Sequence[str]) -> list[Gate]:
    """Return the gates: directions, sides, single pads. A side with one pad on it is that pad."""
    out = [Gate("sliding forth", way=1), Gate("sliding back", way=-1)]
    sides_x = [(f"side x{'+' if s > 0 else '-'}", s, 0) for s in (1, -1)]
    sides_y = [(f"side y{'+' if s > 0 else '-'}", 0, s) for s in (1, -1)]
    for name, x, y in [*sides_x, *sides_y]:
        gate = Gate(name, x, y)
        if 1 < int(np.count_nonzero(gate.open(places, np.zeros((1, len(places)))))) < len(places):
            out.append(gate)
    signs = [(1 if x >= 0.0 else -1, 1 if y >= 0.0 else -1) for x, y in places]
    if len(signs) > 1 and len(set(signs)) == len(signs):
        out += [Gate(f"pad {n}", x, y) for n, (x, y) in zip(names, signs, strict=True)]
    return out


def places_of(objective: Objective) -> list[tuple[float, float]]:
    """Return the places of the measured pads, from the middle [m]."""
    specimen = objective.specimen
    places = [specimen.pad_places[specimen.pads.index(p)] for p in objective.pads]
    return [(float(place[0]), float(place[1])) for place in places]


def opened(gate: Gate, places: Sequence[tuple[float, float]], instants: Sequence[Instants]) -> list[Array]:
    """Return 1 where a gate is open, per run (f, p), else 0."""
    return [gate.open(places, s.velocity[:, :, 0]) for s in instants]


def pad_ports(here: PadInstants) -> list[Port]:
    """Return the ports of the pads over the runs."""
    along = [a / np.maximum(f.bound, 1e-9) for a, f in zip(here.along, here.forces, strict=True)]
    sense = [np.clip(s, -1.0, 1.0) for s in along]
    mean = float(np.mean(np.concatenate([s.load for s in here.states])))  # as `FittedLaw.rated_load`
    load = [s.load for s in here.states]
    return [
        Port("adds to mu", "pads", "odd", "1", tuple(n * s for n, s in zip(load, sense, strict=True))),
        Port("multiplies mu", "pads", "odd", "1", here.along),
        Port("adds to friction", "pads", "odd", "1", tuple(mean * s for s in sense)),
        Port("even force on pads", "pads", "even", "1", tuple(load)),
    ]


def girder_ports(objective: Objective, values: Mapping[str, float], here: PadInstants) -> list[Port]:
    """Return the ports of the girder's balance, a force against its motion being an acceleration the other way."""
    mass = values.get("rig.mass", objective.specimen.mass)
    stiffness = values.get("rig.buffer_stiffness", sum(objective.specimen.buffer_stiffness))
    against = tuple(-np.tanh(s.velocity[:, :1, 0] / _SLOW) / mass for s in here.states)
    always = tuple(np.full((len(s.time), 1), -1.0 / mass) for s in here.states)
    spring = tuple(-stiffness * s.slip[:, :1, 0] / mass for s in here.states)
    return [
        Port("girder", "girder", "odd", "N", against),
        Port("girder by place", "girder", "even", "N", always),
        *((Port("multiplies buffers", "girder", "even", "1", spring),) if stiffness > 0.0 else ()),
    ]


def load_ports(here: PadInstants) -> list[Port]:
    """Return the port of the heave balance: what lifts the girder is not on the pads."""
    return [Port("load", "heave", "even", "N", tuple(np.full((len(s.time), 1), -1.0) for s in here.states))]


def girder_states(pads: Sequence[DrivingState]) -> list[DrivingState]:
    """Return the states of the girder: those of its first pad that do not belong to a pad's load or place."""
    left_out = {"load", "lagged_load", "load_rate", "heat"}
    return [DrivingState(s.name, 0.0, tuple(v[:, :1] for v in s.values)) for s in pads if s.name not in left_out]
