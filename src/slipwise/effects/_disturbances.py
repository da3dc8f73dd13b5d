"""What physics adds to the balances by which an audit compares gauges, from what was recorded alone.

An effect's `disturb` gives forms of it, of a shape constant each that is no free number, such as a length. A form is a
list of free numbers; a number is relation -> a signal for each record (n,) in the relation's own unit, up to a factor.
The relations are girder_x, girder_y, heave, pitch, roll, warp, upright, and pair_AC_x and its like: pads at one end.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import pads_in
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.load_basis import end_pairs
from slipwise.signals.derivative import derivative

#: What one free number adds: relation -> a signal for each record.
Number = Mapping[str, Sequence[Array]]


def axes(records: Sequence[Record]) -> tuple[str, ...]:
    """Return the axes along which the girder's own balance is recorded."""
    return tuple(a for a in "xy" if recorded(records, f"slip_{a}", f"girder_a{a}"))


def recorded(records: Sequence[Record], *names: str) -> bool:
    """Return whether every record has these channels."""
    return all(record.has_all(*names) for record in records)


def channel(records: Sequence[Record], name: str) -> list[Array]:
    """Return a channel of every record."""
    return [record[name] for record in records]


def total_loads(records: Sequence[Record]) -> list[Array]:
    """Return the sum of the pads' loads of every record; nothing where one of them was not recorded."""
    names = [f"pad_{pad}_N" for pad in pads_in(name for record in records for name in record.channels)]
    return [np.sum([r[n] for n in names], axis=0) for r in records] if names and recorded(records, *names) else []


def paired(records: Sequence[Record], specimen: Specimen, axis: str) -> dict[str, tuple[list[Array], list[Array]]]:
    """Return mean friction and mean load of the pads at each end, relation -> one of each for every record.

    Args:
        records: of all runs.
        specimen: that tells which pads stand at one end.
        axis: of the friction, "x" or "y".
    """
    found: dict[str, tuple[list[Array], list[Array]]] = {}
    for one, other in end_pairs(specimen):
        if recorded(records, *(f"pad_{pad}_{kind}" for pad in (one, other) for kind in (f"F{axis}", "N"))):
            forces, loads = (
                [0.5 * (r[f"pad_{one}_{kind}"] + r[f"pad_{other}_{kind}"]) for r in records]
                for kind in (f"F{axis}", "N")
            )
            found[f"pair_{one}{other}_{axis}"] = forces, loads
    return found


def dahl_force(values: Array, length: float) -> Array:
    """Return a force that reverses with the direction of motion over a length (Dahl), between -1 and 1, (n,) [1].

    Args:
        values: (n,) of the coordinate that moves.
        length: over which the force reverses, in the unit of the values.
    """
    force, last = np.zeros(len(values)), 0.0
    steps = np.diff(values)
    fades = np.exp(-np.abs(steps) / length)
    for i, (step, fade) in enumerate(zip(steps.tolist(), fades.tolist(), strict=True)):
        side = 1.0 if step > 0.0 else -1.0
        last = side - (side - last) * fade
        force[i + 1] = last
    return force


def swing_of(base: Array, dt: float, frequency: float, damping: float) -> Array:
    """Return the acceleration of an oscillator relative to its shaken base (n,).

    q'' + 2 z w q' + w^2 q = -a; the displacement is the recursion of the sampled impulse response.
    """
    from scipy.signal import lfilter  # here, for it takes long to load and a replay does without

    turn = 2.0 * np.pi * frequency
    free = turn * np.sqrt(1.0 - damping**2)
    fade = np.exp(-damping * turn * dt)
    ahead, behind = [0.0, dt * fade * np.sin(free * dt) / free], [1.0, -2.0 * fade * np.cos(free * dt), fade**2]
    displacement = np.asarray(lfilter(ahead, behind, -base))
    return derivative(derivative(displacement, dt), dt)
