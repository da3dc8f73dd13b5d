"""What the effects on port `gauge` share: which channels they act on, and how much a gauge can read."""

from collections.abc import Callable

from slipwise.arrays import Array
from slipwise.channels import channel, channels_like
from slipwise.errors import InputError
from slipwise.record import Record

#: What a usual gauge of this unit reads at most, in both directions [SI]: offsets and rails are counted in it.
SPANS: dict[str, float] = {
    "N": 50e3, "m": 0.1, "m/s": 1.0, "m/s^2": 20.0, "rad": 0.02, "Pa": 40e6, "K": 200.0, "s": 1.0,
}  # fmt: skip
#: The same for the horizontal bridges of the pads' cells [N].
FRICTION_SPAN = 10e3


def span(name: str) -> float:
    """Return the largest reading of a usual gauge of a channel [SI]: 100 mm, 2 g, 10 kN across a pad."""
    return FRICTION_SPAN if channels_like("pad_*_F?", [name]) else SPANS[channel(name).unit]


def aimed(record: Record, target: str) -> tuple[str, ...]:
    """Return the channels of a record that a target means: "pad_A_N", "pad_*_N" or "all".

    Raises:
        InputError: the record has none of them.
    """
    found = channels_like(target, record.channels)
    if not found:
        raise InputError(f"this record has no channel {target!r}; it has: {', '.join(sorted(record.channels))}")
    return found


def changed(record: Record, target: str, change: Callable[[str, Array], Array]) -> Record:
    """Return the record with `change(name, values (n,)) -> (n,)` done to the channels that are aimed at.

    Raises:
        InputError: the record has none of them.
    """
    return record.replaced(**{name: change(name, record[name]) for name in aimed(record, target)})
