"""What gauges read at rest that they should not, or do not read that they should: gravity, and a girder tared away.

A DC accelerometer that stands upright reads plus or minus 1 g at rest; channels here are accelerations of the motion.
Load cells that were set to zero under the girder do not show its weight: all of them, or single ones, which then
show nothing while the others carry what the girder weighs less theirs.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.channels import part_of
from slipwise.record import Record

GRAVITY = 9.80665
#: A mean this near to gravity is gravity's [1]; loads below this part of the weight are tared [1].
_NEAR, _TARED = 0.1, 0.15
#: A single cell is tared if it shows less than this part of its share of the weight, if at least that part of it
#: is missing in the sum, and if it moves by that part of what the others do: a dead cell or a lifted pad is none [1].
_NOTHING, _MISSING, _ALIVE = 0.3, 0.5, 0.2
_VERTICAL = ("table_az", "girder_az")


@dataclass(frozen=True)
class ShiftedZero:
    """Channels whose zero is far off.

    Attributes:
        channels: one, or all load cells.
        size: what each of them reads too much [SI]: gravity, or minus the load that it was tared of.
    """

    channels: tuple[str, ...]
    size: float

    @property
    def tared(self) -> bool:
        """Whether a load is missing."""
        return part_of(self.channels[0])[0] == "pad"

    @property
    def words(self) -> str:
        """Say it in a sentence."""
        name, missing = self.channels[0], -self.size * len(self.channels) / 1e3
        if not self.tared:
            return f"gravity is in {name}: it reads {self.size:+.3g} m/s^2 at rest"
        if len(self.channels) > 1:
            return f"pad_*_N were set to zero under the girder: its weight of {missing:.4g} kN is missing in them"
        return f"{name} was set to zero under the girder: its part of the weight, {missing:.4g} kN, is missing in it"


def carries_nothing(name: str, record: Record, records: Sequence[Record], loads: Sequence[str]) -> bool:
    """Return whether a load cell shows no weight in a record, though it does in others, and moves no more than noise.

    Such a cell has died: one that was tared moves as its like, and a pad that never touches is no better in other runs.

    Args:
        name: of the cell.
        record: in which it may be dead.
        records: of all runs.
        loads: channels of all cells.
    """
    if name not in loads or not record.has_all(*loads):
        return False
    carried = max(abs(float(np.median(r[name]))) for r in records if name in r)
    if abs(float(np.median(record[name]))) > _NOTHING * carried:
        return False
    moved = float(np.median([np.std(record[other]) for other in loads if other != name]))
    return float(np.std(record[name])) < _ALIVE * moved


def shifted_zeros(records: Sequence[Record], loads: Sequence[str], weight: float) -> tuple[ShiftedZero, ...]:
    """Look at the medians of all runs.

    Args:
        records: of the runs.
        loads: channels of the cells on which a free girder stands; none where the girder is not free.
        weight: of the girder [N].
    """
    found = []
    names = dict.fromkeys(name for record in records for name in record.channels if name.startswith(_VERTICAL))
    for name in names:
        means = [float(np.median(record[name])) for record in records if name in record]
        sign = np.sign(means[0])
        if all(abs(sign * mean - GRAVITY) < _NEAR * GRAVITY for mean in means):
            found.append(ShiftedZero((name,), float(sign) * GRAVITY))
    # cells that never move are dead, whatever they were set to
    weighing = [r for r in records if r.has_all(*loads) and all(np.ptp(r[name]) > 0.0 for name in loads)]
    return (*found, *_tared(weighing, loads, weight)) if loads and weighing else tuple(found)


def _tared(records: Sequence[Record], loads: Sequence[str], weight: float) -> list[ShiftedZero]:
    medians = np.array([[np.median(record[name]) for name in loads] for record in records])
    # Cells of which one is turned round show half the weight: each of them must show next to nothing.
    if np.all(np.abs(medians.sum(axis=1)) < _TARED * weight) and np.all(np.abs(medians) < _TARED * weight / 2.0):
        return [ShiftedZero(tuple(loads), -weight / len(loads))]
    swing = np.array([[np.std(record[name]) for name in loads] for record in records])
    alive = swing > _ALIVE * np.median(swing, axis=1, keepdims=True)
    share = weight / len(loads)
    nothing = np.flatnonzero(np.all((np.abs(medians) < _NOTHING * share) & alive, axis=0))
    missing = weight - np.abs(medians).sum(axis=1)
    if not len(nothing) or np.any(missing < _MISSING * share * len(nothing)):
        return []
    each = float(np.median(missing)) / len(nothing)
    return [ShiftedZero((loads[int(i)],), -each) for i in nothing]
