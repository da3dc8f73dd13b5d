"""Physics that could disturb the balances competes with the suspects, so that an uneven rig is not called a bad gauge.

No friction law: only forces that act on the girder beside the pads, ways of the load beside the pads, and differences
between pads. Each alternative has one or more free numbers, each with its columns in one or more relations.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import Effect
from slipwise.effects._disturbances import Number, channel, paired, recorded
from slipwise.record import Record
from slipwise.relations.balance_rows import Block, PreparedRun
from slipwise.relations.rigid_balances import Relation
from slipwise.rig import Specimen
from slipwise.rig.load_basis import warps
from slipwise.signals.derivative import derivative


@dataclass(frozen=True)
class Alternative:
    """A physical explanation.

    Attributes:
        name: of the effect, or in words.
        columns: relation -> (n, q) over its rows.
        width: q, how many numbers it may choose freely.
    """

    name: str
    columns: Block
    width: int


def alternatives(
    runs: Sequence[PreparedRun], relations: Sequence[Relation], effects: Iterable[Effect], specimen: Specimen
) -> list[Alternative]:
    """Return the physical explanations that these relations allow.

    Args:
        runs: as recorded, smoothed.
        relations: that the channels allow.
        effects: those with a hook `disturb` are explanations.
        specimen: the rated rig.
    """
    known = {relation.name: relation for relation in relations}
    found = []
    for name, numbers in _all([run.record for run in runs], effects, specimen):
        columns: dict[str, Array] = {}
        for k, number in enumerate(numbers):
            for place, signals in number.items():
                if place in known:
                    kind = known[place].rows
                    rows = np.concatenate([run.rows(s, kind) for run, s in zip(runs, signals, strict=True)])
                    columns.setdefault(place, np.zeros((len(rows), len(numbers))))[:, k] = rows
        if any(np.any(block) for block in columns.values()):
            found.append(Alternative(name, columns, len(numbers)))
    return found


def _all(
    records: Sequence[Record], effects: Iterable[Effect], specimen: Specimen
) -> Iterator[tuple[str, list[Number]]]:
    """Yield what effects say of themselves, and what no effect is."""
    for effect in effects:
        if "disturb" in effect.hooks:
            for numbers in effect.hooks["disturb"](records, specimen):
                yield effect.name, numbers
    if recorded(records, "slip_x"):
        slips = [np.abs(x) for x in channel(records, "slip_x")]
        yield "buffer carries weight", [{"heave": slips}, {"heave": [x**2 for x in slips]}]
    for name in ("girder_ax", "girder_az"):
        if recorded(records, name):
            yield "pads of unequal stiffness", [{warp: channel(records, name)} for warp in warps(specimen)]
    for axis in "xy":
        if pairs := paired(records, specimen, axis):
            # one of each pair lies at +y of the other: yaw makes all pairs differ by the same share of their rate
            rates = {
                name: [derivative(f, r.dt) for f, r in zip(forces, records, strict=True)]
                for name, (forces, _) in pairs.items()
            }
            yield "yaw of the girder", [*({name: forces} for name, (forces, _) in pairs.items()), rates]
