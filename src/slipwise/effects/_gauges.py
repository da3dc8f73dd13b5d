"""What the effects on port `gauge` share: which channels they act on, and how much a gauge can read."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import channel
from slipwise.errors import SettingError
from slipwise.record import Record

Array = NDArray[np.float64]
#: What a usual gauge of this unit reads at most, in both directions [SI]: offsets and rails are counted in it.
SPANS: dict[str, float] = {
    "N": 50e3, "m": 0.1, "m/s": 1.0, "m/s^2": 20.0, "rad": 0.02, "Pa": 40e6, "K": 200.0, "s": 1.0,
}  # fmt: skip


def span(name: str) -> float:
    """Give what a usual gauge of a channel reads at most [SI unit of the channel]: 50 kN, 100 mm, 2 g ..."""
    return SPANS[channel(name).unit]


def aimed(record: Record, target: str) -> tuple[str, ...]:
    """Give the channels that an effect with this target changes: one, or every one of the record for "all"."""
    return tuple(record.channels) if target == "all" else (target,)


def changed(record: Record, target: str, change: Callable[[str, Array], Array]) -> Record:
    """Give the record with `change(name, values (n,)) -> (n,)` done to the channels that are aimed at.

    Raises:
        InputError: the record lacks the target.
    """
    return record.replaced(**{name: change(name, record[name]) for name in aimed(record, target)})


def cells(record: Record, target: str) -> tuple[str, ...]:
    """Give the pads whose load cells are meant: that of a channel such as "pad_A_Fx", or all for "all".

    Raises:
        SettingError: the target belongs to no load cell.
    """
    if target == "all":
        return tuple(pad for pad in "ABCD" if f"pad_{pad}_N" in record or f"pad_{pad}_Fx" in record)
    if not target.startswith("pad_"):
        raise SettingError(f"{target!r} is no channel of a load cell; possible: all, pad_A_N, pad_A_Fx and so on")
    return (target.removeprefix("pad_")[0],)
