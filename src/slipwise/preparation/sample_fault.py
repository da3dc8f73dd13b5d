"""A fault that samples show by themselves: which channels, how large, and which samples are no measurement."""

from dataclasses import dataclass

from slipwise.arrays import Mask
from slipwise.short_repr import short_repr

RAILS: tuple[str, ...] = ("upper rail", "lower rail")


@short_repr
@dataclass(frozen=True)
class SampleFault:
    """Bad samples of one channel, or of several at the same instants.

    Attributes:
        kind: "late", "turned", "scaled", "shifted", "wild", "dead", "upper rail", "lower rail", "held", "lost" or
            "gap".
        channels: that show it.
        size: rail or shift in the channel's unit; delay [s]; -1 for a wrong sign; factor by which a channel is too
            large [1]; else share of all samples [1].
        bad: run -> samples that are no measurement (n,); none of a wrong sign, unit or zero, which is put right.
        runs: names of the runs that show it.
    """

    kind: str
    channels: tuple[str, ...]
    size: float
    bad: dict[str, Mask]
    runs: tuple[str, ...]
