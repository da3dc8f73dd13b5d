"""What gauges read at rest that they should not, or do not read that they should: gravity, and a girder tared away.

A DC accelerometer that stands upright reads plus or minus 1 g at rest; channels here are accelerations of the motion.
Load cells that were set to zero under the girder do not show its weight.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.channels import PADS
from slipwise.record import Record

GRAVITY = 9.80665
#: A mean this near to gravity is gravity's [1]; loads below this part of the weight are tared [1].
_NEAR, _TARED = 0.1, 0.15
LOADS: tuple[str, ...] = tuple(f"pad_{pad}_N" for pad in PADS)
_VERTICAL = ("table_az", "girder_az")


@dataclass(frozen=True)
class ZeroState:
    """What stands in the zeros of a campaign's gauges.

    Attributes:
        gravity: channel -> what it reads of gravity, plus or minus 9.80665 [m/s^2].
        missing_weight: of the girder, that four tared load cells do not show [N]; None where they show it.
    """

    gravity: Mapping[str, float]
    missing_weight: float | None

    def words(self) -> list[str]:
        """Say each in a sentence."""
        found = [f"gravity is in {name}: it reads {size:+.3g} m/s^2 at rest" for name, size in self.gravity.items()]
        if self.missing_weight is not None:
            found.append(
                "pad_*_N were set to zero under the girder: its weight of "
                f"{self.missing_weight / 1e3:.4g} kN is missing in them"
            )
        return found


def zero_state(records: Sequence[Record], weight: float | None) -> ZeroState:
    """Look at the means of all runs.

    Args:
        records: of the runs.
        weight: of the girder that stands on the cells [N], None where no free girder does.
    """
    gravity = {}
    names = dict.fromkeys(name for record in records for name in record.channels if name.startswith(_VERTICAL))
    for name in names:
        means = [float(np.median(record[name])) for record in records if name in record]
        sign = np.sign(means[0])
        if all(abs(sign * mean - GRAVITY) < _NEAR * GRAVITY for mean in means):
            gravity[name] = float(sign) * GRAVITY
    # cells that never move are dead, whatever they were set to
    weighing = [r for r in records if r.has_all(*LOADS) and all(np.ptp(r[name]) > 0.0 for name in LOADS)]
    if weight is None or not weighing:
        return ZeroState(gravity, None)
    sums = [float(np.median(np.sum([record[name] for name in LOADS], axis=0))) for record in weighing]
    # Cells of which one is turned round show half the weight: each of them must show next to nothing.
    each = [max(abs(float(np.median(record[name]))) for name in LOADS) for record in weighing]
    tared = all(abs(total) < _TARED * weight for total in sums) and all(one < _TARED * weight / 2.0 for one in each)
    return ZeroState(gravity, weight if tared else None)
